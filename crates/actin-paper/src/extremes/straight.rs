//! Straight rods pushed together along their axis: by symmetry they stay straight, which is no
//! equilibrium to rely on. Two ways lead to the buckled one.

use super::row::{Outcome, Row};
use super::scenes::{Parts, either};

/// Length (nm) of the rods; they have ten segments.
const LENGTH: f64 = 200.0;

/// What the motion has, in words, as keys of the filament, and of the task.
const WAYS: [(&str, &str, &str); 3] = [
    ("as it is", "", ""),
    (
        "imperfection of 0.01 nm",
        "imperfection: (amplitude_nm: 0.01, seed: 1),",
        "",
    ),
    ("leave_saddles: 3", "", "leave_saddles: 3,"),
];

/// A rod between two walls that is pushed together by a share of its length.
fn pushed(share: f64, imperfection: &str, task: String) -> Parts {
    Parts {
        sections: format!("Rod(from_nm: 0.0, to_nm: {LENGTH:?}, segments: 10)"),
        models: imperfection.to_owned(),
        rest: format!(
            "clamps: [Clamp(end: Start), Clamp(end: End)],
             path: [Stage(set: [Shift(end: End, shift_nm: (0.0, 0.0, {:?}))], duration_ns: 20.0)],",
            -share * LENGTH
        ),
        task,
    }
}

/// Damped motions at shares of the length from a thousandth, below the critical one of 0.11 %, to
/// half, against statics.
pub(super) fn rows() -> Vec<Row> {
    let mut rows = Vec::new();
    for share in [1e-3, 3e-3, 0.03, 0.3] {
        for (words, imperfection, keys) in WAYS {
            let case = format!("rod, pushed together by {share} of its length in time, {words}");
            let outcome = either(moved(share, imperfection, keys));
            rows.push(Row::new("straight rod", case, outcome));
        }
    }
    rows
}

/// The energy at the end of a motion against that of the equilibrium.
fn moved(share: f64, imperfection: &str, keys: &str) -> Result<Outcome, Outcome> {
    let task = format!(
        "Dynamics(duration_ns: 2000.0, record_every_ns: 2.0, {keys}
            drag: (translational_per_ns: 1.0, rotational_per_ns: 1.0),
            stop: (force_pn: 1e-6, torque_pn_nm: 1e-6, kinetic_pn_nm: 1e-10))"
    );
    let ran = pushed(share, imperfection, task).run()?;
    let statics = pushed(share, "", "Equilibrium()".to_owned()).run()?;
    let [energy, exact] = [ran, statics].map(|ran| ran.assembly.system.potential_energy());
    let error = (energy / exact - 1.0).abs();
    // Of second order in the residual of the stop rule.
    Ok(Outcome::correct("energy of statics", error, 1e-8))
}

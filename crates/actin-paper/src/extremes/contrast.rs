//! Stiffness of monomers and rod apart by up to 1e6, either way.

use super::row::{Outcome, Row};
use super::scenes::{Ran, either, run};
use super::stability::{Limits, limits};
use actin_sim::Integrator;

/// Rigidities of the rod over those of actin.
const FACTORS: [f64; 7] = [1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6];

/// Statics and the stable step of a mixed filament.
pub(super) fn rows() -> Vec<Row> {
    let mut rows = Vec::new();
    for factor in FACTORS {
        let statics = either(balance(factor));
        let case = |what: &str| format!("rod {factor:.0e} times as stiff, {what}");
        rows.push(Row::new("contrast", case("statics"), statics));
        let limit = either(limit(factor));
        rows.push(Row::new("contrast", case("stable step"), limit));
    }
    rows
}

fn scene(factor: f64, force: f64, task: &str) -> String {
    let [s, stretch, b, twist] = [1.6e4, 3.4e4, 3.9e4, 1.3e4].map(|x| x * factor);
    format!(
        "Scene(
            filament: Filament(
                sections: [
                    Ellipsoids(from_nm: 0.0, to_nm: 20.0),
                    Rod(from_nm: 20.0, to_nm: 60.0, segments: 4),
                ],
                monomers: Monomers(anchors: Independent, lateral_bonds: 16, longitudinal_bonds: 16),
                rod: RodModel(law: Constant, material: Rigidities(
                    shear_pn: ({s:?}, {s:?}, {stretch:?}), bend_pn_nm2: ({b:?}, {b:?}, {twist:?}),
                )),
            ),
            clamps: [Clamp(end: Start)],
            loads: [EndForce(end: End, force_pn: ({force:?}, 0.0, 0.0))],
            task: {task},
        )"
    )
}

/// A force that bends the softer part by some degrees.
fn balance(factor: f64) -> Result<Outcome, Outcome> {
    let tolerance = 1e-7 * factor.min(1.0);
    let task = format!(
        "Equilibrium(force_pn: {tolerance:?}, torque_pn_nm: {:?})",
        10.0 * tolerance
    );
    let mut ran: Ran = run(&scene(factor, 0.1 * factor.min(1.0), &task))?;
    // The tolerance, added up over two dozen bodies and their arms.
    Ok(Outcome::correct(
        "reaction of the wall",
        ran.imbalance(),
        1e-4,
    ))
}

fn limit(factor: f64) -> Result<Outcome, Outcome> {
    let text = scene(factor, 0.0, "Dynamics(duration_ns: 1e-6)");
    let mut assembly = super::scenes::build(&text)?;
    let Limits {
        predicted,
        measured,
    } = limits(&mut assembly.system, Integrator::Pefrl);
    let error = (measured / predicted - 1.0).abs();
    let what = "measured limit against predicted";
    Ok(Outcome::correct(what, error, 2e-3))
}

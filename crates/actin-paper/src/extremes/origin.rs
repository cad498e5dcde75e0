//! The lab's origin, 1e6 nm away from the filament.

use super::row::{Outcome, Row, larger};
use super::scenes::build;
use actin_mechanics::{Interaction, Loads, State, Vector3};
use actin_mechanics::{Xorshift, perturb};
use actin_sim::coupling::Linker;

/// By how much everything is moved (nm).
const SHIFTS: [f64; 4] = [1e2, 1e4, 1e5, 1e6];

/// Largest rigidities of what is shifted (pN over nm): stretch of a segment of 5 nm.
const STIFFNESS: f64 = 3.4e4 / 5.0;

/// A linked filament of both models, shaken.
const SCENE: &str = "Scene(
    filament: Filament(
        sections: [
            Ellipsoids(from_nm: 0.0, to_nm: 14.0),
            Rod(from_nm: 14.0, to_nm: 34.0, segments: 4),
        ],
        monomers: Monomers(anchors: Independent, lateral_bonds: 16, longitudinal_bonds: 16),
        rod: RodModel(law: Constant),
    ),
    loads: [EndForce(end: End, force_pn: (1.0, 2.0, 3.0))],
    linkers: [Linker(at_nm: 10.0, radius_nm: 1.8, displaced_nm: (3.0, 0.0, 0.0),
        stiffness_pn_per_nm: 100.0, rest_length_nm: 1.0)],
    task: Dynamics(duration_ns: 1.0),
)";

/// Loads of the shifted filament against those of the one at the origin.
pub(super) fn rows() -> Vec<Row> {
    SHIFTS
        .map(|shift| {
            let outcome = shifted(shift).unwrap_or_else(|outcome| outcome);
            Row::new("origin", format!("moved by {shift:.0e} nm"), outcome)
        })
        .to_vec()
}

/// The largest change of a force or torque, over what rounding of shifted places does to a spring.
fn shifted(shift: f64) -> Result<Outcome, Outcome> {
    let mut assembly = build(SCENE)?;
    perturb(
        assembly.system.state_mut(),
        &mut Xorshift::new(7),
        0.05,
        0.02,
    );
    let here = assembly.system.state().clone();
    let mut there = here.clone();
    let by = Vector3::new(shift, -shift, shift);
    for i in 0..there.points.len() {
        there.points.position.add(i, by);
    }
    let anchors = assembly.linkers.iter();
    for controls in anchors.filter_map(Linker::anchor_controls) {
        for (control, by) in controls.into_iter().zip(by.iter()) {
            there.controls[control] += by;
        }
    }
    let [a, b] = [&here, &there].map(|state| loads(assembly.system.interactions(), state));
    let force = a
        .force
        .iter()
        .zip(b.force.iter())
        .map(|(a, b)| (a - b).norm());
    let torque = a
        .torque
        .iter()
        .zip(b.torque.iter())
        .map(|(a, b)| (a - b).norm());
    let largest = force.chain(torque).fold(0.0, larger);
    // Each place is rounded to half a unit in the last place, an end of up to 128 bonds.
    let rounding = shift * f64::EPSILON * STIFFNESS;
    let what = "loads (pN, pN nm), round-off of places times stiffness";
    Ok(Outcome::correct(what, largest, 10.0 * rounding))
}

fn loads(interactions: &[Box<dyn Interaction>], state: &State) -> Loads {
    let mut loads = Loads::zeros(state);
    for interaction in interactions {
        interaction.add_loads(state, &mut loads);
    }
    loads
}

//! Positions of clamp plates, anchors and forces.

use actin_sim::mechanics::{Loads, State, UnitQuaternion, Vector3};
use actin_sim::{Assembly, JunctionBond, Part, rod_constants};

/// Returns the radius of a circular rod cross-section of the default area (nm).
pub fn rod_radius_nm() -> f64 {
    (rod_constants::CROSS_SECTION_AREA / std::f64::consts::PI).sqrt()
}

/// Returns the ends of a junction bond: monomer centre and rod end (nm, lab frame).
pub fn ends_of(bond: &JunctionBond, state: &State) -> [Vector3; 2] {
    [bond.monomer, bond.node].map(|i| state.points.position.get(i))
}

/// Returns the corners of a plate at each clamp, perpendicular to the filament (nm, lab frame).
pub fn plates(assembly: &Assembly, state: &State, half_nm: f64) -> Vec<[Vector3; 4]> {
    let clamps = assembly.clamps.iter();
    clamps
        .map(|clamp| {
            let about = clamp.point_nm(state);
            let built = assembly.filaments[clamp.filament].rotation;
            let turn = clamp.frames.first().map_or(built, |&frame| {
                turn_from_rest(assembly, state, frame) * built
            });
            let corner = |(x, y): (f64, f64)| about + turn * Vector3::new(x, y, 0.0) * half_nm;
            [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(corner)
        })
        .collect()
}

fn turn_from_rest(assembly: &Assembly, state: &State, frame: usize) -> UnitQuaternion {
    let rest = assembly.rest.frames.orientation.get(frame);
    state.frames.orientation.get(frame) * rest.inverse()
}

/// Returns the fixed or moving points that linkers pull towards (nm, lab frame).
pub fn anchors(assembly: &Assembly, state: &State) -> Vec<Vector3> {
    let linkers = assembly.linkers.iter().enumerate();
    let anchored = linkers.filter(|(i, _)| assembly.linked_to(*i).is_none());
    anchored
        .map(|(_, linker)| linker.end_position(state))
        .collect()
}

/// Returns the position and resultant force of each load in `state` (nm, pN, lab frame).
///
/// A distributed load is placed at the mean of its points, weighted by force. Couples are not included.
pub fn forces(assembly: &Assembly, state: &State) -> Vec<(Vector3, Vector3)> {
    let interactions = assembly.system.interactions().iter();
    let loads = assembly.terms.iter().zip(interactions);
    let loads = loads.filter(|(term, _)| matches!(term.part, Part::Load(_)));
    let mut all = Loads::zeros(state);
    loads
        .filter_map(|(_, load)| {
            all.clear();
            load.add_loads(state, &mut all);
            resultant(state, &all)
        })
        .collect()
}

/// Returns the mean position and the sum of forces; `None` if the forces cancel.
fn resultant(state: &State, loads: &Loads) -> Option<(Vector3, Vector3)> {
    let (mut at, mut sum, mut weight) = (Vector3::zeros(), Vector3::zeros(), 0.0);
    for (place, force) in state.points.position.iter().zip(loads.force.iter()) {
        at += place * force.norm();
        weight += force.norm();
        sum += force;
    }
    // The sum of forces that cancel, as in a couple on two points, is round-off.
    (sum.norm() > 1e-9 * weight).then(|| (at / weight, sum))
}

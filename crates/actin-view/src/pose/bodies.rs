//! Where things stand that are seen and are no bodies of their own: plates at held ends, anchors, forces.

use actin_sim::mechanics::{Loads, State, UnitQuaternion, Vector3};
use actin_sim::{Assembly, JunctionBond, Part, rod_constants};

/// Radius of the circle that has the area of the rod's cross-section (nm).
pub fn rod_radius_nm() -> f64 {
    (rod_constants::CROSS_SECTION_AREA / std::f64::consts::PI).sqrt()
}

/// Both ends of a bond of a junction: the monomer's centre, the rod's end (nm, lab frame).
pub fn ends_of(bond: &JunctionBond, state: &State) -> [Vector3; 2] {
    [bond.monomer, bond.node].map(|i| state.points.position.get(i))
}

/// Corners of a plate at each clamped end, across the filament's axis there (nm, lab frame).
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

/// How a frame has turned since it was built.
fn turn_from_rest(assembly: &Assembly, state: &State, frame: usize) -> UnitQuaternion {
    let rest = assembly.rest.frames.orientation.get(frame);
    state.frames.orientation.get(frame) * rest.inverse()
}

/// Fixed or moved points that linkers pull towards (nm, lab frame).
pub fn anchors(assembly: &Assembly, state: &State) -> Vec<Vector3> {
    let linkers = assembly.linkers.iter().enumerate();
    let anchored = linkers.filter(|(i, _)| assembly.linked_to(*i).is_none());
    anchored
        .map(|(_, linker)| linker.end_position(state))
        .collect()
}

/// Where each load acts with its factor in `state`, and its resultant force (nm, pN, lab frame): of one that
/// is spread, at the mean of its places. Couples have none and are left out.
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

/// The sum of forces and the mean of their places; none where nothing is left of them.
fn resultant(state: &State, loads: &Loads) -> Option<(Vector3, Vector3)> {
    let (mut at, mut sum, mut weight) = (Vector3::zeros(), Vector3::zeros(), 0.0);
    for (place, force) in state.points.position.iter().zip(loads.force.iter()) {
        at += place * force.norm();
        weight += force.norm();
        sum += force;
    }
    // What cancels, as the forces of a couple on two points, is a sum of round-off.
    (sum.norm() > 1e-9 * weight).then(|| (at / weight, sum))
}

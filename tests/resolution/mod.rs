//! Estimated errors against true ones, and resolutions that are chosen.
//!
//! The theorem: a stretch that under its loads is strained by `delta` more than its model says moves a wanted number
//! by `delta . dw`, `dw` the change of its loads with the load or motion conjugate to the number. What its model
//! says is known, and so is what monomers do. A plausible bug, a wrong sign or frame of a load, takes an estimate
//! from within a third of the true error to anywhere.

mod chosen;
mod estimated;

use actin_sim::{Assembly, Plan, Scene};

/// The scene in its equilibrium.
pub(crate) fn solved(scene: &Scene) -> Assembly {
    let mut assembly = Assembly::build(scene).unwrap();
    let (trajectory, _) = Plan::new(&assembly).unwrap().run().unwrap();
    *assembly.system.state_mut() = trajectory.records.last().unwrap().state.clone();
    assembly
}

/// Held at its start and pulled across at its end.
pub(crate) const CANTILEVER: &str = "clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (-2.0, 0.0, 0.0))], task: Equilibrium()";
/// The same, ten times as long.
pub(crate) const LONG_CANTILEVER: &str = "clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (-0.02, 0.0, 0.0))], task: Equilibrium()";
/// Twisted by a quarter turn, free to slide.
pub(crate) const TWIST: &str = "clamps: [Clamp(end: Start), Clamp(end: End, slides: AlongAxis)],
    path: [Stage(set: [Turn(end: End, turn_deg: (0.0, 0.0, 90.0))])], task: Equilibrium()";
/// Held at both ends, one of which is moved aside and outwards.
pub(crate) const PULLED_ASIDE: &str = "clamps: [Clamp(end: Start), Clamp(end: End)],
    path: [Stage(set: [Shift(end: End, shift_nm: (5.0, 0.0, 0.5))])], task: Equilibrium()";

/// A scene of one filament.
pub(crate) fn scene(sections: &str, rest: &str) -> Scene {
    Scene::from_ron(&format!(
        "Scene(filament: Filament(sections: {sections}), {rest})"
    ))
    .unwrap()
}

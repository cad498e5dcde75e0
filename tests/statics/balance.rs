//! Reactions of clamps, and the energy of a load.

use super::common::{free_bodies, settle};
use actin_mechanics::{Loads, Vector3};
use actin_sim::End;

const FORCE: [f64; 3] = [3.0, -1.0, 4.0];
const TOLERANCE: f64 = 1e-5;

fn scene(sections: &str, clamped: &str, loaded: &str, task: &str) -> String {
    let [x, y, z] = FORCE;
    format!(
        "Scene(
            filament: Filament(
                sections: [{sections}],
                monomers: Monomers(anchors: Independent, lateral_bonds: 16, longitudinal_bonds: 16),
                rod: RodModel(law: Constant),
            ),
            clamps: [Clamp(end: {clamped})],
            loads: [EndForce(end: {loaded}, force_pn: ({x:?}, {y:?}, {z:?}))],
            task: {task},
        )"
    )
}

const MONOMERS_THEN_ROD: &str =
    "Ellipsoids(from_nm: 0.0, to_nm: 30.0), Rod(from_nm: 30.0, to_nm: 60.0)";
const ROD_THEN_MONOMERS: &str =
    "Rod(from_nm: 0.0, to_nm: 30.0), Ellipsoids(from_nm: 30.0, to_nm: 60.0)";

/// The energy of the dead load is minus the force times the displacement.
#[test]
fn the_reaction_balances_the_load() {
    for (sections, clamped, loaded) in [
        (MONOMERS_THEN_ROD, "Start", End::End),
        (ROD_THEN_MONOMERS, "Start", End::End),
        (MONOMERS_THEN_ROD, "End", End::Start),
        (ROD_THEN_MONOMERS, "End", End::Start),
    ] {
        let task = format!("Equilibrium(force_pn: {TOLERANCE:?}, torque_pn_nm: {TOLERANCE:?})");
        let settled = settle(&scene(sections, clamped, &format!("{loaded:?}"), &task));
        let (assembly, state) = (&settled.assembly, &settled.last().state);
        let mut loads = Loads::zeros(state);
        for interaction in assembly.system.interactions() {
            interaction.add_loads(state, &mut loads);
        }
        let clamp = &assembly.clamps[0];
        let reaction = clamp.reaction(state, &loads);
        let force = Vector3::from(FORCE);
        let arm = assembly.tip_nm(state, loaded) - clamp.about_nm;
        let (points, frames) = free_bodies(state);
        let open_force = points as f64 * TOLERANCE;
        let open_torque = open_force * 60.0 + frames as f64 * TOLERANCE;
        let force_left = (reaction.force_pn + force).norm();
        let torque_left = (reaction.torque_pn_nm + arm.cross(&force)).norm();
        println!("{clamped} {loaded:?}: {force_left:e} pN, {torque_left:e} pN nm left");
        assert!(force_left < open_force, "{force_left} pN");
        assert!(torque_left < open_torque, "{torque_left} pN nm");
        assert!(
            reaction.torque_pn_nm.norm() > 10.0,
            "the torque must not vanish"
        );
        let work = force.dot(&settled.tip_displacement_nm(loaded));
        let term = assembly.terms.iter().position(|term| term.name == "load");
        let load = settled.last().energies_pn_nm[term.unwrap()];
        assert!((load + work).abs() < 1e-12 * work, "{load} and {work}");
    }
}

//! Independence of an equilibrium from drag, time step and integrator, and agreement with Newton's
//! method.

use super::common::{Settled, settle};
use actin_sim::End;

const TOLERANCE: f64 = 1e-7;

fn settled(task: &str) -> Settled {
    settle(&format!(
        "Scene(
            filament: Filament(
                sections: [
                    Ellipsoids(from_nm: 0.0, to_nm: 30.0),
                    Rod(from_nm: 30.0, to_nm: 60.0, segments: 3),
                ],
                monomers: Monomers(anchors: Independent, lateral_bonds: 16, longitudinal_bonds: 16),
                rod: RodModel(law: Constant),
            ),
            clamps: [Clamp(end: Start)],
            loads: [EndForce(end: End, force_pn: (2.0, 0.0, 0.0))],
            task: {task},
        )"
    ))
}

/// Damped motion by an integrator at a share of its stability limit, with drag rates of points and
/// frames (1/ns).
fn damped((integrator, share, translational, rotational): (&str, f64, f64, f64)) -> Settled {
    // Motion that the residual could reverse: TOLERANCE over a stiffness of 1 pN/nm.
    let kinetic = TOLERANCE * TOLERANCE;
    settled(&format!(
        "Dynamics(
            duration_ns: 1000.0, record_every_ns: 1.0, integrator: {integrator}, step_safety: {share:?},
            drag: (translational_per_ns: {translational:?}, rotational_per_ns: {rotational:?}),
            stop: (force_pn: {TOLERANCE:?}, torque_pn_nm: {TOLERANCE:?}, kinetic_pn_nm: {kinetic:?}),
        )"
    ))
}

#[test]
fn every_way_leads_to_the_same_equilibrium() {
    let newton = settled("Equilibrium(force_pn: 1e-9, torque_pn_nm: 1e-9)");
    let place = newton.tip_displacement_nm(End::End);
    let energy = newton.last().potential_pn_nm();
    for way in [
        ("Pefrl", 0.5, 1.0, 1.0),
        ("Pefrl", 0.9, 1.0, 1.0),
        ("Pefrl", 0.5, 0.5, 0.5),
        ("Pefrl", 0.5, 4.0, 0.5),
        ("Pefrl", 0.5, 0.5, 4.0),
        ("PositionVerlet", 0.5, 1.0, 1.0),
        ("Vefrl", 0.5, 1.0, 1.0),
        ("ForestRuth", 0.5, 1.0, 1.0),
        ("Suzuki", 0.5, 1.0, 1.0),
    ] {
        let settled = damped(way);
        let apart = (settled.tip_displacement_nm(End::End) - place).norm();
        let energies_apart = (settled.last().potential_pn_nm() - energy).abs();
        println!("{way:?}: {apart:.1e} nm, {energies_apart:.1e} pN nm");
        // Residual over the smallest tip stiffness, 0.1 pN/nm.
        assert!(apart < 10.0 * TOLERANCE, "{way:?}: {apart:e} nm");
        // Second order in the distance from the equilibrium: only round-off.
        assert!(energies_apart < 1e-11, "{way:?}: {energies_apart:e} pN nm");
    }
}

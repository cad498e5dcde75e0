//! Independence of an equilibrium from drag, time step and integrator.

use super::common::{Settled, settle};
use actin_sim::End;

const TOLERANCE: f64 = 1e-7;

#[derive(Clone, Copy, Debug)]
struct Way {
    integrator: &'static str,
    step_safety: f64,
    translational_per_ns: f64,
    rotational_per_ns: f64,
}

const USUAL: Way = Way {
    integrator: "Pefrl",
    step_safety: 0.5,
    translational_per_ns: 1.0,
    rotational_per_ns: 1.0,
};

fn settled(way: Way) -> Settled {
    let Way {
        integrator,
        step_safety,
        translational_per_ns,
        rotational_per_ns,
    } = way;
    // Motion that the residual could reverse: TOLERANCE over a stiffness of 1 pN/nm.
    let kinetic = TOLERANCE * TOLERANCE;
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
            task: Dynamics(
                duration_ns: 1000.0,
                integrator: {integrator},
                step_safety: {step_safety:?},
                drag: (
                    translational_per_ns: {translational_per_ns:?},
                    rotational_per_ns: {rotational_per_ns:?},
                ),
                stop: (force_pn: {TOLERANCE:?}, torque_pn_nm: {TOLERANCE:?}, kinetic_pn_nm: {kinetic:?}),
                record_every_ns: 1.0,
            ),
        )"
    ))
}

#[test]
fn every_way_leads_to_the_same_equilibrium() {
    let usual = settled(USUAL);
    let (place, energy) = (
        usual.tip_displacement_nm(End::End),
        usual.last().potential_pn_nm(),
    );
    let drags = [(0.5, 0.5), (4.0, 0.5), (0.5, 4.0)].map(|(translational, rotational)| Way {
        translational_per_ns: translational,
        rotational_per_ns: rotational,
        ..USUAL
    });
    let integrators = ["PositionVerlet", "Vefrl", "ForestRuth", "Suzuki"].map(|integrator| Way {
        integrator,
        ..USUAL
    });
    let step = Way {
        step_safety: 0.9,
        ..USUAL
    };
    for way in drags.into_iter().chain(integrators).chain([step]) {
        let settled = settled(way);
        let apart = (settled.tip_displacement_nm(End::End) - place).norm();
        let energies_apart = (settled.last().potential_pn_nm() - energy).abs();
        println!("{way:?}: {apart:.1e} nm, {energies_apart:.1e} pN nm");
        // Residual over the smallest tip stiffness, 0.1 pN/nm.
        assert!(apart < 10.0 * TOLERANCE, "{way:?}: {apart:e} nm");
        // Second order in the distance from the equilibrium: only round-off.
        assert!(energies_apart < 1e-11, "{way:?}: {energies_apart:e} pN nm");
    }
}

//! Order of convergence of whole states.

use super::filaments::{
    FILAMENTS, Filament, KBT, degrees_of_freedom, distances, in_flight, orders, state_after,
    steps_of_one_radian,
};
use super::record::scientific;
use crate::common::ran;
use actin_integrate::{
    Composition, FOREST_RUTH, PEFRL, POSITION_VERLET, SUZUKI, VEFRL, VELOCITY_VERLET,
    largest_frequency,
};

fn radians(filament: Filament) -> u32 {
    let system = in_flight(filament);
    let omega = largest_frequency(&system).unwrap();
    let dofs = degrees_of_freedom(system.state()) as f64;
    let strain_energy = system.potential_energy() / KBT / dofs;
    println!(
        "{}: {omega:.0} rad/ns, strain energy {strain_energy:.2} kBT per degree of freedom",
        filament.0
    );
    steps_of_one_radian(omega)
}

#[test]
fn every_method_has_its_order_on_every_filament() {
    for filament in FILAMENTS {
        let steps = radians(filament);
        let after = |scheme: &Composition, n: u32| state_after(in_flight(filament), scheme, n);
        // PEFRL has the smallest error; at 1/64 rad per step it is 1/4096 of the smallest error
        // below.
        let reference = after(&PEFRL, 64 * steps);
        // The next term of the error is of relative order (omega h)^2. Verlet runs at half the
        // step.
        for (scheme, fraction) in [
            (POSITION_VERLET, 16),
            (VELOCITY_VERLET, 16),
            (PEFRL, 4),
            (VEFRL, 4),
            (FOREST_RUTH, 8),
            (SUZUKI, 4),
        ] {
            let error = |n: u32| distances(&after(&scheme, n * steps), &reference);
            let (coarse, fine) = (error(fraction), error(2 * fraction));
            let orders = orders(coarse, fine);
            println!(
                "  {}, 1/{fraction} rad: errors {}, orders {orders:.3?}",
                scheme.name(),
                scientific(&coarse)
            );
            for order in orders {
                assert!(
                    (order - f64::from(scheme.order())).abs() < 0.05,
                    "{}, {scheme}: {order}",
                    filament.0
                );
            }
        }
    }
}

/// The stiffness of `Homogenised` changes at the onset of compression, with four continuous
/// derivatives of the energy.
#[test]
fn the_homogenised_law_keeps_the_order() {
    let error = |step: f64| {
        let (assembly, ..) = ran(&format!(
            "Scene(
                filament: Filament(
                    sections: [Rod(from_nm: 0, to_nm: 80, segments: 8)],
                    rod: RodModel(law: Homogenised),
                ),
                clamps: [Clamp(end: Start)],
                loads: [EndForce(end: End, force_pn: (2, 0, 0))],
                task: Dynamics(
                    duration_ns: 20, time_step_ns: {step:?}, integrator: Pefrl,
                    record_every_ns: 20,
                ),
            )"
        ));
        // Zero at the start.
        assembly.system.total_energy().abs()
    };
    let errors = [2e-3, 1e-3, 5e-4, 2.5e-4].map(error);
    let order = (errors[0] / errors[3]).log2() / 3.0;
    println!("errors {}, order {order:.2}", scientific(&errors));
    assert!(order > 3.9);
}

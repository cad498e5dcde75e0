//! Conservation laws of two free filaments joined by linkers.

use super::filaments::{fly, step};
use super::record::scientific;
use actin_integrate::{Drag, PEFRL, advance};
use actin_mechanics::{State, System, Vector3};
use actin_mechanics::{Xorshift, perturb, randomise_velocities};
use actin_sim::{Assembly, Scene};

fn tumbling() -> System {
    let scene = Scene::from_ron(
        "Scene(
            filaments: [
                (
                    sections: [
                        Ellipsoids(from_nm: 0.0, to_nm: 22.0),
                        Rod(from_nm: 22.0, to_nm: 42.0, segments: 2),
                    ],
                    rod: RodModel(law: Constant),
                    monomers: (anchors: Independent, seed: 1, lateral_bonds: 16, longitudinal_bonds: 16),
                ),
                (
                    sections: [Rod(from_nm: 0.0, to_nm: 60.0, segments: 6)],
                    rod: RodModel(law: Constant),
                    at_nm: (-20.0, 10.0, 5.0), direction: (1.0, 0.2, 0.5),
                ),
            ],
            linkers: [
                Linker(at_nm: 10.0, radius_nm: 1.8, to: Site(filament: 1, at_nm: 27.0, radius_nm: 1.8),
                    stiffness_pn_per_nm: 20.0),
                Linker(at_nm: 33.0, radius_nm: 1.8, azimuth_deg: 70.0, stiffness_pn_per_nm: 30.0,
                    to: Site(filament: 1, at_nm: 41.0, radius_nm: 1.8), rest_length_nm: 2.0),
                Linker(filament: 1, at_nm: 5.0, to: Site(filament: 1, at_nm: 55.0, radius_nm: 1.8),
                    stiffness_pn_per_nm: 3.0),
            ],
            task: Dynamics(duration_ns: 1.0),
        )",
    );
    let mut system = Assembly::build(&scene.unwrap()).unwrap().system;
    let mut noise = Xorshift::new(5);
    let state = system.state_mut();
    randomise_velocities(state, &mut noise, 1.0, 1.0);
    perturb(state, &mut noise, 2e-3, 1e-3);
    let (velocity, omega) = (
        Vector3::new(20.0, -10.0, 30.0),
        Vector3::new(3.0, -2.0, 5.0),
    );
    fly(state, velocity, omega);
    system
}

/// Sums of the norms of momenta and of their moments, as scales of round-off.
fn scales(state: &State) -> (f64, f64) {
    let momentum = |i: usize| state.points.velocity.get(i).norm() / state.points.inverse_mass()[i];
    let points = 0..state.points.len();
    let moment = |i: usize| state.points.position.get(i).norm() * momentum(i);
    let spins: f64 = state.frames.angular_momentum.iter().map(|l| l.norm()).sum();
    (
        points.clone().map(momentum).sum(),
        points.map(moment).sum::<f64>() + spins,
    )
}

#[test]
fn linkers_between_filaments_keep_momentum_and_angular_momentum() {
    let mut system = tumbling();
    let (p, l) = (system.state().momentum(), system.state().angular_momentum());
    let places = system.state().points.position.clone();
    let before = system.total_energy();
    let h = step(&system, &PEFRL, 0.15);
    advance(&mut system, &PEFRL, h, 10_000, &Drag::NONE);
    let (p_end, l_end) = (system.state().momentum(), system.state().angular_momentum());
    let (momentum, moment) = scales(system.state());
    let changes = [(p_end - p).norm() / momentum, (l_end - l).norm() / moment];
    let drift = system.total_energy() / before - 1.0;
    let gone = (system.state().points.position.get(0) - places.get(0)).norm();
    println!(
        "joined: relative changes {}, energy {drift:.1e}",
        scientific(&changes)
    );
    assert!(gone > 10.0);
    // A random walk of 4e4 kicks of relative round-off 1e-16: 2e-14.
    assert!(changes.iter().all(|c| *c < 1e-13), "{changes:?}");
    // Order 4 at 0.15 of the limit.
    assert!(drift.abs() < 1e-3);
}

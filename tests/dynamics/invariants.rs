//! Time reversal and conservation of momenta to round-off.

use super::filaments::{FILAMENTS, distances, in_flight};
use super::record::scientific;
use actin_integrate::{Composition, Drag, PEFRL, advance, largest_frequency, stable_step};

use actin_mechanics::{State, System};

pub(crate) fn step(system: &System, scheme: &Composition, share: f64) -> f64 {
    stable_step(scheme, largest_frequency(system).unwrap(), share).unwrap()
}

/// A drift without inverse, an asymmetric table or velocity-dependent loads would give an error
/// above 1e-6 nm.
#[test]
fn time_reversal() {
    for filament in FILAMENTS {
        for scheme in Composition::all() {
            let mut system = in_flight(filament);
            let start = system.state().clone();
            let h = step(&system, scheme, 0.25);
            advance(&mut system, scheme, h, 300, &Drag::NONE);
            let gone = distances(system.state(), &start);
            advance(&mut system, scheme, -h, 300, &Drag::NONE);
            let missed = distances(system.state(), &start);
            println!(
                "{}, {scheme}: missed by {}",
                filament.0,
                scientific(&missed)
            );
            assert!(gone[0] > 1.0 && gone[2] > 0.3, "{gone:?}");
            // Positions of 30 nm have a round-off of 4e-15. Up to 6600 stages and chaotic
            // divergence multiply it by less than a hundred (measured). The factor for velocities
            // includes the largest frequency.
            let allowed = [1e-11, 1e-8, 1e-11, 1e-9];
            for (missed, allowed) in missed.iter().zip(allowed) {
                assert!(*missed < allowed, "{}, {scheme}: {missed:e}", filament.0);
            }
        }
    }
}

/// Sums of the norms of momenta and of their moments, as scales of round-off.
pub(crate) fn scales(state: &State) -> (f64, f64) {
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
fn momentum_and_angular_momentum_stay() {
    for filament in FILAMENTS {
        let mut system = in_flight(filament);
        let (p, l) = (system.state().momentum(), system.state().angular_momentum());
        let h = step(&system, &PEFRL, 0.5);
        advance(&mut system, &PEFRL, h, 10_000, &Drag::NONE);
        let (p_end, l_end) = (system.state().momentum(), system.state().angular_momentum());
        let (momentum, moment) = scales(system.state());
        let changes = [(p_end - p).norm() / momentum, (l_end - l).norm() / moment];
        println!("{}: relative changes {}", filament.0, scientific(&changes));
        // A random walk of 4e4 kicks of relative round-off 1e-16: 2e-14.
        assert!(
            changes.iter().all(|c| *c < 1e-13),
            "{}: {changes:?}",
            filament.0
        );
    }
}

use crate::common;
use actin_brownian::Langevin;
use actin_cosserat::StraightRod;
use actin_integrate::{POSITION_VERLET, Stepper, largest_frequency, stable_step};
use actin_mechanics::{PointLoad, State, System, Vector3};
use common::{FRICTION, free_rod, friction_of, law, layout_of, tip};

/// A rod of segments of 10 nm under a force of 1 pN per segment, with `factor` times the friction.
fn pulled(segments: usize, direction: Vector3, factor: f64) -> (System, Langevin) {
    let mut state = State::default();
    let rod = StraightRod::uniform(segments, 10.0);
    let rod = rod.push(&mut state).unwrap();
    // Half forces at the ends, like the friction.
    let shares = rod.points().map(|i| {
        let is_end = i == rod.points().start || i == tip(&rod);
        (i, if is_end { 0.5 } else { 1.0 })
    });
    let control = state.add_control(1.0);
    let load = PointLoad::new(&state, shares.collect(), direction, control).unwrap();
    let mut friction = friction_of(&rod);
    for dashpot in &mut friction.dashpots {
        dashpot.friction *= factor;
    }
    let layout = layout_of(&state, &rod);
    let system = System::new(state, vec![law(&rod), Box::new(load)]);
    let steps = Langevin::new(&system, layout, friction, (0.0, 0)).unwrap();
    (system, steps)
}

fn step_of(system: &System, share: f64) -> f64 {
    stable_step(&POSITION_VERLET, largest_frequency(system).unwrap(), share).unwrap()
}

/// The terminal velocity is force over friction. Splitting with half steps of exponential drag
/// changes it by `x coth x`, with half the decay per step `x`.
#[test]
fn terminal_velocity_is_exact_at_any_friction() {
    for (axis, friction) in [(Vector3::x(), FRICTION[1]), (Vector3::z(), FRICTION[0])] {
        for factor in [0.1, 1.0, 1e3] {
            let (mut system, mut steps) = pulled(3, axis, factor);
            let h = step_of(&system, 0.5);
            let place = |system: &System| system.state().points.position.get(0).dot(&axis);
            let advance = |system: &mut System, steps: &mut Langevin, first: u64, number: u64| {
                (first..first + number).for_each(|k| steps.step(system, k, h).unwrap());
            };
            advance(&mut system, &mut steps, 0, 30_000);
            let before = place(&system);
            advance(&mut system, &mut steps, 30_000, 100);
            let drift = (place(&system) - before) / (100.0 * h);
            let velocity = system.state().points.velocity.get(0).dot(&axis);
            let expected = 3.0 / (friction * factor * 30.0);
            println!("{axis:?}, {factor}: {drift}, {velocity}, {expected}");
            assert!((drift / expected - 1.0).abs() < 1e-6);
            assert!((velocity / expected - 1.0).abs() < 1e-6);
        }
    }
}

/// Diffusion is `kT/Z`.
#[test]
fn diffusion_is_exact_at_any_friction() {
    const SAMPLES: u64 = 3000;
    let kt = 4.11;
    for (factor, lag) in [(1.0, 500), (1e3, 10)] {
        let (mut system, _) = pulled(1, Vector3::zeros(), factor);
        let rod = StraightRod::uniform(1, 10.0);
        let rod = rod.push(&mut State::default()).unwrap();
        let mut friction = friction_of(&rod);
        friction
            .dashpots
            .iter_mut()
            .for_each(|d| d.friction *= factor);
        let layout = layout_of(system.state(), &rod);
        let mut steps = Langevin::new(&system, layout, friction, (kt, 3)).unwrap();
        let h = step_of(&system, 0.5);
        let middle = |system: &System| {
            let x = &system.state().points.position;
            let axis = system.state().frames.orientation.get(0) * Vector3::z();
            ((x.get(0) + x.get(1)) * 0.5, axis)
        };
        let (mut along, mut across) = (0.0, 0.0);
        for sample in 0..SAMPLES {
            let (before, axis) = middle(&system);
            for k in 0..lag {
                steps.step(&mut system, sample * lag + k, h).unwrap();
            }
            let moved = middle(&system).0 - before;
            along += moved.dot(&axis).powi(2);
            across += 0.5 * (moved.norm_squared() - moved.dot(&axis).powi(2));
        }
        let expected = 2.0 * kt * lag as f64 * h * SAMPLES as f64 / (10.0 * factor);
        let ratios = [
            along * FRICTION[0] / expected,
            across * FRICTION[1] / expected,
        ];
        println!("{factor}: {ratios:?}");
        // Three standard errors of squares in one and two directions. In water velocities decay in
        // 1/60 and 1/110 ns, and the lag is 1 ns.
        for (ratio, directions) in ratios.into_iter().zip([1.0, 2.0]) {
            let error = (2.0 / (directions * SAMPLES as f64)).sqrt();
            assert!((ratio - 1.0).abs() < 3.0 * error, "{factor}: {ratios:?}");
        }
    }
}

/// Each strain component has `kT/2` at 0.9 of the largest stable step.
#[test]
fn strains_have_their_energy_at_any_stable_step() {
    const SEGMENTS: usize = 4;
    let (kt, share) = (0.0411, 0.9);
    let (mut system, _, rod) = free_rod(SEGMENTS, 40.0, (kt, 5), |_, _| Vec::new());
    let layout = layout_of(system.state(), &rod);
    let mut steps = Langevin::new(&system, layout, friction_of(&rod), (kt, 7)).unwrap();
    let h = step_of(&system, share);
    let (warm, number) = (50_000, 600_000);
    let mut sums = [0.0; 2];
    let mut energies = [0.0; 2 * SEGMENTS - 1];
    for k in 0..warm + number {
        steps.step(&mut system, k, h).unwrap();
        if k >= warm && k % 4 == 0 {
            system.interactions()[0].write_energies(system.state(), &mut energies);
            let (shear, bending) = energies.split_at(SEGMENTS);
            sums[0] += shear.iter().sum::<f64>() / (3 * SEGMENTS) as f64;
            sums[1] += bending.iter().sum::<f64>() / (3 * (SEGMENTS - 1)) as f64;
        }
    }
    let shares = sums.map(|sum| sum / (kt * (number / 4) as f64));
    println!("{share}: {shares:?}");
    // Bending relaxes in about a thousand steps: standard errors of 0.6 and 1.8 %.
    assert!((shares[0] / 0.5 - 1.0).abs() < 3.0 * 0.006, "{shares:?}");
    assert!((shares[1] / 0.5 - 1.0).abs() < 3.0 * 0.018, "{shares:?}");
}

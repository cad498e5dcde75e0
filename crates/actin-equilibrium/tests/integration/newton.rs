//! Newton's method.

use crate::common;
use actin_equilibrium::{
    Convergence, Layout, Newton, NewtonOptions, Residual, SolveError, Stability, Verdict,
};
use actin_mechanics::{Interaction, Loads, PointLoad, State, Vector3};
use actin_mechanics::{Xorshift, perturb};
use common::{ACTIN, Rod, chain, filament, in_order, point, springs};

type Terms = Vec<Box<dyn Interaction>>;

#[test]
fn convergence_is_quadratic_near_the_solution() {
    let (mut state, terms) = ACTIN.loaded(Vector3::x() * 2.0, 1.0);
    let mut newton = ACTIN.newton(&state);
    newton.solve(&mut state, &terms).unwrap();
    perturb(&mut state, &mut Xorshift::new(5), 0.0, 3e-3);
    let equilibrium = newton.solve(&mut state, &terms).unwrap();
    let size = |r: &Residual| r.force.max(r.torque);
    let mut residuals: Vec<f64> = equilibrium
        .history
        .iter()
        .map(|step| size(&step.residual))
        .collect();
    residuals.push(size(&equilibrium.residual));
    let floor = size(&equilibrium.floor);
    let pairs: Vec<_> = residuals
        .windows(2)
        .map(|pair| (pair[0], pair[1]))
        .filter(|&(before, after)| before < 1.0 && after > 10.0 * floor)
        .collect();
    println!("residuals {residuals:?}, floor {floor:e}");
    assert!(!pairs.is_empty(), "no step in the quadratic range");
    for (before, after) in pairs {
        // The constant is the change of stiffness per unit of residual, about 1.
        assert!(after <= 10.0 * before * before, "{before:e} to {after:e}");
    }
    assert!(equilibrium.history.len() <= 7, "{residuals:?}");
}

#[test]
fn the_equilibrium_does_not_depend_on_the_start() {
    let (state, terms) = ACTIN.loaded(Vector3::new(2.0, 0.5, 1.0), 1.0);
    let mut newton = ACTIN.newton(&state);
    let mut straight = state.clone();
    newton.solve(&mut straight, &terms).unwrap();
    for seed in 0..8 {
        let mut start = state.clone();
        let mut noise = Xorshift::new(seed);
        perturb(&mut start, &mut noise, 3.0, 0.5);
        start.points.position.set(0, state.points.position.get(0));
        start
            .frames
            .orientation
            .set(0, state.frames.orientation.get(0));
        let before: f64 = terms.iter().map(|term| term.energy(&start)).sum();
        let equilibrium = newton.solve(&mut start, &terms).unwrap();
        assert_eq!(equilibrium.ending, Convergence::Converged);
        assert!(
            equilibrium.energy <= before,
            "a solve never ends above its start"
        );
        let apart = (ACTIN.tip(&start) - ACTIN.tip(&straight)).norm();
        // Residual over the lowest stiffness, 1e-8 pN over 0.03 pN/nm.
        assert!(apart < 1e-6, "seed {seed}: {apart:e} nm apart");
    }
}

#[test]
fn floppy_filaments_are_neutral_at_rest_and_solved_under_load() {
    let n = 31;
    let (mut state, bonds) = filament(n, 32, 5);
    let control = state.add_control(0.0);
    let shares = vec![(n - 1, 0.5), (n - 2, 0.5)];
    let load = PointLoad::new(&state, shares, Vector3::x(), control).unwrap();
    let terms: Terms = vec![Box::new(bonds), Box::new(load)];
    let layout = Layout::new(&state, Some(&in_order(&state))).unwrap();
    let mut newton = Newton::new(layout, NewtonOptions::default()).unwrap();
    let before = state.clone();
    let rest = newton.solve(&mut state, &terms).unwrap();
    assert_eq!(state, before, "nothing moves without a load");
    // N + 7 modes of an unconstrained filament; holding two monomers removes 9.
    let modes = n - 2;
    let stability = rest.certificate.unwrap().stability();
    assert_eq!(stability, Stability::Neutral { modes });
    for force in [0.1, 2.0, 20.0] {
        let mut loaded = before.clone();
        loaded.controls[control] = force;
        let equilibrium = newton.solve(&mut loaded, &terms).unwrap();
        let stability = equilibrium.certificate.unwrap().stability();
        assert_eq!(stability, Stability::Stable, "{force} pN");
        assert!(equilibrium.history.len() < 100, "{force} pN");
    }
}

#[test]
fn a_chain_hangs_along_the_force() {
    let (mut state, mut terms) = chain();
    let load = PointLoad::at(&mut state, 4, Vector3::x() * 5.0).unwrap();
    terms.push(Box::new(load));
    let mut newton = Newton::new(Layout::free(&state), NewtonOptions::default()).unwrap();
    let equilibrium = newton.minimize(&mut state, &terms, 3).unwrap();
    assert!(!equilibrium.is_saddle());
    // Each of the four springs extends by 0.5 nm.
    let end = state.points.position.get(4);
    assert!((end - Vector3::x() * 6.0).norm() < 1e-7, "{end}");
}

#[test]
fn a_cantilever_takes_few_steps_at_every_length() {
    for (segments, length) in [(16, 160.0), (160, 1600.0), (1600, 16000.0f64)] {
        let rod = Rod {
            segments,
            length,
            ..ACTIN
        };
        let force = Vector3::x() * 2.0 * (160.0 / length).powi(2);
        let (mut state, terms) = rod.loaded(force, 1.0);
        let equilibrium = rod.newton(&state).solve(&mut state, &terms).unwrap();
        println!("{length} nm: {:?}", equilibrium.work);
        assert!(equilibrium.history.len() <= 6);
        assert_eq!(equilibrium.work.symbolic_factorizations, 1);
        let relative = rod.tip(&state).x / length;
        // Elastica at alpha = 1.3128, with small shear at 160 nm.
        assert!((relative - 0.3735).abs() < 2e-3, "{relative}");
    }
}

#[test]
fn round_off_floor_is_reported() {
    let (mut state, terms) = ACTIN.loaded(Vector3::x() * 2.0, 1.0);
    let options = NewtonOptions {
        tolerance: Residual {
            force: 1e-18,
            torque: 1e-18,
        },
        ..NewtonOptions::default()
    };
    let mut newton = Newton::new(ACTIN.layout(&state), options).unwrap();
    let equilibrium = newton.solve(&mut state, &terms).unwrap();
    assert_eq!(equilibrium.ending, Convergence::FloorReached);
    assert!(equilibrium.residual.force <= 100.0 * equilibrium.floor.force);
    assert!(equilibrium.floor.force < 1e-8);
}

/// Loads of a joint at 1e12 nm have a rounding error of 2e-5 pN. An inverted pendulum, 0.01 nm off,
/// has a residual of 1e-6 pN.
#[test]
fn rounding_of_one_body_does_not_stop_another() {
    let mut state = State::default();
    for z in [0.0, 0.9, 1e12, 1e12 + 1.0] {
        point(&mut state, Vector3::z() * z);
    }
    state.points.hold(0);
    state.points.hold(2);
    state.points.position.set(1, Vector3::new(0.01, 0.0, 0.9));
    let control = state.add_control(1e-4);
    let load = PointLoad::new(&state, vec![(1, 1.0)], -Vector3::z(), control).unwrap();
    let springs = springs(&state, vec![(0, 1, 1e-3, 1.0), (2, 3, 0.1, 1.0)]);
    let terms: Terms = vec![springs, Box::new(load)];
    let layout = Layout::new(&state, Some(&in_order(&state))).unwrap();
    let mut newton = Newton::new(layout, NewtonOptions::default()).unwrap();
    let found = newton.solve(&mut state, &terms).unwrap();
    assert!(found.floor.force > 1e-5, "{:?}", found.floor);
    assert!(found.residual.force <= 1e-8, "{:?}", found.residual);
    // The spring extends by 0.1 pN / (1e-3 pN/nm) / 1000.
    let end = state.points.position.get(1);
    assert!((end - Vector3::z() * -1.1).norm() < 1e-4, "{end}");
}

/// Not the stretched state of an excursion.
#[test]
fn too_few_steps_keep_the_best_state() {
    // With both ends held, a straight step stretches the filament.
    let mut state = ACTIN.state();
    state.points.hold(ACTIN.segments);
    state.frames.hold(ACTIN.segments);
    let control = state.add_control(20.0);
    let middle = vec![(ACTIN.segments / 2, 1.0)];
    let mut terms = ACTIN.interactions();
    let load = PointLoad::new(&state, middle, Vector3::x(), control).unwrap();
    terms.push(Box::new(load));
    let start: f64 = terms.iter().map(|term| term.energy(&state)).sum();
    let options = NewtonOptions {
        iterations: 1,
        ..NewtonOptions::default()
    };
    let mut newton = Newton::new(ACTIN.layout(&state), options).unwrap();
    let failure = newton.solve(&mut state, &terms).unwrap_err();
    assert_eq!(failure.cause, SolveError::IterationLimit(1));
    assert_eq!(failure.history.len(), 1);
    assert_eq!(failure.history[0].verdict, Verdict::Excursion);
    let end: f64 = terms.iter().map(|term| term.energy(&state)).sum();
    assert!(end <= start);
    assert_eq!(failure.residual, newton.residual(&state, &terms));
    let message = failure.to_string();
    assert!(
        message.contains("after 1 steps: 1 steps were not enough"),
        "{message}"
    );
    assert!(message.contains("2.000e1 pN"), "{message}");
}

#[test]
fn unsuitable_interactions_are_refused() {
    #[derive(Debug)]
    struct Wind(bool);
    impl Interaction for Wind {
        fn term(&self) -> &'static str {
            "wind"
        }
        fn add_loads(&self, _: &State, _: &mut Loads) {}
        fn elements(&self) -> usize {
            0
        }
        fn write_energies(&self, _: &State, _: &mut [f64]) {}
        fn is_conservative(&self) -> bool {
            self.0
        }
    }
    let mut state = State::default();
    point(&mut state, Vector3::zeros());
    let mut newton = Newton::new(Layout::free(&state), NewtonOptions::default()).unwrap();
    let mut cause = |wind| {
        let failure = newton.solve(&mut state, &[Box::new(Wind(wind))]);
        failure.unwrap_err().cause
    };
    assert_eq!(cause(false), SolveError::NotConservative("wind"));
    assert_eq!(cause(true), SolveError::NoStiffness("wind"));
}

#[test]
fn a_start_that_is_not_finite_is_refused() {
    let (mut state, terms) = ACTIN.loaded(Vector3::x(), 1.0);
    state.points.position.set(3, Vector3::repeat(f64::NAN));
    let failure = ACTIN.newton(&state).solve(&mut state, &terms).unwrap_err();
    assert_eq!(failure.cause, SolveError::NotFinite);
}

#[test]
fn a_state_without_unknowns_is_converged() {
    let mut state = State::default();
    point(&mut state, Vector3::zeros());
    state.points.hold(0);
    let mut newton = Newton::new(Layout::free(&state), NewtonOptions::default()).unwrap();
    let equilibrium = newton.solve(&mut state, &[]).unwrap();
    assert_eq!(equilibrium.ending, Convergence::Converged);
    assert_eq!(newton.lowest_mode(&state, &[]).unwrap(), None);
}

#[test]
fn options_are_checked() {
    type Spoil = fn(&mut NewtonOptions);
    let state = State::default();
    let cases: [(Spoil, _); 3] = [
        (
            |options| options.largest_rotation = 4.0,
            "largest_rotation must be positive and below pi, but is 4",
        ),
        (
            |options| options.turn_length = 0.0,
            "turn_length must be positive, but is 0",
        ),
        (
            |options| options.largest_displacement = f64::NAN,
            "largest_displacement must be positive, but is NaN",
        ),
    ];
    for (spoil, message) in cases {
        let mut options = NewtonOptions::default();
        spoil(&mut options);
        let refused = Newton::new(Layout::free(&state), options).unwrap_err();
        assert_eq!(refused.to_string(), message);
    }
}

/// A search for a shift would not end.
#[test]
fn stiffness_without_scale_is_refused() {
    for stiffness in [1.5e308, 1e306, 1e200, 1e-200, 1e-307, 1e-320, 0.0] {
        let mut state = State::default();
        for z in [0.0, 1.0, 2.0] {
            point(&mut state, Vector3::z() * z);
        }
        state.points.hold(0);
        let control = state.add_control(1.0);
        let load = PointLoad::new(&state, vec![(2, 1.0)], Vector3::z(), control).unwrap();
        let mut terms: Terms = vec![Box::new(load)];
        if stiffness > 0.0 {
            let both = vec![(0, 1, stiffness, 1.0), (1, 2, stiffness, 1.0)];
            terms.push(springs(&state, both));
        }
        let layout = Layout::new(&state, Some(&in_order(&state))).unwrap();
        let mut newton = Newton::new(layout, NewtonOptions::default()).unwrap();
        let result = newton.solve(&mut state, &terms);
        assert!(newton.work().iterations <= 300, "{stiffness:e}");
        assert!(newton.work().evaluations < 300 * 100, "{stiffness:e}");
        if let (1.5e308 | 0.0, result) = (stiffness, result) {
            let cause = result.unwrap_err().cause;
            let is_said = matches!(
                cause,
                SolveError::NotFactorizable(_) | SolveError::NotFinite
            );
            assert!(is_said, "{stiffness:e}: {cause}");
        }
    }
}

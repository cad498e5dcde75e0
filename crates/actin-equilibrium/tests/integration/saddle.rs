//! Saddles and lowest modes.

use crate::common;
use actin_equilibrium::{Iteration, Layout, Newton, NewtonOptions, Stability, StepSize};
use actin_mechanics::{
    Coordinates, Interaction, Loads, PointLoad, SecondOrder, State, Stiffness, Vector3,
};
use actin_mechanics::{Xorshift, perturb};
use common::{COLUMN, point, springs};
use nalgebra::{DMatrix, SymmetricEigen};

type Terms = Vec<Box<dyn Interaction>>;

fn compressed(force: f64) -> (State, Terms) {
    COLUMN.loaded(Vector3::z() * -force, 1.0)
}

fn dense_spectrum(newton: &mut Newton, state: &State, terms: &Terms) -> Vec<f64> {
    let n = newton.layout().unknowns();
    let mut matrix = DMatrix::zeros(n, n);
    for column in 0..n {
        let mut unit = vec![0.0; n];
        unit[column] = 1.0;
        let product = newton.stiffness_times(state, terms, &unit).unwrap();
        matrix.column_mut(column).copy_from_slice(&product);
    }
    let length = newton.options().turn_length;
    let mut weight = vec![1.0; n];
    for i in 0..state.frames.len() {
        if let Some(range) = newton.layout().unknowns_of(Coordinates::Frame(i)) {
            weight[range].fill(1.0 / length);
        }
    }
    let scaled = DMatrix::from_fn(n, n, |i, j| matrix[(i, j)] * weight[i] * weight[j]);
    let mut values: Vec<f64> = SymmetricEigen::new(scaled)
        .eigenvalues
        .iter()
        .copied()
        .collect();
    values.sort_by(f64::total_cmp);
    values
}

#[test]
fn certificate_and_lowest_mode_agree_with_a_dense_solver() {
    for (force, noise, turn_length) in [(1.0, 0.0, 1.0), (8.0, 0.0, 1.0), (40.0, 0.1, 3.0)] {
        let (mut state, terms) = compressed(force);
        perturb(&mut state, &mut Xorshift::new(1), noise, noise);
        let options = NewtonOptions {
            turn_length,
            ..NewtonOptions::default()
        };
        let mut newton = Newton::new(COLUMN.layout(&state), options).unwrap();
        let certificate = newton.certify(&state, &terms).unwrap();
        let spectrum = dense_spectrum(&mut newton, &state, &terms);
        let negative = spectrum.iter().filter(|&&value| value < 0.0).count();
        assert_eq!(certificate.negative, negative, "{force} pN");
        assert_eq!(certificate.unresolved, 0);
        let mode = newton.lowest_mode(&state, &terms).unwrap().unwrap();
        let accuracy = mode.error + 1e-15 * spectrum[spectrum.len() - 1] * 100.0;
        let error = (mode.eigenvalue - spectrum[0]).abs();
        assert!(error <= accuracy, "{} not {}", mode.eigenvalue, spectrum[0]);
    }
}

/// Euler loads: (2 n - 1)^2 pi^2 B / (4 L^2) = 2.89 pN and 3.76 pN; the next are nine times larger.
#[test]
fn a_straight_column_beyond_the_euler_load_is_a_saddle() {
    for (force, negative) in [(2.0, 0), (3.3, 1), (8.0, 2), (28.0, 3)] {
        let (mut state, terms) = compressed(force);
        let mut newton = COLUMN.newton(&state);
        let equilibrium = newton.solve(&mut state, &terms).unwrap();
        let tip = COLUMN.tip(&state);
        assert!(tip.x.abs() + tip.y.abs() < 1e-9, "it stays straight");
        assert_eq!(equilibrium.is_saddle(), negative > 0);
        assert_eq!(equilibrium.certificate.unwrap().negative, negative);
    }
}

#[test]
fn a_saddle_is_left_along_its_lowest_mode() {
    let (mut state, terms) = compressed(8.0);
    let energy = |state: &State| terms.iter().map(|term| term.energy(state)).sum::<f64>();
    let mut newton = COLUMN.newton(&state);
    newton.solve(&mut state, &terms).unwrap();
    let saddle = energy(&state);
    let mode = newton.leave_saddle(&mut state, &terms).unwrap().unwrap();
    assert!(mode.eigenvalue < -mode.error);
    assert!(energy(&state) < saddle);

    let (mut state, _) = compressed(8.0);
    let equilibrium = newton.minimize(&mut state, &terms, 3).unwrap();
    assert!(equilibrium.saddles_left >= 1);
    let is_indefinite = |step: &Iteration| step.negative_pivots > 0;
    assert!(equilibrium.history.iter().any(is_indefinite));
    let stability = equilibrium.certificate.unwrap().stability();
    assert_eq!(stability, Stability::Stable);
    assert!(equilibrium.energy < saddle - 1.0);
    let tip = COLUMN.tip(&state);
    assert!(tip.x.abs() > 50.0 && tip.y.abs() < 1e-6, "{tip}");
}

#[test]
fn a_minimum_is_not_left() {
    let (mut state, terms) = compressed(1.0);
    let mut newton = COLUMN.newton(&state);
    newton.solve(&mut state, &terms).unwrap();
    let before = state.clone();
    assert_eq!(newton.leave_saddle(&mut state, &terms).unwrap(), None);
    assert_eq!(state, before);
}

fn disturbed(straight: &State) -> State {
    let mut state = straight.clone();
    perturb(&mut state, &mut Xorshift::new(4), 1e-3, 1e-4);
    state
        .points
        .position
        .set(0, straight.points.position.get(0));
    let wall = straight.frames.orientation.get(0);
    state.frames.orientation.set(0, wall);
    state
}

/// Minimum below the Euler load, saddle above.
#[test]
fn the_nearest_equilibrium_may_be_a_saddle() {
    for (force, negative) in [(2.0, 0), (8.0, 2)] {
        let (straight, terms) = compressed(force);
        let mut newton = COLUMN.newton(&straight);
        let near = disturbed(&straight);
        let nearest = newton.nearest(&near, &terms).unwrap().unwrap();
        let tip = COLUMN.tip(&nearest.state);
        assert!(tip.x.abs() + tip.y.abs() < 1e-6, "{tip}");
        assert_eq!(nearest.certificate.negative, negative, "{force} pN");
        let energy = |state: &State| terms.iter().map(|term| term.energy(state)).sum::<f64>();
        let above = energy(&near) - energy(&nearest.state);
        // Rounding of energies of about 100 pN nm.
        assert!((nearest.energy_above - above).abs() < 1e-11, "{above}");
        let residual = newton.residual(&nearest.state, &terms);
        assert!(residual.force < 1e-7 && residual.torque < 1e-7);
    }
    let (mut state, terms) = compressed(8.0);
    let mut newton = COLUMN.newton(&state);
    state = disturbed(&state);
    let equilibrium = newton.solve(&mut state, &terms).unwrap();
    assert!(!equilibrium.is_saddle(), "{:?}", COLUMN.tip(&state));
}

/// Two free points on a spring under a force.
#[test]
fn an_accelerating_body_has_no_nearest_equilibrium() {
    let mut state = State::default();
    point(&mut state, Vector3::zeros());
    point(&mut state, Vector3::x() * 3.0);
    let control = state.add_control(1.0);
    let load = PointLoad::new(&state, vec![(1, 1.0)], Vector3::x() * 0.5, control).unwrap();
    let terms: Terms = vec![springs(&state, vec![(1, 0, 10.0, 3.0)]), Box::new(load)];
    let mut newton = Newton::new(Layout::free(&state), NewtonOptions::default()).unwrap();
    assert_eq!(newton.nearest(&state, &terms).unwrap(), None);
}

#[test]
fn a_push_has_the_requested_size() {
    let (mut state, terms) = compressed(8.0);
    let mut newton = COLUMN.newton(&state);
    newton.solve(&mut state, &terms).unwrap();
    let energy = |state: &State| terms.iter().map(|term| term.energy(state)).sum::<f64>();
    for (displacement, rotation) in [(0.01, 1.0), (10.0, 1e-4)] {
        let largest = StepSize {
            displacement,
            rotation,
            strain: 0.0,
        };
        let mut pushed = state.clone();
        let velocity = Vector3::new(1.0, 2.0, 3.0);
        pushed.points.velocity.set(5, velocity);
        let push = newton.push_off_saddle(&mut pushed, &terms, &largest);
        let push = push.unwrap().unwrap();
        let reached =
            (push.extent.displacement / displacement).max(push.extent.rotation / rotation);
        assert!((reached - 1.0).abs() < 1e-12, "{reached}");
        let moved =
            |i: usize| (pushed.points.position.get(i) - state.points.position.get(i)).norm();
        let largest_moved = (0..17).map(moved).fold(0.0, f64::max);
        assert!((largest_moved / push.extent.displacement - 1.0).abs() < 1e-9);
        assert!(energy(&pushed) < energy(&state));
        assert_eq!(pushed.points.velocity.get(5), velocity);
    }
    let (mut state, terms) = compressed(1.0);
    newton.solve(&mut state, &terms).unwrap();
    let before = state.clone();
    let none = newton.push_off_saddle(&mut state, &terms, &StepSize::default());
    assert_eq!((none.unwrap(), state), (None, before));
}

/// Forbids motions of the tip above a distance (nm).
#[derive(Debug)]
struct Cage(f64);

impl Interaction for Cage {
    fn term(&self) -> &'static str {
        "cage"
    }

    fn elements(&self) -> usize {
        0
    }

    fn add_loads(&self, _state: &State, _loads: &mut Loads) {}

    fn write_energies(&self, _state: &State, _energies: &mut [f64]) {}

    fn second_order(&self) -> Option<&dyn SecondOrder> {
        Some(self)
    }

    fn passes_through(&self, from: &State, to: &State) -> Option<Coordinates> {
        let tip = from.points.len() - 1;
        let moved = to.points.position.get(tip) - from.points.position.get(tip);
        (moved.norm() > self.0).then_some(Coordinates::Point(tip))
    }
}

impl SecondOrder for Cage {
    fn add_stiffness(&self, _state: &State, _stiffness: &mut Stiffness) {}
}

/// A displacement moves no body through another one. Amplitudes are halved four times from 1e-3 nm.
#[test]
fn a_displacement_stays_within_a_cage() {
    let (mut straight, terms) = compressed(8.0);
    let mut newton = COLUMN.newton(&straight);
    newton.solve(&mut straight, &terms).unwrap();
    let mut free = straight.clone();
    newton.leave_saddle(&mut free, &terms).unwrap().unwrap();
    let moved = |state: &State| (COLUMN.tip(state) - COLUMN.tip(&straight)).norm();
    assert!(moved(&free) > 0.1);
    for (cage, moves) in [(1e-2, true), (3e-4, true), (1e-6, false)] {
        let (mut state, mut terms) = (straight.clone(), compressed(8.0).1);
        terms.push(Box::new(Cage(cage)));
        let mut newton = COLUMN.newton(&state);
        let mode = newton.leave_saddle(&mut state, &terms).unwrap();
        assert_eq!(mode.is_some(), moves, "{cage}");
        assert!(moved(&state) <= cage && (moved(&state) > 0.1 * cage) == moves);
        let push = StepSize {
            displacement: 0.01,
            rotation: 1e-3,
            strain: 0.0,
        };
        let mut state = straight.clone();
        let pushed = newton.push_off_saddle(&mut state, &terms, &push).unwrap();
        assert_eq!(pushed.is_some(), cage > 1e-3, "{cage}");
        assert!(moved(&state) <= cage);
    }
}

/// A displacement is at most as large as a step.
#[test]
fn a_displacement_respects_the_limits_of_steps() {
    let (mut straight, terms) = compressed(8.0);
    COLUMN
        .newton(&straight)
        .solve(&mut straight, &terms)
        .unwrap();
    for (largest_displacement, largest_rotation) in [(1e-5, 0.5), (0.02, 0.5), (1.0, 1e-4)] {
        let mut state = straight.clone();
        let options = NewtonOptions {
            largest_displacement,
            largest_rotation,
            ..NewtonOptions::default()
        };
        let mut newton = Newton::new(COLUMN.layout(&state), options).unwrap();
        newton.leave_saddle(&mut state, &terms).unwrap().unwrap();
        let (points, turns) = (&state.points.position, &state.frames.orientation);
        let moved = |i: usize| (points.get(i) - straight.points.position.get(i)).norm();
        let turned = |i: usize| turns.get(i).angle_to(&straight.frames.orientation.get(i));
        let displacement = (0..points.len()).map(moved).fold(0.0, f64::max);
        let rotation = (0..turns.len()).map(turned).fold(0.0, f64::max);
        let part = (displacement / largest_displacement).max(rotation / largest_rotation);
        assert!(part > 0.5 && part < 1.0 + 1e-6, "{part}");
    }
}

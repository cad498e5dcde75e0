//! Sliders and layouts.

use crate::common;
use actin_equilibrium::{Layout, Newton, NewtonOptions};
use actin_mechanics::{Interaction, PointLoad, State, Vector3, rotation};
use common::{filament, in_order, point, push_slider, springs};

type Terms = Vec<Box<dyn Interaction>>;

/// Rotates the last two monomers about z and shifts them along z.
fn move_pair(state: &mut State, n: usize, turn: f64, shift: f64) {
    let turn = rotation::exp(Vector3::z() * turn);
    for i in [n - 2, n - 1] {
        let x = turn * state.points.position.get(i) + Vector3::z() * shift;
        state.points.position.set(i, x);
        let q = turn * state.frames.orientation.get(i);
        state.frames.orientation.set(i, q);
    }
}

/// Twisted filament whose last pair slides along `directions`.
fn twisted(directions: Vec<Vector3>, shift: f64) -> (State, f64, Newton) {
    let n = 14;
    let (mut state, bonds) = filament(n, 24, 2);
    move_pair(&mut state, n, 0.4, shift);
    for i in [n - 2, n - 1] {
        state.frames.hold(i);
    }
    push_slider(&mut state, vec![n - 2, n - 1], directions);
    let layout = Layout::new(&state, Some(&in_order(&state))).unwrap();
    let terms: Terms = vec![Box::new(bonds)];
    let mut newton = Newton::new(layout, NewtonOptions::default()).unwrap();
    let equilibrium = newton.solve(&mut state, &terms).unwrap();
    assert!(!equilibrium.is_saddle());
    (state, equilibrium.energy, newton)
}

#[test]
fn a_sliding_pair_finds_the_place_of_least_energy() {
    let (state, energy, newton) = twisted(vec![Vector3::z()], 0.0);
    assert_eq!(newton.layout().unknowns(), 10 * 6 + 1);
    let rest = filament(14, 24, 2).0;
    let shift = state.points.position.get(13).z - rest.points.position.get(13).z;
    let turned = rotation::exp(Vector3::z() * 0.4) * rest.points.position.get(13);
    let off = state.points.position.get(13) - turned;
    assert!(off.x.abs() + off.y.abs() < 1e-12, "it slides along z only");
    assert!(shift.abs() > 1e-4, "twist changes the length");

    let h = 1e-3;
    let [before, there, behind] = [-h, 0.0, h].map(|step| twisted(vec![], shift + step).1);
    assert!((there - energy).abs() < 1e-9 * energy);
    let slope = (behind - before) / (2.0 * h);
    let curvature = (behind - 2.0 * there + before) / (h * h);
    assert!(curvature > 0.0);
    // Third derivatives shift the minimum by h^2.
    assert!((slope / curvature).abs() < 1e-5, "{slope} {curvature}");
}

#[test]
fn forces_move_a_slider_along_its_direction() {
    let mut state = State::default();
    for x in [0.0, 1.0, 2.0] {
        point(&mut state, Vector3::x() * x);
    }
    state.points.hold(0);
    push_slider(&mut state, vec![1, 2], vec![Vector3::x()]);
    let control = state.add_control(1.0);
    let load =
        PointLoad::new(&state, vec![(2, 1.0)], Vector3::new(3.0, 9.0, 0.0), control).unwrap();
    let terms: Terms = vec![springs(&state, vec![(0, 1, 6.0, 1.0)]), Box::new(load)];
    let mut newton = Newton::new(Layout::free(&state), NewtonOptions::default()).unwrap();
    newton.solve(&mut state, &terms).unwrap();
    for (i, x) in [(1, 1.5), (2, 2.5)] {
        let expected = Vector3::new(x, 0.0, 0.0);
        assert!((state.points.position.get(i) - expected).norm() < 1e-9);
    }
}

#[test]
fn tied_ends_do_not_fill_the_factor() {
    let entries = |n: usize| {
        let (mut state, bonds) = filament(n, 4, 1);
        push_slider(&mut state, vec![2, n - 1], vec![Vector3::x(), Vector3::z()]);
        let layout = Layout::new(&state, Some(&in_order(&state))).unwrap();
        let mut newton = Newton::new(layout, NewtonOptions::default()).unwrap();
        let equilibrium = newton.solve(&mut state, &[Box::new(bonds)]).unwrap();
        equilibrium.work.factor_entries
    };
    let (small, large) = (entries(100), entries(200));
    assert!(large < 21 * small / 10, "{small} {large}");
}

#[test]
fn difference_inverts_apply() {
    let (mut state, _) = filament(6, 1, 1);
    let direction = Vector3::new(1.0, 2.0, 2.0) / 3.0;
    push_slider(&mut state, vec![4, 5], vec![direction]);
    let layout = Layout::new(&state, Some(&in_order(&state))).unwrap();
    let step: Vec<f64> = (0..layout.unknowns())
        .map(|i| 0.3 * (i as f64).sin())
        .collect();
    let mut moved = state.clone();
    layout.apply(&mut moved, &step, 1.0);
    let back = layout.difference(&state, &moved);
    for (there, back) in step.iter().zip(&back) {
        assert!((there - back).abs() < 1e-13);
    }
}

#[test]
fn mistakes_are_refused() {
    let (state, _) = filament(4, 1, 1);
    let mut tied = state.clone();
    for points in [vec![2, 3], vec![3]] {
        push_slider(&mut tied, points, vec![Vector3::z()]);
    }
    let message = "point 3 belongs to slider 0 and to slider 1: remove it from one of them";
    assert_eq!(Layout::new(&tied, None).unwrap_err().to_string(), message);
    let mut order = in_order(&state);
    order.points[2] = f64::NAN;
    let error = Layout::new(&state, Some(&order)).unwrap_err();
    let message = "the position of Point(2) in the order must be finite, but is NaN";
    assert_eq!(error.to_string(), message);
    order.points.pop();
    let error = Layout::new(&state, Some(&order)).unwrap_err();
    assert_eq!(error.to_string(), "the order has 3 numbers for 4 points");
}

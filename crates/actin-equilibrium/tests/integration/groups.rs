//! Groups and layouts.

use crate::common;
use actin_equilibrium::{Group, Layout, LayoutError, Newton, NewtonOptions, Pivot, Stability};
use actin_mechanics::{Coordinates, Interaction, PointLoad, Slider, State, Vector3, rotation};
use common::{filament, frame, in_order, point, springs};

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

fn twisted(groups: Vec<Group>, shift: f64) -> (State, f64, Newton) {
    let n = 14;
    let (mut state, bonds) = filament(n, 24, 2);
    move_pair(&mut state, n, 0.4, shift);
    let layout = Layout::new(&state, Some(&in_order(&state)), groups).unwrap();
    let terms: Terms = vec![Box::new(bonds)];
    let mut newton = Newton::new(layout, NewtonOptions::default()).unwrap();
    let equilibrium = newton.solve(&mut state, &terms).unwrap();
    assert!(!equilibrium.is_saddle());
    (state, equilibrium.energy, newton)
}

#[test]
fn a_sliding_pair_finds_the_place_of_least_energy() {
    let bodies = vec![12, 13];
    let sliding = Group::sliding(bodies.clone(), bodies.clone(), Vector3::z());
    let (state, energy, newton) = twisted(vec![sliding], 0.0);
    assert_eq!(newton.layout().unknowns(), 10 * 6 + 1);
    let rest = filament(14, 24, 2).0;
    let shift = state.points.position.get(13).z - rest.points.position.get(13).z;
    let turned = rotation::exp(Vector3::z() * 0.4) * rest.points.position.get(13);
    let off = state.points.position.get(13) - turned;
    assert!(off.x.abs() + off.y.abs() < 1e-12, "it slides along z only");
    assert!(shift.abs() > 1e-4, "twist changes the length");

    let held = || Group {
        translations: vec![],
        ..Group::sliding(bodies.clone(), bodies.clone(), Vector3::z())
    };
    let h = 1e-3;
    let [before, there, behind] = [-h, 0.0, h].map(|step| twisted(vec![held()], shift + step).1);
    assert!((there - energy).abs() < 1e-9 * energy);
    let slope = (behind - before) / (2.0 * h);
    let curvature = (behind - 2.0 * there + before) / (h * h);
    assert!(curvature > 0.0);
    // Third derivatives shift the minimum by h^2.
    assert!((slope / curvature).abs() < 1e-5, "{slope} {curvature}");
}

#[test]
fn sliding_bodies_of_the_state_are_groups() {
    let mut state = State::default();
    for x in [0.0, 1.0, 2.0] {
        let i = point(&mut state, Vector3::x() * x);
        state.points.hold(i);
    }
    state.sliders.push(Slider {
        points: vec![1, 2],
        directions: vec![Vector3::x()],
        mass: 0.1394,
    });
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
fn a_rigid_group_turns_into_the_force() {
    let mut state = State::default();
    point(&mut state, Vector3::zeros());
    point(&mut state, Vector3::new(0.5, 0.0, 0.0));
    point(&mut state, Vector3::new(0.5, 8.0, 6.0));
    frame(&mut state, rotation::exp(Vector3::new(0.3, 0.2, 0.1)));
    state.points.hold(0);
    let control = state.add_control(1.0);
    let bar = Group::rigid(vec![1, 2], vec![0]);
    let relative = state.frames.orientation.get(0).inverse() * Vector3::new(0.0, 8.0, 6.0);
    let load = PointLoad::new(
        &state,
        vec![(2, 1.0)],
        Vector3::new(0.0, 1.0, -3.0),
        control,
    )
    .unwrap();
    let terms: Terms = vec![springs(&state, vec![(0, 1, 20.0, 0.5)]), Box::new(load)];
    let layout = Layout::new(&state, None, vec![bar]).unwrap();
    let mut newton = Newton::new(layout, NewtonOptions::default()).unwrap();
    let equilibrium = newton.minimize(&mut state, &terms, 3).unwrap();
    let (x1, x2) = (state.points.position.get(1), state.points.position.get(2));
    let direction = Vector3::new(0.0, 1.0, -3.0).normalize();
    assert!(((x2 - x1) / 10.0 - direction).norm() < 1e-8, "{x1} {x2}");
    let stretched = 0.5 + 10.0f64.sqrt() / 20.0;
    assert!((x1 - direction * stretched).norm() < 1e-8, "{x1}");
    let carried = state.frames.orientation.get(0) * relative;
    assert!((carried - (x2 - x1)).norm() < 1e-10);
    // The rotation about the bar is free.
    let stability = equilibrium.certificate.unwrap().stability();
    assert_eq!(stability, Stability::Neutral { modes: 1 });
}

#[test]
fn tied_ends_do_not_fill_the_factor() {
    let entries = |n: usize| {
        let (mut state, bonds) = filament(n, 4, 1);
        let bodies = vec![2, n - 1];
        let ring = Group::rigid(bodies.clone(), bodies);
        let layout = Layout::new(&state, Some(&in_order(&state)), vec![ring]).unwrap();
        let mut newton = Newton::new(layout, NewtonOptions::default()).unwrap();
        let equilibrium = newton.solve(&mut state, &[Box::new(bonds)]).unwrap();
        equilibrium.work.factor_entries
    };
    let (small, large) = (entries(100), entries(200));
    assert!(large < 21 * small / 10, "{small} {large}");
}

#[test]
fn directions_are_made_orthonormal() {
    let mut state = State::default();
    point(&mut state, Vector3::zeros());
    let group = Group {
        points: vec![0],
        frames: vec![],
        pivot: Pivot::Lab(Vector3::zeros()),
        translations: vec![Vector3::x() * 2.0, Vector3::new(1.0, 1.0, 0.0)],
        rotations: vec![],
    };
    let layout = Layout::new(&state, None, vec![group]).unwrap();
    let directions = &layout.groups()[0].translations;
    assert!((directions[0] - Vector3::x()).norm() < 1e-15);
    assert!((directions[1] - Vector3::y()).norm() < 1e-15);
}

#[test]
fn difference_inverts_apply() {
    let (state, _) = filament(6, 1, 1);
    let groups = vec![
        Group::rigid(vec![3, 4], vec![3, 4]),
        Group::sliding(vec![5], vec![5], Vector3::new(1.0, 2.0, 2.0)),
    ];
    let layout = Layout::new(&state, Some(&in_order(&state)), groups).unwrap();
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
    let refused = |groups| Layout::new(&state, None, groups).unwrap_err();
    let slide = |points, frames| Group::sliding(points, frames, Vector3::z());
    assert_eq!(
        refused(vec![slide(vec![4], vec![])]),
        LayoutError::UnknownBody {
            group: 0,
            body: Coordinates::Point(4)
        }
    );
    assert_eq!(
        refused(vec![slide(vec![], vec![3]), slide(vec![], vec![3])]).to_string(),
        "Frame(3) belongs to group 0 and to group 1: remove it from one of them"
    );
    let flat = Group {
        rotations: vec![Vector3::x(), Vector3::x()],
        ..slide(vec![3], vec![])
    };
    let message = refused(vec![flat]).to_string();
    assert!(message.starts_with("the rotations of group 0 must be independent"));
    let mut order = in_order(&state);
    order.points[2] = f64::NAN;
    let error = Layout::new(&state, Some(&order), vec![]).unwrap_err();
    let message = "the position of Point(2) in the order must be finite, but is NaN";
    assert_eq!(error.to_string(), message);
    order.points.pop();
    let error = Layout::new(&state, Some(&order), vec![]).unwrap_err();
    assert_eq!(error.to_string(), "the order has 3 numbers for 4 points");
}

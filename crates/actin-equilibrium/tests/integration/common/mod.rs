//! Rods, filaments and springs for tests.
#![allow(dead_code, unused_imports, reason = "the example uses some of them")]

mod rod;

pub(crate) use rod::{ACTIN, COLUMN, Rod};

use actin_ellipsoid::{Bonds, EllipsoidModel, EllipsoidParameters, Placement};
use actin_equilibrium::{BodyOrder, Layout, Newton, NewtonOptions};
use actin_mechanics::testing::{push_frame, push_point};
use actin_mechanics::{
    Interaction, Point, Slider, Spring, Springs, State, UnitQuaternion, Vector3,
};

/// `n` monomers along z, the first two held, with `bonds` sampled bonds per interface.
pub(crate) fn filament(n: usize, bonds: usize, seed: u64) -> (State, Bonds) {
    let model = EllipsoidModel::new(EllipsoidParameters::with_sampled_bonds(bonds, seed)).unwrap();
    let mut state = State::default();
    let monomers = model
        .build(&mut state, &Placement::default(), 0, n)
        .unwrap();
    for i in 0..2 {
        state.points.hold(i);
        state.frames.hold(i);
    }
    (state, model.bonds(&monomers).unwrap())
}

/// Two points, stiffness and rest length each.
pub(crate) fn springs(state: &State, all: Vec<(usize, usize, f64, f64)>) -> Box<dyn Interaction> {
    let spring = |(a, b, stiffness, rest_length)| Spring {
        points: [a, b],
        stiffness,
        rest_length,
    };
    Box::new(Springs::new(state, all.into_iter().map(spring).collect()).unwrap())
}

/// Five points along z with springs of 10 pN/nm at rest; the first is held.
pub(crate) fn chain() -> (State, Vec<Box<dyn Interaction>>) {
    let mut state = State::default();
    for z in 0..5 {
        point(&mut state, Vector3::z() * f64::from(z));
    }
    state.points.hold(0);
    let links = (0..4).map(|i| (i, i + 1, 10.0, 1.0)).collect();
    let springs = springs(&state, links);
    (state, vec![springs])
}

pub(crate) fn point(state: &mut State, position: Vector3) -> usize {
    push_point(state, position, 0.0697)
}

pub(crate) fn frame(state: &mut State, orientation: UnitQuaternion) -> usize {
    push_frame(state, orientation, [1.0, 1.0, 2.0])
}

/// Holds `points` and lets them slide together along `directions`.
pub(crate) fn push_slider(state: &mut State, points: Vec<usize>, directions: Vec<Vector3>) {
    for &i in &points {
        state.points.hold(i);
    }
    state.sliders.push(Slider {
        points,
        directions,
        mass: 1.0,
    });
}

pub(crate) fn in_order(state: &State) -> BodyOrder {
    BodyOrder {
        points: (0..state.points.len()).map(|i| i as f64).collect(),
        frames: (0..state.frames.len()).map(|i| i as f64).collect(),
    }
}

/// Asserts that the stiffness is the derivative of the loads.
///
/// Along `apply(step, t)` the work of the loads has the derivative `-step . K step`.
pub(crate) fn assert_is_second_derivative(
    interactions: &[Box<dyn Interaction>],
    state: &State,
    layout: Layout,
    relative: f64,
) {
    use actin_mechanics::Xorshift;
    use actin_mechanics::testing::derivative;
    let n = layout.unknowns();
    let mut newton = Newton::new(layout, NewtonOptions::default()).unwrap();
    newton.certify(state, interactions).unwrap();
    let mut noise = Xorshift::new(3);
    for _ in 0..20 {
        let step: Vec<f64> = (0..n).map(|_| noise.sample()).collect();
        let work = |t: f64| {
            let mut moved = state.clone();
            newton.layout().apply(&mut moved, &step, t);
            let loads = newton.generalised_loads(&moved, interactions);
            loads.iter().zip(&step).map(|(f, p)| f * p).sum::<f64>()
        };
        let difference = -derivative(1e-3, work);
        let product = newton.stiffness_times(state, interactions, &step).unwrap();
        let analytic: f64 = product.iter().zip(&step).map(|(k, p)| k * p).sum();
        assert!(
            (analytic - difference).abs() <= relative * difference.abs().max(1.0),
            "{analytic} against {difference}"
        );
    }
}

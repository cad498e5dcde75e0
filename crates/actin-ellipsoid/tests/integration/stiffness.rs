//! Stiffness of bonds.

use crate::common;
use actin_mechanics::testing::{assert_is_stiffness, loads_of, stiffness_matrix};
use actin_mechanics::{State, Vector3};
use actin_mechanics::{Xorshift, perturb};
use common::{filament, model, models, weighted};
use nalgebra::DVector;

/// The shortest bonds are 0.16 nm long, so the relative error of eight-point differences with a
/// step of 1e-3 nm is (1e-3 / 0.16)^8; rounding is 1e-14 of the loads over 1e-3.
#[test]
fn stiffness_is_the_derivative_of_the_loads() {
    for count in [2, 5, 11] {
        for seed in 0..4 {
            for model in models(seed) {
                let (mut state, _, bonds) = filament(&model, count);
                assert_is_stiffness(&bonds, &state, 1e-3, 1e-9);
                perturb(&mut state, &mut Xorshift::new(seed), 0.5, 0.3);
                assert_is_stiffness(&bonds, &state, 1e-3, 1e-9);
            }
        }
    }
}

fn stacked(
    state: &State,
    point: impl Fn(usize) -> Vector3,
    frame: impl Fn(usize) -> Vector3,
) -> DVector<f64> {
    let points = (0..state.points.len()).map(point);
    let both = points.chain((0..state.frames.len()).map(frame));
    DVector::from_vec(both.flat_map(|v| [v.x, v.y, v.z]).collect())
}

/// A rotation `omega` rotates the gradient in the lab frame, `omega x g` with `g = -f`, and leaves
/// `tau x Q^T omega / 2` in the chart of the frames.
#[test]
fn rigid_motion_only_rotates_the_loads() {
    let drawn = (0..5).map(|seed| model(seed, 16));
    for (seed, model) in (0..).zip(drawn.chain([weighted(12)])) {
        let (mut state, _, bonds) = filament(&model, 20);
        perturb(&mut state, &mut Xorshift::new(seed), 0.5, 0.3);
        let stiffness = stiffness_matrix(&bonds, &state);
        let loads = loads_of(&bonds, &state);
        for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
            let shift = stacked(&state, |_| axis, |_| Vector3::zeros());
            assert!((&stiffness * shift).amax() < 1e-14 * stiffness.amax());
            let body = |i| state.frames.orientation.get(i).inverse() * axis;
            let turn = stacked(&state, |i| axis.cross(&state.points.position.get(i)), body);
            let expected = stacked(
                &state,
                |i| -axis.cross(&loads.force.get(i)),
                |i| 0.5 * loads.torque.get(i).cross(&body(i)),
            );
            let tolerance = 1e-13 * stiffness.amax() * turn.amax();
            assert!((&stiffness * turn - &expected).amax() < tolerance);
            assert!(expected.amax() > 1e-2 * stiffness.amax(), "loads matter");
        }
    }
}

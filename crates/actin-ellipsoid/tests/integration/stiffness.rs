//! Second derivatives of bonds: those of the energy, near rest and far from it.

use crate::common;
use actin_mechanics::testing::{assert_is_stiffness, loads_of, stiffness_matrix};
use actin_mechanics::{State, Vector3};
use actin_mechanics::{Xorshift, perturb};
use common::{filament, model, models, weighted};
use nalgebra::DVector;

/// Far from rest, where loads are large: a missing turn of second order, or a torque that belongs
/// to the other body's frame, would show. The shortest bonds measure 0.16 nm, so the eight-point
/// difference with a step of 1e-3 nm has an error of (1e-3 / 0.16)^8 times the stiffness, and its
/// round-off is 1e-14 of the loads by 1e-3: both below 1e-10. At rest there is no load and no geometric part.
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

/// The same three numbers for each point, then for each frame.
fn stacked(
    state: &State,
    point: impl Fn(usize) -> Vector3,
    frame: impl Fn(usize) -> Vector3,
) -> DVector<f64> {
    let points = (0..state.points.len()).map(point);
    let both = points.chain((0..state.frames.len()).map(frame));
    DVector::from_vec(both.flat_map(|v| [v.x, v.y, v.z]).collect())
}

/// A filament moved as a whole has the same loads in its own frame: shifted, the stiffness gives
/// nothing; turned by `omega`, gradients turn along in the lab, `omega x g` with `g = -f`, and
/// stay what they are in the bodies, where the chart leaves `tau x Q^T omega / 2`. No differences
/// are taken, so only round-off is left, up to 1e-14 of the sum of a row's terms.
#[test]
fn rigid_motion_gives_the_turning_of_the_loads_only() {
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

//! Second derivatives of the gradient law.

use crate::common;
use actin_cosserat::{EnergyGradient, RodLayout, StraightRod};
use actin_mechanics::Xorshift;
use actin_mechanics::testing::{assert_is_stiffness, stiffness_matrix};
use actin_mechanics::{State, Vector3, rotation};
use common::{ALL_WALLS, material};
use nalgebra::DVector;

fn turned_pair(theta: Vector3) -> (State, RodLayout) {
    let mut state = State::default();
    let layout = StraightRod::uniform(2, 10.0).push(&mut state).unwrap();
    let first = rotation::exp(Vector3::new(0.4, -1.0, 0.3));
    state.frames.orientation.set(0, first);
    let second = first * rotation::exp(theta);
    state.frames.orientation.set(1, second);
    (state, layout)
}

/// Small and large angles, and 1.5 rad, where the slope of the coefficient changes its formula.
#[test]
fn stiffness_is_right_from_no_angle_to_3_rad() {
    let mut noise = Xorshift::new(12);
    for angle in [0.0, 1e-9, 1e-4, 0.1, 0.5, 1.49, 1.51, 2.5, 3.0] {
        for _ in 0..5 {
            let (state, layout) = turned_pair(noise.vector().normalize() * angle);
            let rod = EnergyGradient::new(layout, material());
            // Steps of 0.04 rad do not reach the discontinuity at pi.
            assert_is_stiffness(&rod, &state, 0.01, 1e-10);
        }
    }
}

/// Change of all coordinates by a translation or a rotation about the origin.
fn rigid_motion(state: &State, shift: Vector3, turn: Vector3) -> DVector<f64> {
    let points = state.points.position.iter().map(|x| shift + turn.cross(&x));
    let frames = &state.frames.orientation;
    let frames = (0..state.frames.len()).map(|i| frames.get(i).inverse() * turn);
    let rows: Vec<f64> = points.chain(frames).flat_map(|v| [v.x, v.y, v.z]).collect();
    DVector::from_vec(rows)
}

#[test]
fn only_rigid_motions_are_free_at_rest() {
    let mut noise = Xorshift::new(13);
    let mut state = State::default();
    let built = StraightRod {
        orientation: rotation::exp(noise.vector()),
        segment_lengths: vec![8.0, 12.0, 10.0, 9.0],
        walls: ALL_WALLS[3],
        ..StraightRod::uniform(0, 0.0)
    };
    let layout = built.push(&mut state).unwrap();
    let matrix = stiffness_matrix(&EnergyGradient::new(layout, material()), &state);
    let scale = matrix.amax();
    for k in 0..3 {
        let e = Vector3::ith(k, 1.0);
        for motion in [
            rigid_motion(&state, e, Vector3::zeros()),
            rigid_motion(&state, Vector3::zeros(), e),
        ] {
            // Round-off of a dozen products, each at most the largest entry times 39 nm.
            let residual = (&matrix * &motion).amax() / (scale * motion.amax());
            assert!(residual < 1e-14, "{residual:e}");
        }
    }
    let mut eigenvalues: Vec<f64> = matrix.symmetric_eigenvalues().iter().copied().collect();
    eigenvalues.sort_unstable_by(f64::total_cmp);
    let (zeros, others) = eigenvalues.split_at(6);
    assert!(zeros.iter().all(|z| z.abs() < 1e-13 * scale), "{zeros:?}");
    // The softest bending mode is far above round-off.
    assert!(others[0] > 1e-6 * scale, "{}", others[0]);
}

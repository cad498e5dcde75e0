//! Rotations of frames within a step.

use actin_mechanics::{State, UnitQuaternion, Vector3, rotation};
use std::f64::consts::TAU;

/// Rotation of a frame within a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turn {
    /// Orientation at half the rotation.
    pub(super) middle: UnitQuaternion,
    /// Rotation vector (rad), in axes of `middle`.
    pub(super) vector: Vector3,
    /// Rotation from the axes of the end to those of `vector` about the third axis (rad).
    pub(super) back: f64,
}

impl Turn {
    /// Rotation of frame `i` between two states, of at most a full turn. Quaternions of a
    /// continuous motion do not change sign, so that angles above pi are resolved.
    pub(super) fn between(from: &State, to: &State, i: usize) -> Self {
        let start = from.frames.orientation.get(i);
        let q = start.inverse() * to.frames.orientation.get(i);
        let vector = if q.w >= 0.0 {
            rotation::log(q)
        } else {
            let sine = q.imag().norm();
            q.imag() * (2.0 * sine.atan2(q.w) / sine)
        };
        Self {
            middle: start * rotation::exp(vector * 0.5),
            vector,
            back: 0.0,
        }
    }

    /// Rotation of frame `i`, which consists of a tilt about a transverse axis and half of the `spin` (rad) before
    /// and after it.
    pub(super) fn with_spin(from: &State, to: &State, i: usize, spin: f64) -> Self {
        let start = from.frames.orientation.get(i);
        let half = rotation::exp(Vector3::z() * (0.5 * spin));
        let tilt = rotation::log(
            half.inverse() * start.inverse() * to.frames.orientation.get(i) * half.inverse(),
        );
        Self {
            middle: start * half * rotation::exp(tilt * 0.5),
            vector: tilt + Vector3::z() * spin,
            back: 0.5 * spin,
        }
    }

    /// Transforms a vector from the axes of `middle` to those of the end.
    pub(super) fn in_axes_of_end(&self, v: Vector3) -> Vector3 {
        let (sin, cos) = self.back.sin_cos();
        Vector3::new(cos * v.x + sin * v.y, cos * v.y - sin * v.x, v.z)
    }
}

/// Spin of frame `i` about its third axis within a step (rad), nearest to `estimate`. The quaternions resolve it up to
/// multiples of two turns.
pub(super) fn spin(from: &State, to: &State, i: usize, estimate: f64) -> f64 {
    let q = from.frames.orientation.get(i).inverse() * to.frames.orientation.get(i);
    let spin = 2.0 * q.k.atan2(q.w);
    spin + 2.0 * TAU * ((estimate - spin) / (2.0 * TAU)).round()
}

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
    /// Sine and cosine of the rotation about the third axis from `middle` to the end.
    half_spin: [f64; 2],
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
            half_spin: [0.0, 1.0],
        }
    }

    /// Rotation of frame `i` by any number of turns about its third axis: a tilt about a transverse
    /// axis, with half of the spin before and half of it after the tilt. The quaternions resolve
    /// the spin up to multiples of two turns; it is the nearest one to `estimate` (rad).
    pub(super) fn with_spin(from: &State, to: &State, i: usize, estimate: f64) -> Self {
        let start = from.frames.orientation.get(i);
        let q = start.inverse() * to.frames.orientation.get(i);
        let spin = 2.0 * q.k.atan2(q.w);
        let spin = spin + 2.0 * TAU * ((estimate - spin) / (2.0 * TAU)).round();
        let half = rotation::exp(Vector3::z() * (0.5 * spin));
        let tilt = rotation::log(half.inverse() * q * half.inverse());
        Self {
            middle: start * half * rotation::exp(tilt * 0.5),
            vector: Vector3::new(tilt.x, tilt.y, spin),
            half_spin: [2.0 * half.k * half.w, half.w * half.w - half.k * half.k],
        }
    }

    /// Transforms a vector from the axes of `middle` to the axes of the end.
    pub(super) fn in_axes_of_end(&self, v: Vector3) -> Vector3 {
        let [sin, cos] = self.half_spin;
        Vector3::new(cos * v.x + sin * v.y, cos * v.y - sin * v.x, v.z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use actin_mechanics::{Frame, Inertia};

    fn state(q: UnitQuaternion) -> State {
        let mut state = State::default();
        state.frames.push(Frame {
            orientation: q,
            inertia: Inertia::from_moments([1.0; 3]).unwrap(),
        });
        state
    }

    #[test]
    fn turns_of_any_number_are_resolved() {
        let start = rotation::exp(Vector3::new(0.3, -0.2, 0.9));
        let about = |angle: f64| rotation::exp(Vector3::z() * angle);
        let tilt = Vector3::new(0.1, -0.3, 0.0);
        for spin in [-41.0, -7.0, -3.2, 0.0, 0.4, 6.2, 6.4, 20.0_f64] {
            let end = start * about(0.5 * spin) * rotation::exp(tilt) * about(0.5 * spin);
            let (from, to) = (state(start), state(end));
            let turn = Turn::with_spin(&from, &to, 0, spin + 3.0);
            assert!((turn.vector - tilt - Vector3::z() * spin).norm() < 1e-12);
            let axis = (start * about(0.5 * spin) * rotation::exp(tilt * 0.5)) * Vector3::z();
            assert!((turn.middle * Vector3::z() - axis).norm() < 1e-12);
            let v = Vector3::new(1.0, 2.0, 3.0);
            let same = about(-0.5 * spin) * v;
            assert!((turn.in_axes_of_end(v) - same).norm() < 1e-12);
        }
        let (from, to) = (state(start), state(start * rotation::exp(tilt)));
        let [one, other] = [
            Turn::between(&from, &to, 0),
            Turn::with_spin(&from, &to, 0, 0.0),
        ];
        assert!((one.vector - other.vector).norm() < 1e-15);
        assert!(one.middle.angle_to(&other.middle) < 1e-7);
    }
}

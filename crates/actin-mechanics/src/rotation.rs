//! The rotation group: exponential, logarithm and the inverse Jacobians.
//!
//! A rotation vector `theta` is axis times angle (rad). The logarithm goes through the
//! quaternion and `atan2`, which is accurate at every angle; the matrix logarithm through `acos`
//! loses half of the digits near the identity and all of them below 1e-8 rad.

use crate::{UnitQuaternion, Vector3};
use nalgebra::{Quaternion, Unit};

/// Half angles below this use series; the first neglected term is then below round-off.
const SMALL_ANGLE: f64 = 1e-2;

/// The rotation by the rotation vector `theta` (rad): `exp([theta]x)` as a unit quaternion.
///
/// Accurate to round-off at every angle.
///
/// ```
/// use actin_mechanics::{Vector3, rotation};
/// let quarter_turn = rotation::exp(Vector3::new(0.0, 0.0, std::f64::consts::FRAC_PI_2));
/// let turned = quarter_turn * Vector3::x();
/// assert!((turned - Vector3::y()).norm() < 1e-15);
/// ```
#[inline]
pub fn exp(theta: Vector3) -> UnitQuaternion {
    let half = 0.5 * theta;
    let angle = half.norm();
    let v = half * sinc(angle);
    Unit::new_unchecked(Quaternion::new(angle.cos(), v.x, v.y, v.z))
}

/// `sin(a) / a`.
#[inline]
fn sinc(a: f64) -> f64 {
    if a < SMALL_ANGLE {
        let a2 = a * a;
        1.0 - a2 / 6.0 * (1.0 - a2 / 20.0 * (1.0 - a2 / 42.0))
    } else {
        a.sin() / a
    }
}

/// The rotation vector (rad) of `q`, of length at most pi: the inverse of [`exp`].
///
/// Relative error below 1e-14 for angles from 1e-12 rad to pi - 1e-6 (tested on that grid).
/// Closer to pi the angle stays accurate; at pi itself the axis is one of two and either may be
/// returned.
///
/// ```
/// use actin_mechanics::{Vector3, rotation};
/// let theta = Vector3::new(1e-12, -2e-12, 3e-12);
/// let error = (rotation::log(rotation::exp(theta)) - theta).norm();
/// assert!(error < 1e-14 * theta.norm());
/// ```
#[inline]
pub fn log(q: UnitQuaternion) -> Vector3 {
    let (w, v) = if q.w < 0.0 {
        (-q.w, -q.imag())
    } else {
        (q.w, q.imag())
    };
    let s2 = v.norm_squared();
    let angle_over_sine = if s2 < SMALL_ANGLE * SMALL_ANGLE {
        // asin(s)/s: the quaternion has unit length, so s is the sine of half the angle.
        1.0 + s2 * (1.0 / 6.0 + s2 * (3.0 / 40.0 + s2 * (15.0 / 336.0)))
    } else {
        let s = s2.sqrt();
        s.atan2(w) / s
    };
    2.0 * angle_over_sine * v
}

/// The coefficient `c` of the inverse Jacobians, `(1 - (phi/2) cot(phi/2)) / phi^2`, from
/// `phi^2`.
///
/// Accurate to 1e-14 relative up to 2 pi - 1e-3, where it diverges.
#[inline]
pub fn inverse_jacobian_coefficient(phi_squared: f64) -> f64 {
    if phi_squared < 0.04 {
        let p = phi_squared;
        1.0 / 12.0
            + p * (1.0 / 720.0
                + p * (1.0 / 30_240.0 + p * (1.0 / 1_209_600.0 + p * (1.0 / 47_900_160.0))))
    } else {
        let half = 0.5 * phi_squared.sqrt();
        (1.0 - half / half.tan()) / phi_squared
    }
}

/// `J_l(theta)^-T m`, the couple in axes of the first frame that is conjugate to a turn of it.
///
/// With `theta = log(Q_a^T Q_b)` and `m` the gradient of an energy with respect to `theta`, the
/// body torque on frame `a` is `J_l^-T m` and that on frame `b` is `-J_r^-T m`
/// (see [`right_jacobian_inverse_transpose`]).
///
/// `J_l^-T = I + [theta]x / 2 + c [theta]x^2`, `c` from [`inverse_jacobian_coefficient`].
#[inline]
pub fn left_jacobian_inverse_transpose(theta: Vector3, m: Vector3) -> Vector3 {
    let cross = theta.cross(&m);
    let c = inverse_jacobian_coefficient(theta.norm_squared());
    m + 0.5 * cross + c * theta.cross(&cross)
}

/// `J_r(theta)^-T m = (I - [theta]x / 2 + c [theta]x^2) m`; see
/// [`left_jacobian_inverse_transpose`].
#[inline]
pub fn right_jacobian_inverse_transpose(theta: Vector3, m: Vector3) -> Vector3 {
    let cross = theta.cross(&m);
    let c = inverse_jacobian_coefficient(theta.norm_squared());
    m - 0.5 * cross + c * theta.cross(&cross)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn axes() -> [Vector3; 4] {
        [
            Vector3::x(),
            Vector3::z(),
            Vector3::new(1.0, 2.0, -3.0).normalize(),
            Vector3::new(-1e-3, 1.0, 1e-6).normalize(),
        ]
    }

    /// The angles for which the documentation promises accuracy.
    fn angle_grid() -> Vec<f64> {
        let mut angles: Vec<f64> = (-120..=0)
            .map(|k| 10f64.powf(f64::from(k) / 10.0))
            .collect();
        angles.extend((1..=60).map(|k| PI - 10f64.powf(-f64::from(k) / 10.0)));
        angles
    }

    /// log inverts exp: an acos-based logarithm would fail below 1e-7 rad.
    #[test]
    fn logarithm_inverts_exponential_from_1e_12_to_nearly_pi() {
        for axis in axes() {
            for angle in angle_grid() {
                let theta = axis * angle;
                let error = (log(exp(theta)) - theta).norm() / angle;
                assert!(error < 1e-14, "angle {angle:e}: error {error:e}");
            }
        }
    }

    #[test]
    fn exponential_has_unit_length() {
        for angle in angle_grid() {
            assert!((exp(axes()[2] * angle).norm() - 1.0).abs() < 4e-16);
        }
    }

    /// Both quaternions of one rotation have the same logarithm.
    #[test]
    fn sign_of_the_quaternion_does_not_matter() {
        for angle in angle_grid() {
            let q = exp(axes()[3] * angle);
            let negated = Unit::new_unchecked(-q.into_inner());
            assert_eq!(log(q), log(negated));
        }
    }

    /// The coefficient is smooth across the switch from the series to the closed form.
    #[test]
    fn coefficient_agrees_on_both_sides_of_the_switch() {
        let (below, above) = (0.04 - 1e-12, 0.04 + 1e-12);
        let difference = inverse_jacobian_coefficient(above) - inverse_jacobian_coefficient(below);
        assert!(difference.abs() < 1e-13);
    }

    /// d log(R exp(delta)) = J_r^-1 delta and d log(exp(delta) R) = J_l^-1 delta: the transposed
    /// operators, contracted with m, are compared to central differences of m . log.
    #[test]
    fn inverse_jacobians_are_derivatives_of_the_logarithm() {
        let m = Vector3::new(0.3, -1.1, 0.7);
        for axis in axes() {
            for angle in [1e-6, 1e-2, 0.3, 1.5, 3.0] {
                let theta = axis * angle;
                let r = exp(theta);
                let left = left_jacobian_inverse_transpose(theta, m);
                let right = right_jacobian_inverse_transpose(theta, m);
                let h = 1e-6;
                for k in 0..3 {
                    let mut e = Vector3::zeros();
                    e[k] = h;
                    let d_right = m.dot(&(log(r * exp(e)) - log(r * exp(-e)))) / (2.0 * h);
                    let d_left = m.dot(&(log(exp(e) * r) - log(exp(-e) * r))) / (2.0 * h);
                    assert!((right[k] - d_right).abs() < 1e-8, "angle {angle}");
                    assert!((left[k] - d_left).abs() < 1e-8, "angle {angle}");
                }
            }
        }
    }
}

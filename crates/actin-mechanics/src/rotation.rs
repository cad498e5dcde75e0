//! Exponential, logarithm and inverse Jacobians of the rotation group.
//!
//! A rotation vector `theta` is axis times angle (rad). The logarithm uses the quaternion and
//! `atan2`, which is accurate at every angle. The logarithm of a matrix by `acos` loses half of the
//! digits near the identity and all digits below 1e-8 rad.

use crate::{Matrix3, UnitQuaternion, Vector3};
use nalgebra::{Quaternion, Unit};

/// Series are used for smaller half angles. The first neglected term is below round-off.
const SMALL_ANGLE: f64 = 1e-2;

/// Unit quaternion `exp([theta]x)` of the rotation vector `theta` (rad), accurate to round-off.
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
pub(crate) fn sinc(a: f64) -> f64 {
    if a < SMALL_ANGLE {
        let a2 = a * a;
        1.0 - a2 / 6.0 * (1.0 - a2 / 20.0 * (1.0 - a2 / 42.0))
    } else {
        a.sin() / a
    }
}

/// Rotation vector (rad) of `q`, of length at most pi: the inverse of [`exp`].
///
/// The relative error is below 1e-14 for angles between 1e-12 rad and pi - 1e-6. At pi, either axis
/// may be returned.
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
        // asin(s)/s, where s is the sine of half the angle.
        1.0 + s2 * (1.0 / 6.0 + s2 * (3.0 / 40.0 + s2 * (15.0 / 336.0)))
    } else {
        let s = s2.sqrt();
        s.atan2(w) / s
    };
    2.0 * angle_over_sine * v
}

/// Coefficient `c = (1 - (phi/2) cot(phi/2)) / phi^2` of the inverse Jacobians, as a function of
/// `phi^2`.
///
/// The relative error is below 1e-14 up to 2 pi - 1e-3. The function diverges at 2 pi.
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

/// Taylor coefficients `k |B_{2k+2}| / (2k+2)!`, `k >= 1`, of
/// [`inverse_jacobian_coefficient_slope`], where `B` are the Bernoulli numbers.
const SLOPE_SERIES: [f64; 14] = [
    0.001_388_888_888_888_889,
    6.613_756_613_756_614e-5,
    2.480_158_730_158_73e-6,
    8.350_702_795_147_24e-8,
    2.642_095_069_343_746_7e-9,
    8.029_521_918_410_807e-11,
    2.372_776_207_425_808e-12,
    6.868_849_645_022_276e-14,
    1.957_381_828_702_255_5e-15,
    5.509_002_828_360_23e-17,
    1.534_991_115_439_377_5e-18,
    4.241_648_447_555_361e-20,
    1.163_957_265_514_881e-21,
    3.175_133_433_272_756e-23,
];

/// Derivative of [`inverse_jacobian_coefficient`] with respect to `phi^2`.
///
/// ```text
/// c' = ((phi/2)^2 / (2 sin^2(phi/2)) + (phi/4) cot(phi/2) - 1) / phi^4,  c'(0) = 1/720
/// ```
///
/// The relative error is below 1e-13 up to 2 pi - 0.1. The function diverges at 2 pi.
#[inline]
pub(crate) fn inverse_jacobian_coefficient_slope(phi_squared: f64) -> f64 {
    // Below this limit the series converges; above it the closed form loses less than three digits.
    if phi_squared < 2.25 {
        let horner = |sum: f64, coefficient: &f64| sum * phi_squared + coefficient;
        SLOPE_SERIES.iter().rev().fold(0.0, horner)
    } else {
        let half = 0.5 * phi_squared.sqrt();
        let (sine, cosine) = half.sin_cos();
        let ratio = half / sine;
        (0.5 * ratio * (ratio + cosine) - 1.0) / (phi_squared * phi_squared)
    }
}

/// Torque `J_r(theta)^-T m = (I - [theta]x / 2 + c [theta]x^2) m`.
#[cfg(test)]
fn right_jacobian_inverse_transpose(theta: Vector3, m: Vector3) -> Vector3 {
    let cross = theta.cross(&m);
    let c = inverse_jacobian_coefficient(theta.norm_squared());
    m - 0.5 * cross + c * theta.cross(&cross)
}

/// Inverse right Jacobian `J_r(theta)^-1 = I + [theta]x / 2 + c [theta]x^2`.
///
/// It is the derivative of `log(R exp(delta))` with respect to `delta` at zero, where
/// `theta = log(R)`. Its transpose is `J_l(theta)^-1`, the derivative of `log(exp(delta) R)`.
#[inline]
pub fn right_jacobian_inverse(theta: Vector3) -> Matrix3 {
    let p = theta.norm_squared();
    let c = inverse_jacobian_coefficient(p);
    let mut jacobian = c * theta * theta.transpose() + 0.5 * theta.cross_matrix();
    for k in 0..3 {
        jacobian[(k, k)] += 1.0 - c * p;
    }
    jacobian
}

/// Derivative of `J_r(theta)^-T m` with respect to `theta` at constant `m`.
///
/// ```text
/// [m]x / 2 + c (theta m^T + (theta . m) I - 2 m theta^T) + 2 c' (theta x (theta x m)) theta^T
/// ```
///
/// The coefficients are `c` ([`inverse_jacobian_coefficient`]) and `c'`
/// (`inverse_jacobian_coefficient_slope`). Row `i` belongs to component `i` of the torque.
///
/// ```
/// use actin_mechanics::{Vector3, rotation};
/// // At zero only the half cross product remains: rows (0, -3, 2), (3, 0, -1), (-2, 1, 0) / 2.
/// let m = Vector3::new(1.0, 2.0, 3.0);
/// let slope = rotation::right_jacobian_inverse_transpose_slope(Vector3::zeros(), m);
/// assert_eq!((slope[(0, 1)], slope[(1, 0)], slope[(2, 1)]), (-1.5, 1.5, 0.5));
/// ```
#[inline]
pub fn right_jacobian_inverse_transpose_slope(theta: Vector3, m: Vector3) -> Matrix3 {
    let p = theta.norm_squared();
    let c = inverse_jacobian_coefficient(p);
    let twice_slope = 2.0 * inverse_jacobian_coefficient_slope(p);
    let along = theta.dot(&m);
    // theta x (theta x m) = theta (theta . m) - m theta^2
    let by_theta = (twice_slope * along) * theta - (twice_slope * p + 2.0 * c) * m;
    let mut slope = c * theta * m.transpose() + by_theta * theta.transpose();
    slope += 0.5 * m.cross_matrix();
    for k in 0..3 {
        slope[(k, k)] += c * along;
    }
    slope
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::derivative;
    use std::f64::consts::PI;

    const SLOPES: [(f64, f64); 14] = [
        (0.001, 0.001_388_888_955_026_457_5),
        (0.1, 0.001_389_550_512_649_671),
        (0.5, 0.001_405_579_605_540_907_7),
        (1.0, 0.001_457_592_845_618_332_5),
        (1.4999, 0.001_551_254_478_666_224_2),
        (1.5001, 0.001_551_301_697_527_182),
        (2.0, 0.001_699_235_730_366_331_8),
        (2.5, 0.001_924_487_152_352_498),
        (3.0, 0.002_269_674_848_916_882_3),
        (3.125, 0.002_383_086_120_552_165_4),
        (4.0, 0.003_754_856_717_835_117_3),
        (5.0, 0.009_682_597_800_452_736),
        (6.0, 0.165_462_252_156_394_68),
        (6.18, 1.209_475_843_284_495),
    ];

    fn axes() -> [Vector3; 4] {
        [
            Vector3::x(),
            Vector3::z(),
            Vector3::new(1.0, 2.0, -3.0).normalize(),
            Vector3::new(-1e-3, 1.0, 1e-6).normalize(),
        ]
    }

    fn angle_grid() -> Vec<f64> {
        let mut angles: Vec<f64> = (-120..=0)
            .map(|k| 10f64.powf(f64::from(k) / 10.0))
            .collect();
        angles.extend((1..=60).map(|k| PI - 10f64.powf(-f64::from(k) / 10.0)));
        angles
    }

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

    #[test]
    fn sign_of_the_quaternion_does_not_matter() {
        for angle in angle_grid() {
            let q = exp(axes()[3] * angle);
            let negated = Unit::new_unchecked(-q.into_inner());
            assert_eq!(log(q), log(negated));
        }
    }

    #[test]
    fn coefficient_agrees_on_both_sides_of_the_switch() {
        let (below, above) = (0.04 - 1e-12, 0.04 + 1e-12);
        let difference = inverse_jacobian_coefficient(above) - inverse_jacobian_coefficient(below);
        assert!(difference.abs() < 1e-13);
    }

    #[test]
    fn inverse_jacobian_is_the_derivative_of_the_logarithm() {
        let m = Vector3::new(0.3, -1.1, 0.7);
        for axis in axes() {
            for angle in [1e-6, 1e-2, 0.3, 1.5, 3.0] {
                let theta = axis * angle;
                let r = exp(theta);
                let right = right_jacobian_inverse_transpose(theta, m);
                let h = 1e-6;
                for k in 0..3 {
                    let mut e = Vector3::zeros();
                    e[k] = h;
                    let d_right = m.dot(&(log(r * exp(e)) - log(r * exp(-e)))) / (2.0 * h);
                    assert!((right[k] - d_right).abs() < 1e-8, "angle {angle}");
                }
            }
        }
    }
    /// Reference values to 16 digits, from the defining formula in 50-digit arithmetic.
    #[test]
    fn slope_of_the_coefficient_is_accurate_from_zero_to_nearly_2_pi() {
        for (phi, expected) in SLOPES {
            let relative = inverse_jacobian_coefficient_slope(phi * phi) / expected - 1.0;
            assert!(relative.abs() < 1e-13, "angle {phi}: {relative:e}");
        }
    }

    /// Comparison with eight-point differences, whose error is about 1e-12.
    #[test]
    fn matrices_are_derivatives_of_their_vectors() {
        let m = Vector3::new(0.3, -1.1, 0.7);
        for axis in axes() {
            for angle in [0.0, 1e-6, 1e-2, 0.3, 1.49, 1.51, 3.0, 5.0] {
                let theta = axis * angle;
                let slope = right_jacobian_inverse_transpose_slope(theta, m);
                let jacobian = right_jacobian_inverse(theta);
                for k in 0..3 {
                    let e = Vector3::ith(k, 1.0);
                    let row = right_jacobian_inverse_transpose(theta, e);
                    assert!((jacobian.row(k).transpose() - row).norm() < 1e-14);
                    for i in 0..3 {
                        let numerical = derivative(0.02, |h| {
                            right_jacobian_inverse_transpose(theta + h * e, m)[i]
                        });
                        let error = (slope[(i, k)] - numerical).abs();
                        assert!(error < 1e-11, "angle {angle}: {error:e}");
                    }
                }
            }
        }
    }
}

//! Polynomials in the bounded twist `t = kappa_3 / sqrt(kappa_3^2 + k_0^2)`, which tend to
//! constants at large twist.

use super::terms::{Jet, bounded, of};

/// `k_0` (rad/nm).
pub(crate) const TWIST_SIZE: f64 = 0.02;

pub(crate) const DEGREE: usize = 9;

/// Coefficients of `t^0` to `t^9`.
pub(crate) type Polynomial = [f64; DEGREE + 1];

/// `t` with its derivatives with respect to twist (rad/nm).
pub(super) fn bounded_twist(twist: f64) -> Jet {
    bounded(twist, TWIST_SIZE).map(|x| x / TWIST_SIZE)
}

/// Polynomial with its derivatives with respect to twist, given `t`.
#[inline]
pub(super) fn polynomial(coefficients: &[f64], t: Jet) -> Jet {
    let (mut value, mut slope, mut bend) = (0.0, 0.0, 0.0);
    for c in coefficients.iter().rev() {
        bend = bend * t[0] + 2.0 * slope;
        slope = slope * t[0] + value;
        value = value * t[0] + c;
    }
    of([value, slope, bend], t)
}

#[inline]
pub(super) fn value_of(coefficients: &[f64], t: f64) -> f64 {
    coefficients
        .iter()
        .rev()
        .fold(0.0, |value, c| value * t + c)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1 + 2 t + 3 t^2 at a twist of 0.015: t = 0.6, t' = 25.6, t'' = -1843.2.
    #[test]
    fn a_polynomial_by_hand() {
        let t = bounded_twist(0.015);
        for (x, y) in t.into_iter().zip([0.6, 25.6, -1843.2]) {
            assert!((x - y).abs() < 1e-12 * y.abs(), "{x}");
        }
        let mut coefficients = Polynomial::default();
        coefficients[..3].copy_from_slice(&[1.0, 2.0, 3.0]);
        let jet = polynomial(&coefficients, t);
        let expected = [3.28, 5.6 * 25.6, 6.0 * 25.6 * 25.6 - 5.6 * 1843.2];
        for (x, y) in jet.into_iter().zip(expected) {
            assert!((x - y).abs() < 1e-12 * y.abs(), "{x}");
        }
    }
}

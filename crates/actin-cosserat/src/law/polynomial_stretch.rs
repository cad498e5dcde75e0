//! The published form of a natural length that depends on the twist.

use crate::{RodKey, RodParameterError, constants};

/// Natural over rest length, a polynomial of the twist `k` (rad/nm): `xi(k) = 1 + sum p_i k^i`.
///
/// Beyond `range` it goes on with its value and slope there, since the polynomial soon leaves
/// every sense (the published one falls with the sixth power).
///
/// # Source
/// arXiv 2203.01284, Section 3.3 and Appendix B, where the printed polynomial is that of `xi - 1`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PolynomialStretch {
    /// `p_0` to `p_6` (nm^i/rad^i).
    pub coefficients: [f64; 7],
    /// Largest `|k|` (rad/nm) that the data reach.
    pub range: f64,
}

impl PolynomialStretch {
    /// The published polynomial with its offset `p_0`, by which a rod at rest shrinks by 5e-4.
    pub fn published() -> Self {
        Self {
            coefficients: constants::XI_COEFFICIENTS,
            range: constants::TWIST_RANGE,
        }
    }

    /// The published polynomial without its offset: at rest it is 1.
    ///
    /// ```
    /// let xi = actin_cosserat::PolynomialStretch::published_without_offset();
    /// assert_eq!(xi.extension(0.0), 0.0);
    /// // Over-twist shortens: -0.32416 x 0.01 - 20.508 x 1e-4 + 79.376 x 1e-6 + ...
    /// assert!((xi.extension(0.01) + 5.1116e-3).abs() < 1e-6);
    /// ```
    pub fn published_without_offset() -> Self {
        let mut law = Self::published();
        law.coefficients[0] = 0.0;
        law
    }

    /// The law of an energy `c3 sigma_3 kappa_3` per length beside `s3 sigma_3^2 / 2`: minimised
    /// over the strain at no force it is the slope `-c3 / s3`, at every twist.
    ///
    /// `c3` in pN nm, `s3` in pN.
    pub fn linear(c3: f64, s3: f64) -> Self {
        let mut coefficients = [0.0; 7];
        coefficients[1] = -c3 / s3;
        Self {
            coefficients,
            range: f64::INFINITY,
        }
    }

    /// Checks every number.
    ///
    /// # Errors
    /// A coefficient that is not finite or a range that is not positive.
    pub fn validate(&self) -> Result<(), RodParameterError> {
        if self.range.is_nan() || self.range <= 0.0 {
            let (key, value, rule) = (RodKey::Range, self.range, "positive");
            return Err(RodParameterError { key, value, rule });
        }
        let mut coefficients = self.coefficients.iter();
        coefficients.try_for_each(|p| RodParameterError::unless_finite(RodKey::Coefficient, *p))
    }

    /// `xi - 1`, its first and its second derivative at `k` (rad/nm).
    #[inline]
    pub fn jet(&self, k: f64) -> [f64; 3] {
        let inside = k.clamp(-self.range, self.range);
        let (mut value, mut slope, mut half_second) = (0.0, 0.0, 0.0);
        for p in self.coefficients.iter().rev() {
            half_second = half_second * inside + slope;
            slope = slope * inside + value;
            value = value * inside + p;
        }
        if k.abs() <= self.range {
            [value, slope, 2.0 * half_second]
        } else {
            [value + slope * (k - inside), slope, 0.0]
        }
    }

    /// `xi - 1` at twist `k` (rad/nm): the relative change of length that costs no force.
    pub fn extension(&self, k: f64) -> f64 {
        self.jet(k)[0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use actin_mechanics::testing::derivative;

    #[test]
    fn jet_holds_the_derivatives_inside_and_beyond() {
        let law = PolynomialStretch::published();
        for k in [-0.1, -0.04, -0.01, 0.0, 0.02, 0.045, 0.2] {
            let jet = law.jet(k);
            for order in [0, 1] {
                let slope = derivative(1e-4, |h| law.jet(k + h)[order]);
                let scale = [1.0, 50.0][order];
                assert!((jet[order + 1] - slope).abs() < 1e-7 * scale, "{k} {order}");
            }
        }
    }

    /// Table 5: the largest deviation of the published polynomial is 6e-4.
    #[test]
    fn published_coefficients_follow_table_5() {
        let law = PolynomialStretch::published();
        for (k, dl) in [
            (0.0462, -0.0341),
            (0.0185, -0.0121),
            (-0.0185, -0.0009),
            (-0.0462, -0.009),
        ] {
            assert!(
                (law.extension(k) - dl).abs() < 7e-4,
                "{k}: {}",
                law.extension(k)
            );
        }
    }

    #[test]
    fn bad_numbers_are_refused() {
        let mut law = PolynomialStretch::published();
        law.coefficients[3] = f64::NAN;
        assert_eq!(law.validate().unwrap_err().key, RodKey::Coefficient);
        let law = PolynomialStretch {
            range: 0.0,
            ..PolynomialStretch::published()
        };
        assert_eq!(law.validate().unwrap_err().key, RodKey::Range);
        assert_eq!(PolynomialStretch::linear(9.35e3, 3.4e4).validate(), Ok(()));
    }
}

//! Published natural length as a function of twist.

use crate::{RodParameterError, constants};

/// Ratio of natural to rest length as a polynomial of the twist `k` (rad/nm).
///
/// ```text
/// xi(k) = 1 + sum p_i k^i
/// ```
///
/// Extrapolated linearly outside `range`, where the polynomial diverges.
///
/// # Source
/// arXiv 2203.01284, Section 3.3 and Appendix B, where `xi - 1` is printed as `xi`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(
    feature = "schema",
    schemars(description = "Change of length as a polynomial of the twist.")
)]
pub struct PolynomialStretch {
    /// `p_0` to `p_6` (nm^i/rad^i); finite.
    pub coefficients: [f64; 7],
    /// Largest `|k|` of the data (rad/nm); positive, may be infinite (`inf`).
    #[cfg_attr(feature = "serde", serde(rename = "range_per_nm"))]
    pub range: f64,
}

impl PolynomialStretch {
    /// Published polynomial, including the offset `p_0` = -5e-4 at zero twist.
    pub fn published() -> Self {
        Self {
            coefficients: constants::XI_COEFFICIENTS,
            range: constants::TWIST_RANGE,
        }
    }

    /// Published polynomial without offset: `xi(0) = 1`.
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

    /// Linear law `xi - 1 = -(c3 / s3) k`, with `c3` in pN nm and `s3` in pN.
    ///
    /// It is equivalent to the energy `s3 sigma_3^2 / 2 + c3 sigma_3 kappa_3` per length, minimised
    /// at zero force.
    pub(crate) fn linear(c3: f64, s3: f64) -> Self {
        let mut coefficients = [0.0; 7];
        coefficients[1] = -c3 / s3;
        Self {
            coefficients,
            range: f64::INFINITY,
        }
    }

    /// Checks all parameters.
    ///
    /// # Errors
    /// If a coefficient is not finite, or if the range is not positive.
    pub(crate) fn validate(&self) -> Result<(), RodParameterError> {
        if self.range.is_nan() || self.range <= 0.0 {
            let (key, value, rule) = ("range_per_nm", self.range, "positive");
            return Err(RodParameterError { key, value, rule });
        }
        let mut coefficients = self.coefficients.iter();
        coefficients.try_for_each(|p| RodParameterError::check_finite("coefficients", *p))
    }

    /// `xi - 1` at `k` (rad/nm), with two derivatives.
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

    /// `xi - 1` at twist `k` (rad/nm).
    pub fn extension(&self, k: f64) -> f64 {
        self.jet(k)[0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
}

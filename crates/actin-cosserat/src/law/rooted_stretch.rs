//! Natural length with different slopes in under-twist and over-twist.

use crate::RodParameterError;

/// Ratio of natural to rest length with different slopes on both sides of rest.
///
/// ```text
/// xi(k) - 1 = slope k - bend (sqrt(k^2 + half^2) - half) + cubic k^3
/// ```
///
/// `k` is the twist (rad/nm). Extrapolated linearly outside `range`.
///
/// # Source
/// Form after twisted filaments of monomers (`docs/validation.md`, Figure 9).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(
    feature = "schema",
    schemars(
        description = "Change of length with different slopes on both sides of rest: `slope k - bend (sqrt(k^2 + half^2) - half) + cubic k^3` at the twist `k`."
    )
)]
pub struct RootedStretch {
    /// Slope at rest (nm/rad); finite.
    #[cfg_attr(feature = "serde", serde(rename = "slope_nm"))]
    pub slope: f64,
    /// Half the difference of the limiting slopes (nm/rad); finite.
    #[cfg_attr(feature = "serde", serde(rename = "bend_nm"))]
    pub bend: f64,
    /// Twist scale of the transition (rad/nm); positive.
    #[cfg_attr(feature = "serde", serde(rename = "half_per_nm"))]
    pub half: f64,
    /// Cubic coefficient (nm^3/rad^3); finite.
    #[cfg_attr(feature = "serde", serde(rename = "cubic_nm3"))]
    pub cubic: f64,
    /// Largest `|k|` of the data (rad/nm); positive and finite.
    #[cfg_attr(feature = "serde", serde(rename = "range_per_nm"))]
    pub range: f64,
}

impl RootedStretch {
    /// Checks all parameters.
    ///
    /// # Errors
    /// If `half` or the range is not positive, or if another parameter is not finite.
    pub fn validate(&self) -> Result<(), RodParameterError> {
        RodParameterError::unless_positive("half_per_nm", self.half)?;
        RodParameterError::unless_positive("range_per_nm", self.range)?;
        [
            ("slope_nm", self.slope),
            ("bend_nm", self.bend),
            ("cubic_nm3", self.cubic),
        ]
        .into_iter()
        .try_for_each(|(key, value)| RodParameterError::check_finite(key, value))
    }

    /// `xi - 1` at `k` (rad/nm), with two derivatives.
    ///
    /// ```
    /// use actin_cosserat::RootedStretch;
    /// let law = RootedStretch { slope: -0.3, bend: 0.4, half: 0.03, cubic: 0.0, range: 0.1 };
    /// // -0.3 x 0.04 - 0.4 (0.05 - 0.03)
    /// assert!((law.jet(0.04)[0] + 0.02).abs() < 1e-15);
    /// ```
    #[inline]
    pub fn jet(&self, k: f64) -> [f64; 3] {
        let inside = k.clamp(-self.range, self.range);
        let root = inside.hypot(self.half);
        let cube = self.cubic * inside * inside;
        // sqrt(k^2 + half^2) - half, without cancellation.
        let bent = self.bend * inside * inside / (root + self.half);
        let value = self.slope * inside - bent + cube * inside;
        let slope = self.slope - self.bend * inside / root + 3.0 * cube;
        if k.abs() <= self.range {
            let second =
                6.0 * self.cubic * inside - self.bend * self.half * self.half / root.powi(3);
            [value, slope, second]
        } else {
            [value + slope * (k - inside), slope, 0.0]
        }
    }

    /// Derivatives of `xi - 1` with respect to `slope`, `bend`, `half` and `cubic`, within the
    /// range.
    pub fn gradient(&self, k: f64) -> [f64; 4] {
        let root = k.hypot(self.half);
        let of_half = self.bend * (1.0 - self.half / root);
        [k, -k * k / (root + self.half), of_half, k * k * k]
    }
}

#[cfg(test)]
mod tests {
    use crate::law::tests::ROOTED;
    use actin_mechanics::testing::derivative;

    #[test]
    fn gradient_in_the_parameters() {
        for k in [-0.03, -1e-3, 0.01, 0.04] {
            let with = |i: usize, h: f64| {
                let mut moved = ROOTED;
                let places = [
                    &mut moved.slope,
                    &mut moved.bend,
                    &mut moved.half,
                    &mut moved.cubic,
                ];
                *places.into_iter().nth(i).unwrap() += h;
                moved.jet(k)[0]
            };
            for (i, value) in ROOTED.gradient(k).into_iter().enumerate() {
                let slope = derivative(1e-4, |h| with(i, h));
                assert!((value - slope).abs() < 1e-8, "{k} {i}");
            }
        }
    }
}

//! Twist rigidity that rises differently in under-twist and over-twist.

use crate::RodParameterError;

/// Secant twist rigidity that saturates on both sides of rest.
///
/// ```text
/// B3(k) = rest + rise k^2 / (k^2 + slow |k| + half^2)
/// ```
///
/// `rise`, `half` and `slow` differ for over-twist (`k > 0`) and under-twist. The torque is
/// `B3(k) k`, extrapolated linearly outside `range`. The energy per length is its integral.
///
/// # Source
/// Form after twisted filaments of monomers, which hardly resist small twist (`docs/validation.md`,
/// Figure 9).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(
    feature = "schema",
    schemars(
        description = "Twist rigidity that saturates, with separate rises in under-twist and over-twist."
    )
)]
pub struct SidedTwist {
    /// Rigidity at rest (pN nm^2); at least 0.
    #[cfg_attr(feature = "serde", serde(rename = "rest_pn_nm2"))]
    pub rest: f64,
    /// Rise in under-twist.
    pub under: TwistRise,
    /// Rise in over-twist.
    pub over: TwistRise,
    /// Largest `|k|` of the data (rad/nm); positive and finite.
    #[cfg_attr(feature = "serde", serde(rename = "range_per_nm"))]
    pub range: f64,
}

/// Parameters of one side of a [`SidedTwist`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TwistRise {
    /// Increase of the rigidity at large twist (pN nm^2); positive.
    #[cfg_attr(feature = "serde", serde(rename = "rise_pn_nm2"))]
    pub rise: f64,
    /// Twist at half the rise without a slow part (rad/nm); positive.
    #[cfg_attr(feature = "serde", serde(rename = "half_per_nm"))]
    pub half: f64,
    /// Twist scale of the slow part of the rise (rad/nm); at least 0.
    #[cfg_attr(feature = "serde", serde(rename = "slow_per_nm"))]
    pub slow: f64,
}

impl TwistRise {
    fn validate(&self) -> Result<(), RodParameterError> {
        RodParameterError::unless_positive("rise_pn_nm2", self.rise)?;
        RodParameterError::unless_positive("half_per_nm", self.half)?;
        if self.slow >= 0.0 && self.slow.is_finite() {
            return Ok(());
        }
        let (key, value, rule) = ("slow_per_nm", self.slow, "finite and not negative");
        Err(RodParameterError { key, value, rule })
    }

    /// `k^2 + slow k + half^2` for `k >= 0`.
    #[inline]
    fn denominator(&self, k: f64) -> f64 {
        k * (k + self.slow) + self.half * self.half
    }

    /// `int_0^k s^3 / denominator(s) ds` for `k >= 0`, by partial fractions.
    fn moment(&self, k: f64) -> f64 {
        let (slow, half2) = (self.slow, self.half * self.half);
        let excess = slow * slow - half2;
        let logarithm = (k * (k + slow) / half2).ln_1p();
        // int ds / denominator = 2 t artanh(sqrt(d) t) / (sqrt(d) t), also for negative d.
        let t = k / (2.0 * half2 + slow * k);
        let rest = 2.0 * t * artanh_over((slow * slow - 4.0 * half2) * t * t);
        0.5 * k * k - slow * k + 0.5 * excess * logarithm + slow * (half2 - 0.5 * excess) * rest
    }
}

/// `artanh(sqrt z) / sqrt z`, or `atan(sqrt -z) / sqrt -z` for negative `z`.
fn artanh_over(z: f64) -> f64 {
    if z.abs() < 1e-3 {
        // The first neglected term, z^6/13, is below round-off.
        1.0 + z * (1.0 / 3.0 + z * (0.2 + z * (1.0 / 7.0 + z * (1.0 / 9.0 + z / 11.0))))
    } else if z > 0.0 {
        z.sqrt().atanh() / z.sqrt()
    } else {
        (-z).sqrt().atan() / (-z).sqrt()
    }
}

impl SidedTwist {
    /// Checks all parameters.
    ///
    /// # Errors
    /// If a rise, `half` or the range is not positive, or if `rest` or `slow` is negative.
    pub(crate) fn validate(&self) -> Result<(), RodParameterError> {
        if !(self.rest >= 0.0 && self.rest.is_finite()) {
            let (key, value, rule) = ("rest_pn_nm2", self.rest, "finite and not negative");
            return Err(RodParameterError { key, value, rule });
        }
        self.under.validate()?;
        self.over.validate()?;
        RodParameterError::unless_positive("range_per_nm", self.range)
    }

    #[inline]
    fn side(&self, k: f64) -> &TwistRise {
        if k < 0.0 { &self.under } else { &self.over }
    }

    #[inline]
    fn inner_couple(&self, k: f64) -> f64 {
        let (side, a) = (self.side(k), k.abs());
        k * (self.rest + side.rise * a * a / side.denominator(a))
    }

    #[inline]
    fn inner_tangent(&self, k: f64) -> f64 {
        let (side, a) = (self.side(k), k.abs());
        let over = side.denominator(a).recip();
        let share = a * a * over;
        // d(k^3/D)/dk = 3 k^2/D - k^3 (2k + slow)/D^2
        self.rest + side.rise * share * (3.0 - a * (2.0 * a + side.slow) * over)
    }

    /// Secant rigidity (pN nm^2): torque divided by twist.
    ///
    /// ```
    /// use actin_cosserat::{SidedTwist, TwistRise};
    /// let side = TwistRise { rise: 1.2e4, half: 0.01, slow: 0.0 };
    /// let law = SidedTwist { rest: 300.0, under: side, over: side, range: 0.05 };
    /// assert!((law.secant(0.01) - 6300.0).abs() < 1e-9);
    /// ```
    pub fn secant(&self, k: f64) -> f64 {
        if k == 0.0 {
            self.rest
        } else {
            self.couple(k) / k
        }
    }

    /// Derivatives of the secant with respect to `rest` and to `rise`, `half`, `slow` of
    /// under-twist and over-twist, within the range.
    pub fn secant_gradient(&self, k: f64) -> [f64; 7] {
        let (side, a) = (self.side(k), k.abs());
        let over = side.denominator(a).recip();
        let share = a * a * over;
        let of_denominator = -side.rise * share * over;
        let own = [share, of_denominator * 2.0 * side.half, of_denominator * a];
        let [rise, half, slow] = own;
        if k < 0.0 {
            [1.0, rise, half, slow, 0.0, 0.0, 0.0]
        } else {
            [1.0, 0.0, 0.0, 0.0, rise, half, slow]
        }
    }

    /// Torque (pN nm) at twist `k` (rad/nm).
    #[inline]
    pub(crate) fn couple(&self, k: f64) -> f64 {
        let inside = k.clamp(-self.range, self.range);
        let couple = self.inner_couple(inside);
        if k.abs() <= self.range {
            couple
        } else {
            couple + self.inner_tangent(inside) * (k - inside)
        }
    }

    /// Derivative of the torque (pN nm^2).
    #[inline]
    pub(crate) fn tangent(&self, k: f64) -> f64 {
        self.inner_tangent(k.clamp(-self.range, self.range))
    }

    /// Energy per length (pN): integral of the torque, accurate to round-off.
    pub(crate) fn energy_density(&self, k: f64) -> f64 {
        let inside = k.clamp(-self.range, self.range);
        let side = self.side(k);
        let energy = 0.5 * self.rest * inside * inside + side.rise * side.moment(inside.abs());
        let beyond = k - inside;
        energy + beyond * (self.inner_couple(inside) + 0.5 * beyond * self.tangent(k))
    }
}

#[cfg(test)]
mod tests {
    use crate::law::tests::SIDED;
    use actin_mechanics::testing::derivative;

    #[test]
    fn gradient_in_the_parameters() {
        let with = |i: usize, h: f64| {
            let mut moved = SIDED;
            let places = [
                &mut moved.rest,
                &mut moved.under.rise,
                &mut moved.under.half,
                &mut moved.under.slow,
                &mut moved.over.rise,
                &mut moved.over.half,
                &mut moved.over.slow,
            ];
            *places.into_iter().nth(i).unwrap() += h;
            moved
        };
        for k in [-0.03, -0.004, 0.01, 0.04] {
            for (i, value) in SIDED.secant_gradient(k).into_iter().enumerate() {
                let h = if [2, 3, 5, 6].contains(&i) { 1e-4 } else { 1.0 };
                let slope = derivative(h, |d| with(i, d).secant(k));
                assert!((value - slope).abs() < 1e-7 * value.abs() + 1e-9, "{k} {i}");
            }
        }
    }
}

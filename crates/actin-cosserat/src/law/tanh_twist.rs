//! Published twist rigidity as a function of twist.

use super::dilogarithm::tanh_energy;
use crate::{RodParameterError, constants};

/// Secant twist rigidity with three tanh steps.
///
/// ```text
/// B3(k) = M + D tanh((k + l1)/l2) + l3 M [tanh((k - l4)/l5) - tanh((k + l6)/l7)]
/// M = (b_plus + b_minus)/2,  D = (b_plus - b_minus)/2
/// ```
///
/// `k` is the twist (rad/nm, positive for over-twist). The torque is `B3(k) k`, extrapolated
/// linearly outside `range`. The energy per length is its integral.
///
/// # Source
/// arXiv 2203.01284, Section 3.3 and Appendix B. The printed energy, `B3 k^2 / 2`, is inconsistent
/// with the printed torque.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(
    feature = "schema",
    schemars(description = "Twist rigidity with three tanh steps, as published.")
)]
pub struct TanhTwist {
    /// Limit at large over-twist (pN nm^2); finite.
    #[cfg_attr(feature = "serde", serde(rename = "b_plus_pn_nm2"))]
    pub b_plus: f64,
    /// Limit at large under-twist (pN nm^2); finite.
    #[cfg_attr(feature = "serde", serde(rename = "b_minus_pn_nm2"))]
    pub b_minus: f64,
    /// `l1` to `l7` (rad/nm; `l3` dimensionless); finite, `l2`, `l5` and `l7` positive. The couple must grow at the end of the
    /// range.
    pub lambda: [f64; 7],
    /// Largest `|k|` of the data (rad/nm); positive and finite.
    #[cfg_attr(feature = "serde", serde(rename = "range_per_nm"))]
    pub range: f64,
}

impl TanhTwist {
    /// Published parameters, fitted to rows of at most 200 degrees over 75.5 nm.
    ///
    /// ```
    /// let law = actin_cosserat::TanhTwist::published();
    /// // At rest M + D tanh(2.198) - 4.5982 M (tanh(5.496e-5) + tanh(0.26701)) = 566
    /// assert!((law.secant(0.0) - 566.0).abs() < 1.0);
    /// ```
    pub fn published() -> Self {
        Self {
            b_plus: constants::B3_PLUS,
            b_minus: constants::B3_MINUS,
            lambda: constants::B3_LAMBDA,
            range: constants::TWIST_RANGE,
        }
    }

    /// Checks all parameters.
    ///
    /// # Errors
    /// If `l2`, `l5`, `l7` or the range is not positive, if a parameter is not finite, or if the
    /// torque does not increase at a limit of the range.
    pub(crate) fn validate(&self) -> Result<(), RodParameterError> {
        let widths = [("lambda[1]", 1), ("lambda[4]", 4), ("lambda[6]", 6)];
        for (key, i) in widths {
            RodParameterError::unless_positive(key, self.lambda[i])?;
        }
        RodParameterError::unless_positive("range_per_nm", self.range)?;
        let others = [
            ("b_plus_pn_nm2", self.b_plus),
            ("b_minus_pn_nm2", self.b_minus),
        ];
        let lambdas = self.lambda.map(|value| ("lambda", value));
        for (key, value) in others.into_iter().chain(lambdas) {
            RodParameterError::check_finite(key, value)?;
        }
        for end in [-self.range, self.range] {
            let key = "slope of the couple at the end of the range";
            RodParameterError::unless_positive(key, self.inner_tangent(end))?;
        }
        Ok(())
    }

    /// Mean, and height, centre and width of each tanh.
    pub(crate) fn steps(&self) -> (f64, [[f64; 3]; 3]) {
        let [l1, l2, l3, l4, l5, l6, l7] = self.lambda;
        let mean = 0.5 * (self.b_plus + self.b_minus);
        let half = 0.5 * (self.b_plus - self.b_minus);
        let well = l3 * mean;
        (mean, [[half, -l1, l2], [well, l4, l5], [-well, -l6, l7]])
    }

    /// `B3(k)` of the formula (pN nm^2), also outside the range.
    fn formula(&self, k: f64) -> f64 {
        let (mean, steps) = self.steps();
        let tanh = |[height, centre, width]: [f64; 3]| height * ((k - centre) / width).tanh();
        mean + steps.map(tanh).iter().sum::<f64>()
    }

    fn formula_slope(&self, k: f64) -> f64 {
        let slope = |[height, centre, width]: [f64; 3]| {
            let tanh = ((k - centre) / width).tanh();
            height * (1.0 - tanh * tanh) / width
        };
        self.steps().1.map(slope).iter().sum()
    }

    fn inner_tangent(&self, k: f64) -> f64 {
        self.formula(k) + k * self.formula_slope(k)
    }

    /// Derivatives of the formula with respect to `b_plus`, `b_minus` and `l1` to `l7`.
    pub fn secant_gradient(&self, k: f64) -> [f64; 9] {
        let [l1, l2, l3, l4, l5, l6, l7] = self.lambda;
        let mean = 0.5 * (self.b_plus + self.b_minus);
        let half = 0.5 * (self.b_plus - self.b_minus);
        let tanh = [(k + l1) / l2, (k - l4) / l5, (k + l6) / l7].map(f64::tanh);
        let peak = tanh.map(|t| 1.0 - t * t);
        let well = tanh[1] - tanh[2];
        let of_mean = 1.0 + l3 * well;
        let (first, second) = (half * peak[0] / l2, l3 * mean * peak[1] / l5);
        let third = -l3 * mean * peak[2] / l7;
        [
            0.5 * (of_mean + tanh[0]),
            0.5 * (of_mean - tanh[0]),
            first,
            -first * (k + l1) / l2,
            mean * well,
            -second,
            -second * (k - l4) / l5,
            third,
            -third * (k + l6) / l7,
        ]
    }

    /// Secant rigidity `B3(k)` (pN nm^2): torque divided by twist.
    pub fn secant(&self, k: f64) -> f64 {
        if k.abs() <= self.range {
            self.formula(k)
        } else {
            self.couple(k) / k
        }
    }

    /// Torque (pN nm) at twist `k` (rad/nm).
    #[inline]
    pub(crate) fn couple(&self, k: f64) -> f64 {
        let inside = k.clamp(-self.range, self.range);
        let couple = self.formula(inside) * inside;
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
        let (mean, steps) = self.steps();
        let step = |[height, centre, width]: [f64; 3]| height * tanh_energy(inside, centre, width);
        let energy = 0.5 * mean * inside * inside + steps.map(step).iter().sum::<f64>();
        let beyond = k - inside;
        energy + beyond * (self.formula(inside) * inside + 0.5 * beyond * self.tangent(k))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use actin_mechanics::testing::derivative;

    #[test]
    fn published_parameters_follow_table_3() {
        let law = TanhTwist::published();
        for (k, b3) in [
            (0.0462, 16e3),
            (0.0185, 10e3),
            (-0.0185, 5.8e3),
            (-0.0462, 9.4e3),
        ] {
            assert!((law.secant(k) - b3).abs() < 700.0, "{k}: {}", law.secant(k));
        }
    }

    #[test]
    fn gradient_in_the_parameters() {
        let law = TanhTwist::published();
        let with = |i: usize, h: f64| {
            let mut moved = law;
            match i {
                0 => moved.b_plus += h,
                1 => moved.b_minus += h,
                _ => moved.lambda[i - 2] += h,
            }
            moved
        };
        for k in [-0.03, -0.004, 0.0, 0.01, 0.04] {
            let gradient = law.secant_gradient(k);
            for (i, value) in gradient.iter().enumerate() {
                let h = if i < 2 { 10.0 } else { 1e-4 };
                let slope = derivative(h, |d| with(i, d).formula(k));
                assert!(
                    (value - slope).abs() < 1e-6 * value.abs().max(1e4 * f64::from(i > 1)) + 1e-9
                );
            }
        }
    }

    #[test]
    fn widths_ranges_and_falling_couples_are_refused() {
        let key = |spoil: &dyn Fn(&mut TanhTwist)| {
            let mut law = TanhTwist::published();
            assert_eq!(law.validate(), Ok(()));
            spoil(&mut law);
            law.validate().unwrap_err().key
        };
        for i in [1, 4, 6] {
            for value in [0.0, -1.0, f64::NAN] {
                let found = key(&|law| law.lambda[i] = value);
                assert!(found.to_string().starts_with("lambda"), "{found}");
            }
        }
        assert_eq!(key(&|law| law.lambda[0] = f64::INFINITY), "lambda");
        let falling = key(&|law| law.b_plus = -5e4);
        assert!(falling.to_string().starts_with("slope"), "{falling}");
    }
}

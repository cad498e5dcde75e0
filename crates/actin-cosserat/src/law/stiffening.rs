//! Bending stiffened by curvature, twist and shear.

use crate::RodParameterError;

/// Secant bending rigidity that rises from `rest` to `rest + rise`.
///
/// ```text
/// B = rest + rise q / (1 + q),  q = k^2/k0^2 + s,  s = kappa_3^2/twist^2 + gamma^2/shear^2
/// U = rest k^2/2 + (rise/2) [k^2 - k0^2 ln(1 + k^2 / (k0^2 (1 + s)))]
/// ```
///
/// `k` is the bending curvature and `U` the energy per length, with `dU/dk = B k`.
///
/// # Source
/// Form after bent filaments of monomers: undeformed interfaces resist only some of their relative
/// motions.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(
    feature = "schema",
    schemars(
        description = "Bending rigidity that rises from rest with curvature, twist and shear."
    )
)]
pub struct Stiffening {
    /// Rigidity at rest (pN nm^2); positive.
    #[cfg_attr(feature = "serde", serde(rename = "rest_pn_nm2"))]
    pub rest: f64,
    /// Increase of the rigidity (pN nm^2); at least 0.
    #[cfg_attr(feature = "serde", serde(rename = "rise_pn_nm2"))]
    pub rise: f64,
    /// Curvature `k0` at half the increase (rad/nm); positive.
    #[cfg_attr(feature = "serde", serde(rename = "curvature_per_nm"))]
    pub curvature: f64,
    /// Twist at half the increase (rad/nm); positive. Infinite without stiffening by twist; scenes then omit the key.
    #[cfg_attr(
        feature = "serde",
        serde(
            rename = "twist_per_nm",
            deserialize_with = "effect::read",
            default = "effect::none",
            skip_serializing_if = "effect::is_none"
        )
    )]
    pub twist: f64,
    /// Shear strain at half the increase; positive. Infinite without stiffening by shear; scenes then omit the key.
    #[cfg_attr(
        feature = "serde",
        serde(
            deserialize_with = "effect::read",
            default = "effect::none",
            skip_serializing_if = "effect::is_none"
        )
    )]
    pub shear: f64,
    /// Largest curvature of the data (rad/nm); positive, may be infinite (`inf`).
    #[cfg_attr(feature = "serde", serde(rename = "range_per_nm"))]
    pub range: f64,
}

/// Serialisation of a scale that is infinite without its effect: an optional key.
#[cfg(feature = "serde")]
mod effect {
    use serde::de::Error;
    use serde::{Deserialize, Deserializer};

    pub(super) fn none() -> f64 {
        f64::INFINITY
    }

    #[expect(
        clippy::trivially_copy_pass_by_ref,
        reason = "`skip_serializing_if` requires this signature"
    )]
    pub(super) fn is_none(scale: &f64) -> bool {
        scale.is_infinite()
    }

    pub(super) fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
        match Option::<f64>::deserialize(deserializer)? {
            Some(scale) if is_none(&scale) => Err(D::Error::custom(
                "must be finite; omit the key to disable this effect",
            )),
            scale => Ok(scale.unwrap_or_else(none)),
        }
    }
}

/// Function of `p = k^2` and `s` with its derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Jet {
    pub(crate) value: f64,
    pub(crate) p: f64,
    pub(crate) s: f64,
    pub(crate) pp: f64,
    pub(crate) ps: f64,
    pub(crate) ss: f64,
}

impl Stiffening {
    /// Checks all parameters.
    ///
    /// # Errors
    /// If a rigidity, scale or range is not positive, or if `rise` is negative.
    pub fn validate(&self) -> Result<(), RodParameterError> {
        RodParameterError::unless_positive("rest_pn_nm2", self.rest)?;
        RodParameterError::unless_positive("curvature_per_nm", self.curvature)?;
        if !(self.rise >= 0.0 && self.rise.is_finite()) {
            let (key, value, rule) = ("rise_pn_nm2", self.rise, "finite and not negative");
            return Err(RodParameterError { key, value, rule });
        }
        let scales = [
            ("twist_per_nm", self.twist),
            ("shear", self.shear),
            ("range_per_nm", self.range),
        ];
        for (key, value) in scales {
            if value.is_nan() || value <= 0.0 {
                let rule = "positive";
                return Err(RodParameterError { key, value, rule });
            }
        }
        Ok(())
    }

    /// Secant rigidity (pN nm^2) at curvature `k` and twist `k3` (rad/nm), without shear.
    ///
    /// ```
    /// let law = actin_cosserat::Stiffening {
    ///     rest: 3e4, rise: 1e4, curvature: 3e-3, twist: f64::INFINITY, shear: f64::INFINITY,
    ///     range: 0.02,
    /// };
    /// assert!((law.secant(3e-3, 0.0) - 3.5e4).abs() < 1e-9);
    /// ```
    pub fn secant(&self, k: f64, k3: f64) -> f64 {
        let stiffening = (k3 / self.twist).powi(2);
        2.0 * self.jet(k * k, stiffening).p
    }

    /// Derivatives of the secant at zero twist with respect to `rest`, `rise` and `curvature`.
    pub fn secant_gradient(&self, k: f64) -> [f64; 3] {
        let q = (k / self.curvature).powi(2);
        let share = q / (1.0 + q);
        let of_scale = -2.0 * self.rise * share / ((1.0 + q) * self.curvature);
        [1.0, share, of_scale]
    }

    /// `U` as a function of `p = k^2` and `s`.
    #[inline]
    pub(crate) fn jet(&self, p: f64, s: f64) -> Jet {
        let k0_squared = self.curvature * self.curvature;
        let q = p / k0_squared;
        let (over, all) = ((1.0 + s).recip(), (1.0 + q + s).recip());
        let half = 0.5 * self.rise;
        Jet {
            value: 0.5 * self.rest * p + half * (p - k0_squared * (q * over).ln_1p()),
            p: 0.5 * self.rest + half * (q + s) * all,
            s: half * p * all * over,
            pp: half * all * all / k0_squared,
            ps: half * all * all,
            ss: -half * p * all * over * (all + over),
        }
    }
}

impl std::ops::Sub for Jet {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self {
            value: self.value - other.value,
            p: self.p - other.p,
            s: self.s - other.s,
            pp: self.pp - other.pp,
            ps: self.ps - other.ps,
            ss: self.ss - other.ss,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::tests::STIFFENING;
    use actin_mechanics::testing::derivative;

    #[test]
    fn jet_holds_the_derivatives() {
        for (p, s) in [(0.0, 0.0), (1e-6, 0.0), (9e-6, 0.4), (1e-4, 3.0)] {
            let jet = STIFFENING.jet(p, s);
            let of_p = |f: fn(Jet) -> f64| derivative(1e-7, |h| f(STIFFENING.jet(p + h, s)));
            let of_s = |f: fn(Jet) -> f64| derivative(1e-3, |h| f(STIFFENING.jet(p, s + h)));
            let checks = [
                (jet.p, of_p(|j| j.value)),
                (jet.pp * 1e-6, of_p(|j| j.p) * 1e-6),
                (jet.ps, of_p(|j| j.s)),
                (jet.s, of_s(|j| j.value)),
                (jet.ps, of_s(|j| j.p)),
                (jet.ss, of_s(|j| j.s)),
            ];
            for (k, (value, slope)) in checks.into_iter().enumerate() {
                // Round-off of differences of rigidities of 4e4.
                assert!(
                    (value - slope).abs() < 1e-7 * 4e4,
                    "{p} {s} {k}: {value} {slope}"
                );
            }
        }
    }

    #[test]
    fn gradient_in_the_parameters() {
        type Change = fn(&mut Stiffening, f64);
        let moved: [(Change, f64); 3] = [
            (|law, d| law.rest += d, 10.0),
            (|law, d| law.rise += d, 10.0),
            (|law, d| law.curvature += d, 1e-5),
        ];
        for k in [0.0, 1e-3, 0.01] {
            for ((change, h), value) in moved.iter().zip(STIFFENING.secant_gradient(k)) {
                let slope = derivative(*h, |d| {
                    let mut law = STIFFENING;
                    change(&mut law, d);
                    law.secant(k, 0.0)
                });
                assert!((value - slope).abs() <= 1e-7 * value.abs() + 1e-9);
            }
        }
    }

    #[test]
    fn stiffening_saturates() {
        assert!((STIFFENING.secant(0.0, 0.0) - 3e4).abs() < 1e-9);
        assert!((STIFFENING.secant(1.0, 0.0) - 4e4).abs() < 1.0);
        assert!((STIFFENING.secant(0.0, 2.0) - 4e4).abs() < 2.0);
        assert!((STIFFENING.secant(3e-3, 0.02) - (3e4 + 1e4 * 2.0 / 3.0)).abs() < 1e-9);
    }
}

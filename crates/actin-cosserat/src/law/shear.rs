//! Law of shear.

use crate::RodParameterError;
use nalgebra::{Matrix2, Vector2};

type Pair = Vector2<f64>;

/// Shear with a linear and a cubic part, as a function of the shear strains `g`.
///
/// ```text
/// force  = S g + c |g|^2 g                   (pN)
/// energy = g^T S g / 2 + c |g|^4 / 4         (pN, per length)
/// ```
///
/// The linear part may be zero, as for filaments of monomers at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(
    feature = "schema",
    schemars(description = "Shear force with a linear and a cubic part.")
)]
pub struct CubicShear {
    /// Linear rigidities S1 and S2 (pN); each at least 0.
    #[cfg_attr(feature = "serde", serde(rename = "linear_pn"))]
    pub linear: [f64; 2],
    /// Cubic rigidity `c` (pN); at least 0, and positive unless S1 and S2 are.
    #[cfg_attr(feature = "serde", serde(rename = "cubic_pn"))]
    pub cubic: f64,
}

impl CubicShear {
    pub(crate) fn times(self, factor: f64) -> Self {
        Self {
            linear: self.linear.map(|s| s * factor),
            cubic: self.cubic * factor,
        }
    }

    /// Checks all parameters.
    ///
    /// # Errors
    /// If a parameter is negative or not finite, or if linear and cubic part are both zero.
    pub(crate) fn validate(&self) -> Result<(), RodParameterError> {
        let [s1, s2] = self.linear;
        for (key, value) in [
            ("linear_pn", s1),
            ("linear_pn", s2),
            ("cubic_pn", self.cubic),
        ] {
            // The linear part may be zero with a cubic part.
            if self.cubic == 0.0 && key != "cubic_pn" {
                RodParameterError::unless_positive(key, value)?;
            }
            if !(value >= 0.0 && value.is_finite()) {
                let rule = "finite and not negative";
                return Err(RodParameterError { key, value, rule });
            }
        }
        Ok(())
    }

    /// Force (pN) at shear strains `g`.
    #[inline]
    pub(crate) fn force(&self, g: Pair) -> Pair {
        Pair::from(self.linear).component_mul(&g) + self.cubic * g.norm_squared() * g
    }

    /// Derivative of the force (pN), symmetric.
    #[inline]
    pub(crate) fn tangent(&self, g: Pair) -> Matrix2<f64> {
        Matrix2::from_diagonal(&Pair::from(self.linear))
            + self.cubic * (2.0 * g * g.transpose() + Matrix2::identity() * g.norm_squared())
    }

    /// Energy per length (pN).
    #[inline]
    pub(crate) fn energy_density(&self, g: Pair) -> f64 {
        let squared = g.norm_squared();
        0.5 * g.dot(&Pair::from(self.linear).component_mul(&g))
            + 0.25 * self.cubic * squared * squared
    }
}

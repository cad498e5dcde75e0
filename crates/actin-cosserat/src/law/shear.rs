//! How a rod resists shear.

use crate::{RodKey, RodParameterError};
use nalgebra::{Matrix2, Vector2};

/// The two shear strains of a cross-section, or the two forces.
type Pair = Vector2<f64>;

/// A shear force that has a linear and a cubic part.
///
/// With `g` the two shear strains of a cross-section, the force is `S g + c |g|^2 g` and the
/// energy per length `g^T S g / 2 + c |g|^4 / 4`. The linear part may be zero: a filament of
/// monomers has none at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CubicShear {
    /// S1 and S2 (pN).
    pub linear: [f64; 2],
    /// `c` (pN).
    pub cubic: f64,
}

impl CubicShear {
    /// The law with its rigidities multiplied.
    pub(crate) fn times(self, factor: f64) -> Self {
        Self {
            linear: self.linear.map(|s| s * factor),
            cubic: self.cubic * factor,
        }
    }

    /// Checks every number.
    ///
    /// # Errors
    /// Negative or non-finite numbers; no resistance at all.
    pub fn validate(&self) -> Result<(), RodParameterError> {
        let [s1, s2] = self.linear;
        for (key, value) in [
            (RodKey::S1, s1),
            (RodKey::S2, s2),
            (RodKey::CubicShear, self.cubic),
        ] {
            // A cubic part makes up for a linear one that is missing.
            if self.cubic == 0.0 && key != RodKey::CubicShear {
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
    pub fn force(&self, g: Pair) -> Pair {
        Pair::from(self.linear).component_mul(&g) + self.cubic * g.norm_squared() * g
    }

    /// Derivative of the force (pN), symmetric.
    #[inline]
    pub fn tangent(&self, g: Pair) -> Matrix2<f64> {
        Matrix2::from_diagonal(&Pair::from(self.linear))
            + self.cubic * (2.0 * g * g.transpose() + Matrix2::identity() * g.norm_squared())
    }

    /// Energy per length (pN).
    #[inline]
    pub fn energy_density(&self, g: Pair) -> f64 {
        let squared = g.norm_squared();
        0.5 * g.dot(&Pair::from(self.linear).component_mul(&g))
            + 0.25 * self.cubic * squared * squared
    }
}

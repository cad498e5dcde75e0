//! Laws of stretch.

use crate::RodParameterError;

/// Law of stretch, as a function of the strain along the rod.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum StretchLaw {
    /// Constant rigidity.
    Constant {
        /// Rigidity (pN); positive.
        #[cfg_attr(feature = "serde", serde(rename = "rigidity_pn"))]
        rigidity: f64,
    },
    /// Different rigidities in tension and compression with a smooth transition.
    ///
    /// The force at strain `e` is `m e + h (sqrt(e^2 + w^2) - w)`, where `m` and `h` are half the
    /// sum and half the difference of the rigidities.
    Sided {
        /// Rigidity far in tension (pN); positive.
        #[cfg_attr(feature = "serde", serde(rename = "tension_pn"))]
        tension: f64,
        /// Rigidity far in compression (pN); positive.
        #[cfg_attr(feature = "serde", serde(rename = "compression_pn"))]
        compression: f64,
        /// Strain width `w` of the transition; positive.
        width: f64,
    },
}

impl StretchLaw {
    /// Checks all parameters.
    ///
    /// # Errors
    /// If a parameter is not positive and finite.
    pub(crate) fn validate(&self) -> Result<(), RodParameterError> {
        match *self {
            Self::Constant { rigidity: s3 } => {
                RodParameterError::unless_positive("rigidity_pn", s3)
            }
            Self::Sided {
                tension,
                compression,
                width,
            } => [
                ("tension_pn", tension),
                ("compression_pn", compression),
                ("width", width),
            ]
            .into_iter()
            .try_for_each(|(key, value)| RodParameterError::unless_positive(key, value)),
        }
    }

    pub(crate) fn times(self, factor: f64) -> Self {
        match self {
            Self::Constant { rigidity } => Self::Constant {
                rigidity: rigidity * factor,
            },
            Self::Sided {
                tension,
                compression,
                width,
            } => Self::Sided {
                tension: tension * factor,
                compression: compression * factor,
                width,
            },
        }
    }

    /// Force (pN) at strain `e`.
    #[inline]
    pub fn force(&self, e: f64) -> f64 {
        match *self {
            Self::Constant { rigidity: s3 } => s3 * e,
            Self::Sided {
                tension,
                compression,
                width,
            } => {
                let root = e.hypot(width);
                // sqrt(e^2 + w^2) - w, without cancellation.
                let bend = e * e / (root + width);
                0.5 * ((tension + compression) * e + (tension - compression) * bend)
            }
        }
    }

    /// Derivative of the force (pN).
    #[inline]
    pub fn tangent(&self, e: f64) -> f64 {
        match *self {
            Self::Constant { rigidity: s3 } => s3,
            Self::Sided {
                tension,
                compression,
                width,
            } => {
                let side = e / e.hypot(width);
                0.5 * ((tension + compression) + (tension - compression) * side)
            }
        }
    }

    /// Energy per length (pN): integral of the force.
    #[inline]
    pub(crate) fn energy_density(&self, e: f64) -> f64 {
        match *self {
            Self::Constant { rigidity: s3 } => 0.5 * s3 * e * e,
            Self::Sided {
                tension,
                compression,
                width,
            } => {
                let area = 0.5 * (e * e.hypot(width) + width * width * (e / width).asinh());
                0.25 * (tension + compression) * e * e
                    + 0.5 * (tension - compression) * (area - width * e)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use actin_mechanics::testing::derivative;

    const SIDED: StretchLaw = StretchLaw::Sided {
        tension: 3.4e4,
        compression: 1.7e4,
        width: 1e-3,
    };

    #[test]
    fn force_and_tangent_are_derivatives() {
        for e in [-0.1, -1e-3, 0.0, 2e-4, 0.05] {
            let force = derivative(1e-5, |h| SIDED.energy_density(e + h));
            assert!((SIDED.force(e) - force).abs() < 1e-7 * 3.4e4 * (0.01 + f64::abs(e)));
            let tangent = derivative(1e-5, |h| SIDED.force(e + h));
            assert!((SIDED.tangent(e) - tangent).abs() < 1e-8 * 3.4e4);
        }
    }

    /// At large strain the force differs by h w = 8.5 pN from rigidity times strain.
    #[test]
    fn each_side_has_its_own_rigidity() {
        assert!((SIDED.force(0.1) - (3.4e3 - 8.5)).abs() < 0.1);
        assert!((SIDED.force(-0.1) + (1.7e3 + 8.5)).abs() < 0.1);
    }
}

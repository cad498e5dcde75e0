//! How the natural length of a rod depends on its twist.

use super::{PolynomialStretch, RootedStretch};
use crate::RodParameterError;

/// A law of natural over rest length, `xi`, against the twist.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum TwistStretch {
    /// A polynomial, as published.
    Polynomial(PolynomialStretch),
    /// One slope on either side of rest.
    Rooted(RootedStretch),
}

impl TwistStretch {
    /// The published polynomial, its offset included.
    pub fn published() -> Self {
        Self::Polynomial(PolynomialStretch::published())
    }

    /// The law that an energy `c3 sigma_3 kappa_3` per length stands for:
    /// [`PolynomialStretch::linear`].
    pub fn linear(c3: f64, s3: f64) -> Self {
        Self::Polynomial(PolynomialStretch::linear(c3, s3))
    }

    /// Checks every number.
    ///
    /// # Errors
    /// What the law's own `validate` refuses.
    pub fn validate(&self) -> Result<(), RodParameterError> {
        match self {
            Self::Polynomial(law) => law.validate(),
            Self::Rooted(law) => law.validate(),
        }
    }

    /// `xi - 1`, its first and its second derivative at `k` (rad/nm).
    #[inline]
    pub fn jet(&self, k: f64) -> [f64; 3] {
        match self {
            Self::Polynomial(law) => law.jet(k),
            Self::Rooted(law) => law.jet(k),
        }
    }

    /// `xi - 1` at twist `k` (rad/nm): the relative change of length that costs no force.
    pub fn extension(&self, k: f64) -> f64 {
        self.jet(k)[0]
    }

    /// Largest twist (rad/nm) that the law's data reach.
    pub fn range(&self) -> f64 {
        match self {
            Self::Polynomial(law) => law.range,
            Self::Rooted(law) => law.range,
        }
    }
}

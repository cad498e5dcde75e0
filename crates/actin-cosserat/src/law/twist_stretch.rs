//! Laws of natural length as a function of twist.

use super::{PolynomialStretch, RootedStretch};
use crate::RodParameterError;

/// Law of the ratio `xi` of natural to rest length as a function of twist.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub enum TwistStretch {
    /// Polynomial, as published.
    Polynomial(PolynomialStretch),
    /// Different slopes on both sides of rest.
    Rooted(RootedStretch),
}

impl TwistStretch {
    /// Published polynomial with its offset.
    pub fn published() -> Self {
        Self::Polynomial(PolynomialStretch::published())
    }

    /// Linear law; see `PolynomialStretch::linear`.
    pub fn linear(c3: f64, s3: f64) -> Self {
        Self::Polynomial(PolynomialStretch::linear(c3, s3))
    }

    /// Checks all parameters.
    ///
    /// # Errors
    /// If a parameter is out of range.
    pub fn validate(&self) -> Result<(), RodParameterError> {
        match self {
            Self::Polynomial(law) => law.validate(),
            Self::Rooted(law) => law.validate(),
        }
    }

    /// `xi - 1` at `k` (rad/nm), with two derivatives.
    #[inline]
    pub(crate) fn jet(&self, k: f64) -> [f64; 3] {
        match self {
            Self::Polynomial(law) => law.jet(k),
            Self::Rooted(law) => law.jet(k),
        }
    }

    /// `xi - 1` at twist `k` (rad/nm).
    pub fn extension(&self, k: f64) -> f64 {
        self.jet(k)[0]
    }

    /// Largest twist (rad/nm) of the data.
    pub fn range(&self) -> f64 {
        match self {
            Self::Polynomial(law) => law.range,
            Self::Rooted(law) => law.range,
        }
    }
}

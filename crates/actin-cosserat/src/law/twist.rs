//! Laws of twist.

use super::{SidedTwist, TanhTwist, TwistRise};
use crate::RodParameterError;

/// Law of twist with secant rigidity `B3(k)`, torque `B3(k) k`, and energy.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum TwistLaw {
    /// Constant rigidity B3 (pN nm^2).
    Constant(f64),
    /// Three tanh steps, as published.
    Tanh(TanhTwist),
    /// Saturation on both sides.
    Sided(SidedTwist),
}

impl TwistLaw {
    /// Checks all parameters.
    ///
    /// # Errors
    /// If a parameter is out of range.
    pub(crate) fn validate(&self) -> Result<(), RodParameterError> {
        match self {
            Self::Constant(b3) => RodParameterError::unless_positive("bend_pn_nm2[2]", *b3),
            Self::Tanh(law) => law.validate(),
            Self::Sided(law) => law.validate(),
        }
    }

    pub(crate) fn times(self, factor: f64) -> Self {
        match self {
            Self::Constant(b3) => Self::Constant(b3 * factor),
            Self::Tanh(law) => Self::Tanh(TanhTwist {
                b_plus: law.b_plus * factor,
                b_minus: law.b_minus * factor,
                ..law
            }),
            Self::Sided(law) => {
                let rise = |side: TwistRise| TwistRise {
                    rise: side.rise * factor,
                    ..side
                };
                Self::Sided(SidedTwist {
                    rest: law.rest * factor,
                    under: rise(law.under),
                    over: rise(law.over),
                    ..law
                })
            }
        }
    }

    /// Torque (pN nm) at twist `k` (rad/nm).
    #[inline]
    pub(crate) fn couple(&self, k: f64) -> f64 {
        match self {
            Self::Constant(b3) => b3 * k,
            Self::Tanh(law) => law.couple(k),
            Self::Sided(law) => law.couple(k),
        }
    }

    /// Derivative of the torque (pN nm^2).
    #[inline]
    pub(crate) fn tangent(&self, k: f64) -> f64 {
        match self {
            Self::Constant(b3) => *b3,
            Self::Tanh(law) => law.tangent(k),
            Self::Sided(law) => law.tangent(k),
        }
    }

    /// Energy per length (pN).
    #[inline]
    pub(crate) fn energy_density(&self, k: f64) -> f64 {
        match self {
            Self::Constant(b3) => 0.5 * b3 * k * k,
            Self::Tanh(law) => law.energy_density(k),
            Self::Sided(law) => law.energy_density(k),
        }
    }

    /// Largest twist (rad/nm) of the data, or `None` without data.
    pub fn range(&self) -> Option<f64> {
        match self {
            Self::Constant(_) => None,
            Self::Tanh(law) => Some(law.range),
            Self::Sided(law) => Some(law.range),
        }
    }
}

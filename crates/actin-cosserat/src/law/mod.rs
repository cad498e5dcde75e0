//! Nonlinear constitutive laws: torque or force, tangent and energy per length.
//!
//! `material.rs` combines them; `extended/` couples segments to curvature.

mod bend;
mod dilogarithm;
mod polynomial_stretch;
mod rooted_stretch;
mod shear;
mod sided_twist;
mod stiffening;
mod stretch;
mod tanh_twist;
#[cfg(test)]
mod tests;
mod twist;
mod twist_stretch;

pub use bend::BendLaw;
pub use polynomial_stretch::PolynomialStretch;
pub use rooted_stretch::RootedStretch;
pub use shear::CubicShear;
pub use sided_twist::{SidedTwist, TwistRise};
pub(crate) use stiffening::Jet;
pub use stiffening::Stiffening;
pub use stretch::StretchLaw;
pub use tanh_twist::TanhTwist;
pub use twist::TwistLaw;
pub use twist_stretch::TwistStretch;

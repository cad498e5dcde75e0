//! Constitutive laws of rods.

use actin_cosserat::{CubicShear, SidedTwist, Stiffening, StretchLaw, TanhTwist, TwistStretch};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Constitutive law of a rod. `Homogenised` is the best approximation of filaments of monomers. Laws marked "to
/// reproduce the paper" are for its figures.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum RodLaw {
    /// One potential of all strains: the energy of cells of monomers of the mean filament or, with sampled
    /// bonds, the mean over samples. In a heat bath of 273 to 323 K it is the free energy of the mean
    /// filament: it depends on the segment length, which must be at least 5 nm, and reported energies are free energies.
    /// The material must be omitted.
    #[default]
    Homogenised,
    /// `Homogenised` without thermal effects, also in a heat bath.
    HomogenisedAthermal,
    /// `Homogenised` at 298 K, with and without a heat bath; energies are then free energies of cells of 36 nm. The
    /// rest length is 0.46 % shorter than as built: a rod held at both ends is under tension.
    HomogenisedAt298K,
    /// Constant rigidities of the material: for custom materials, analytic limits, and to reproduce the paper.
    Constant,
    /// The paper's twisting rigidity B3(kappa) and extension xi(kappa) with all published parameters, `p_0` included:
    /// to reproduce the paper.
    PublishedExtension,
    /// The paper's B3(kappa) and an energy `C3 sigma_3 kappa_3` per length that couples stretch and twist: to
    /// reproduce the paper.
    CouplingEnergy,
    /// Laws of single deformations, fitted to filaments of monomers by the method of the paper. The material
    /// must be omitted.
    Fitted,
    /// Custom laws. Deformations without a law keep the rigidity of the material.
    Laws(Box<RodLaws>),
}

impl RodLaw {
    /// Returns whether the law is one potential of all strains.
    pub fn is_homogenised(&self) -> bool {
        matches!(
            self,
            Self::Homogenised | Self::HomogenisedAthermal | Self::HomogenisedAt298K
        )
    }

    /// Returns whether the law is one of the paper's, with constant bending and shear rigidities.
    pub(crate) fn is_published(&self) -> bool {
        matches!(
            self,
            Self::Constant | Self::PublishedExtension | Self::CouplingEnergy
        )
    }

    /// Returns whether the shear stiffness increases from a small value at rest.
    pub fn has_soft_shear(&self) -> bool {
        match self {
            Self::Laws(laws) => laws.shear.is_some(),
            law => !law.is_published(),
        }
    }

    /// Returns the name of a law that does not use the material, or `None`.
    pub fn whole(&self) -> Option<&'static str> {
        match self {
            Self::Fitted => Some("Fitted"),
            Self::Homogenised => Some("Homogenised"),
            Self::HomogenisedAthermal => Some("HomogenisedAthermal"),
            Self::HomogenisedAt298K => Some("HomogenisedAt298K"),
            _ => None,
        }
    }
}

/// Laws for single deformations.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct RodLaws {
    /// Law of bending.
    pub bend: Option<BendLaw>,
    /// Law of twist.
    pub twist: Option<TwistLaw>,
    /// Law of stretch.
    pub stretch: Option<StretchLaw>,
    /// Law of shear.
    pub shear: Option<ShearLaw>,
    /// Law of rest length against twist.
    pub twist_stretch: Option<TwistStretch>,
}

/// Law of bending.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[non_exhaustive]
pub enum BendLaw {
    /// Rigidity that increases with bending, twist and shear.
    Stiffening(Stiffening),
}

/// Law of twist.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[non_exhaustive]
pub enum TwistLaw {
    /// Three tanh steps, as published.
    Tanh(TanhTwist),
    /// Saturating rigidity, with separate parameters for under- and over-twist.
    Sided(SidedTwist),
}

/// Law of shear.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum ShearLaw {
    /// Force with a linear and a cubic part.
    Cubic(CubicShear),
}

impl From<BendLaw> for actin_cosserat::BendLaw {
    fn from(BendLaw::Stiffening(law): BendLaw) -> Self {
        Self::Stiffening(law)
    }
}

impl From<TwistLaw> for actin_cosserat::TwistLaw {
    fn from(law: TwistLaw) -> Self {
        match law {
            TwistLaw::Tanh(law) => Self::Tanh(law),
            TwistLaw::Sided(law) => Self::Sided(law),
        }
    }
}

impl From<ShearLaw> for CubicShear {
    fn from(ShearLaw::Cubic(law): ShearLaw) -> Self {
        law
    }
}

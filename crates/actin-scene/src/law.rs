//! The rod's constitutive law, as a scene writes it.

use actin_cosserat::{CubicShear, SidedTwist, Stiffening, StretchLaw, TanhTwist, TwistStretch};
use serde::{Deserialize, Serialize};

/// Constitutive law of a rod. `Homogenised` is nearest to filaments of monomers; those named "to reproduce the paper" are for
/// its figures.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub enum RodLaw {
    /// One potential of all strains: the energy of cells of monomers, of the mean filament or, where `monomers` draw
    /// bonds for each interface, the mean over drawings. In a heat bath (`thermal`) the free energy of the mean filament at
    /// 298 K. The material must be left out.
    #[default]
    Homogenised,
    /// That without heat, in a heat bath too.
    HomogenisedAthermal,
    /// That at 298 K, without a heat bath too: 0.46 % shorter than built, so that a rod held at both ends is under tension.
    HomogenisedAt298K,
    /// The rigidities of the material at every strain: for a material of your own, for analytic limits, and to reproduce the
    /// paper.
    Constant,
    /// The paper's twisting rigidity B3(kappa) and extension xi(kappa), all parameters as published,
    /// `p_0` included: to reproduce the paper.
    PublishedExtension,
    /// The paper's B3(kappa) and an energy `C3 sigma_3 kappa_3` per length that couples stretch
    /// and twist: to reproduce the paper.
    CouplingEnergy,
    /// Laws of single deformations fitted to filaments of monomers, as the paper fits them: to go on from the paper. The
    /// material must be left out.
    Fitted,
    /// Your own laws. Deformations without one keep the rigidity of the material.
    Laws(Box<RodLaws>),
}

impl RodLaw {
    /// Whether it is one potential of all strains, with heat or without.
    pub fn is_homogenised(&self) -> bool {
        matches!(
            self,
            Self::Homogenised | Self::HomogenisedAthermal | Self::HomogenisedAt298K
        )
    }

    /// Whether it is one of the paper's, under which neither bending nor shear gets stiffer.
    pub fn is_published(&self) -> bool {
        matches!(
            self,
            Self::Constant | Self::PublishedExtension | Self::CouplingEnergy
        )
    }

    /// Whether rods under it resist shear only once they are sheared.
    pub fn shears_softly(&self) -> bool {
        match self {
            Self::Laws(laws) => laws.shear.is_some(),
            law => !law.is_published(),
        }
    }

    /// The name of a law that leaves nothing to the material.
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

/// A law for each deformation that has one.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct RodLaws {
    /// Law of bending.
    pub bend: Option<BendLaw>,
    /// Law of twist.
    pub twist: Option<TwistLaw>,
    /// Law of stretch.
    pub stretch: Option<StretchLaw>,
    /// Law of shear.
    pub shear: Option<ShearLaw>,
    /// Law of natural length against twist.
    pub twist_stretch: Option<TwistStretch>,
}

/// A law of bending.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub enum BendLaw {
    /// Rigidity that rises with bending, twist and shear.
    Stiffening(Stiffening),
}

/// A law of twist.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub enum TwistLaw {
    /// Three tanh steps, as published.
    Tanh(TanhTwist),
    /// Saturating, with its own rise to either side.
    Sided(SidedTwist),
}

/// A law of shear.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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

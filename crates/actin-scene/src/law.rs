//! The rod's constitutive law, as a scene writes it.

use actin_cosserat::{
    CubicShear, PolynomialStretch, RootedStretch, SidedTwist, Stiffening, TanhTwist, TwistStretch,
};
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
    pub twist_stretch: Option<TwistStretchLaw>,
}

/// A law of bending.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub enum BendLaw {
    /// Rigidity that rises with bending, twist and shear.
    Stiffening {
        /// Rigidity at rest; positive.
        rest_pn_nm2: f64,
        /// What the rigidity gains far from rest; at least 0.
        rise_pn_nm2: f64,
        /// Curvature at which half is gained; positive.
        curvature_per_nm: f64,
        /// Twist at which half is gained; positive. Left out, twist does not stiffen bending.
        #[serde(default)]
        twist_per_nm: Option<f64>,
        /// Shear strain at which half is gained; positive. Left out, shear does not stiffen bending.
        #[serde(default)]
        shear: Option<f64>,
        /// Largest curvature of the data behind the law; positive, may be infinite (`inf`).
        range_per_nm: f64,
    },
}

/// A law of twist.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub enum TwistLaw {
    /// Three tanh steps, as published.
    Tanh {
        /// Limit of far over-twist; finite.
        b_plus_pn_nm2: f64,
        /// Limit of far under-twist; finite.
        b_minus_pn_nm2: f64,
        /// The seven parameters lambda; finite, the second, fifth and seventh positive. The couple must
        /// grow at the end of the range.
        lambda: [f64; 7],
        /// Largest twist of the data behind the law; positive and finite.
        range_per_nm: f64,
    },
    /// Saturating, with its own rise to either side.
    Sided {
        /// Rigidity at rest; at least 0.
        rest_pn_nm2: f64,
        /// In under-twist.
        under: TwistRise,
        /// In over-twist.
        over: TwistRise,
        /// Largest twist of the data behind the law; positive and finite.
        range_per_nm: f64,
    },
}

/// One side of a law of twist: the secant gains `rise k^2 / (k^2 + slow |k| + half^2)`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct TwistRise {
    /// What the rigidity gains far from rest; positive.
    pub rise_pn_nm2: f64,
    /// Twist at which half is gained if `slow_per_nm` is 0; positive.
    pub half_per_nm: f64,
    /// How much the rise is drawn out; at least 0.
    pub slow_per_nm: f64,
}

/// A law of stretch.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub enum StretchLaw {
    /// One rigidity at every strain, instead of the material's.
    Constant {
        /// Rigidity; positive.
        rigidity_pn: f64,
    },
    /// One rigidity in tension, another in compression.
    Sided {
        /// Rigidity far in tension; positive.
        tension_pn: f64,
        /// Rigidity far in compression; positive.
        compression_pn: f64,
        /// Strain over which one changes into the other; positive.
        width: f64,
    },
}

/// A law of shear.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub enum ShearLaw {
    /// Force with a linear and a cubic part.
    Cubic {
        /// S1 and S2; each at least 0.
        linear_pn: [f64; 2],
        /// Force over the cube of the strain; at least 0, and positive unless S1 and S2 are.
        cubic_pn: f64,
    },
}

/// A law of natural length against twist.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub enum TwistStretchLaw {
    /// `xi - 1` as a polynomial of the twist.
    Polynomial {
        /// `p_0` to `p_6` (nm^i/rad^i); finite.
        coefficients: [f64; 7],
        /// Largest twist of the data behind the law; positive, may be infinite (`inf`).
        range_per_nm: f64,
    },
    /// `xi - 1 = slope k - bend (sqrt(k^2 + half^2) - half) + cubic k^3`.
    Rooted {
        /// Slope at rest (nm/rad); finite.
        slope_nm: f64,
        /// Half the difference of the slopes on either side (nm/rad); finite.
        bend_nm: f64,
        /// Twist over which one changes into the other; positive.
        half_per_nm: f64,
        /// Coefficient of the cube (nm^3/rad^3); finite.
        cubic_nm3: f64,
        /// Largest twist of the data behind the law; positive and finite.
        range_per_nm: f64,
    },
}

impl From<BendLaw> for actin_cosserat::BendLaw {
    fn from(law: BendLaw) -> Self {
        let BendLaw::Stiffening {
            rest_pn_nm2,
            rise_pn_nm2,
            curvature_per_nm,
            twist_per_nm,
            shear,
            range_per_nm,
        } = law;
        Self::Stiffening(Stiffening {
            rest: rest_pn_nm2,
            rise: rise_pn_nm2,
            curvature: curvature_per_nm,
            twist: twist_per_nm.unwrap_or(f64::INFINITY),
            shear: shear.unwrap_or(f64::INFINITY),
            range: range_per_nm,
        })
    }
}

impl From<TwistLaw> for actin_cosserat::TwistLaw {
    fn from(law: TwistLaw) -> Self {
        match law {
            TwistLaw::Tanh {
                b_plus_pn_nm2,
                b_minus_pn_nm2,
                lambda,
                range_per_nm,
            } => Self::Tanh(TanhTwist {
                b_plus: b_plus_pn_nm2,
                b_minus: b_minus_pn_nm2,
                lambda,
                range: range_per_nm,
            }),
            TwistLaw::Sided {
                rest_pn_nm2,
                under,
                over,
                range_per_nm,
            } => Self::Sided(SidedTwist {
                rest: rest_pn_nm2,
                under: under.into(),
                over: over.into(),
                range: range_per_nm,
            }),
        }
    }
}

impl From<TwistRise> for actin_cosserat::TwistRise {
    fn from(side: TwistRise) -> Self {
        Self {
            rise: side.rise_pn_nm2,
            half: side.half_per_nm,
            slow: side.slow_per_nm,
        }
    }
}

impl From<StretchLaw> for actin_cosserat::StretchLaw {
    fn from(law: StretchLaw) -> Self {
        match law {
            StretchLaw::Constant { rigidity_pn } => Self::Constant(rigidity_pn),
            StretchLaw::Sided {
                tension_pn,
                compression_pn,
                width,
            } => Self::Sided {
                tension: tension_pn,
                compression: compression_pn,
                width,
            },
        }
    }
}

impl From<ShearLaw> for CubicShear {
    fn from(law: ShearLaw) -> Self {
        let ShearLaw::Cubic {
            linear_pn,
            cubic_pn,
        } = law;
        Self {
            linear: linear_pn,
            cubic: cubic_pn,
        }
    }
}

impl From<TwistStretchLaw> for TwistStretch {
    fn from(law: TwistStretchLaw) -> Self {
        match law {
            TwistStretchLaw::Polynomial {
                coefficients,
                range_per_nm,
            } => Self::Polynomial(PolynomialStretch {
                coefficients,
                range: range_per_nm,
            }),
            TwistStretchLaw::Rooted {
                slope_nm,
                bend_nm,
                half_per_nm,
                cubic_nm3,
                range_per_nm,
            } => Self::Rooted(RootedStretch {
                slope: slope_nm,
                bend: bend_nm,
                half: half_per_nm,
                cubic: cubic_nm3,
                range: range_per_nm,
            }),
        }
    }
}

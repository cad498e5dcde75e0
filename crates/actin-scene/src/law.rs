//! Constitutive law of the rod.

use actin_cosserat::{
    CubicShear, PolynomialStretch, RootedStretch, SidedTwist, Stiffening, TanhTwist, TwistStretch,
};
use serde::{Deserialize, Serialize};

/// Constitutive law of a rod. `Homogenised` is the best approximation of filaments of monomers. Laws marked "to
/// reproduce the paper" are for its figures.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub enum RodLaw {
    /// One potential of all strains: the energy of cells of monomers of the mean filament or, with sampled bonds in
    /// `monomers`, the mean over samples. In a heat bath (`thermal`) it is the free energy of the mean filament at
    /// 298 K. The material must be omitted.
    #[default]
    Homogenised,
    /// `Homogenised` without thermal effects, also in a heat bath.
    HomogenisedAthermal,
    /// `Homogenised` at 298 K, also without a heat bath. The rest length is 0.46 % shorter than as built: a rod held
    /// at both ends is under tension.
    HomogenisedAt298K,
    /// Constant rigidities of the material: for a custom material, for analytic limits, and to reproduce the paper.
    Constant,
    /// The paper's twisting rigidity B3(kappa) and extension xi(kappa) with all published parameters, `p_0` included:
    /// to reproduce the paper.
    PublishedExtension,
    /// The paper's B3(kappa) and an energy `C3 sigma_3 kappa_3` per length that couples stretch and twist: to
    /// reproduce the paper.
    CouplingEnergy,
    /// Laws of single deformations fitted to filaments of monomers by the method of the paper: to extend the paper.
    /// The material must be omitted.
    Fitted,
    /// Custom laws. Deformations without a law keep the rigidity of the material.
    Laws(Box<RodLaws>),
}

impl RodLaw {
    /// Returns whether the law is one potential of all strains, with or without thermal effects.
    pub fn is_homogenised(&self) -> bool {
        matches!(
            self,
            Self::Homogenised | Self::HomogenisedAthermal | Self::HomogenisedAt298K
        )
    }

    /// Returns whether the law is one of the paper's, with constant bending and shearing rigidities.
    pub fn is_published(&self) -> bool {
        matches!(
            self,
            Self::Constant | Self::PublishedExtension | Self::CouplingEnergy
        )
    }

    /// Returns whether the shear stiffness increases from a small value at rest.
    pub fn shears_softly(&self) -> bool {
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
    /// Law of extension against twist.
    pub twist_stretch: Option<TwistStretchLaw>,
}

/// Law of bending.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub enum BendLaw {
    /// Rigidity that increases with bending, twist and shear.
    Stiffening {
        /// Rigidity at rest; positive.
        rest_pn_nm2: f64,
        /// Increase of the rigidity at large strain; at least 0.
        rise_pn_nm2: f64,
        /// Curvature at half of the increase; positive.
        curvature_per_nm: f64,
        /// Twist at half of the increase; positive. By default twist does not stiffen bending.
        #[serde(default)]
        twist_per_nm: Option<f64>,
        /// Shear strain at half of the increase; positive. By default shear does not stiffen bending.
        #[serde(default)]
        shear: Option<f64>,
        /// Largest curvature in the data of the fit; positive, may be infinite (`inf`).
        range_per_nm: f64,
    },
}

/// Law of twist.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub enum TwistLaw {
    /// Three tanh steps, as published.
    Tanh {
        /// Limit at large over-twist; finite.
        b_plus_pn_nm2: f64,
        /// Limit at large under-twist; finite.
        b_minus_pn_nm2: f64,
        /// Parameters lambda 1 to 7; finite, with positive second, fifth and seventh. The couple must increase with
        /// twist at the end of the range.
        lambda: [f64; 7],
        /// Largest twist in the data of the fit; positive and finite.
        range_per_nm: f64,
    },
    /// Saturating rigidity with different increases in under-twist and over-twist.
    Sided {
        /// Rigidity at rest; at least 0.
        rest_pn_nm2: f64,
        /// Increase in under-twist.
        under: TwistRise,
        /// Increase in over-twist.
        over: TwistRise,
        /// Largest twist in the data of the fit; positive and finite.
        range_per_nm: f64,
    },
}

/// One side of a law of twist. The secant rigidity increases by `rise k^2 / (k^2 + slow |k| + half^2)` at twist `k`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct TwistRise {
    /// Increase of the rigidity at large twist; positive.
    pub rise_pn_nm2: f64,
    /// Twist at half of the increase if `slow_per_nm` is 0; positive.
    pub half_per_nm: f64,
    /// Twist that delays the saturation (`slow`); at least 0.
    pub slow_per_nm: f64,
}

/// Law of stretch.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub enum StretchLaw {
    /// Constant rigidity, which replaces the rigidity of the material.
    Constant {
        /// Rigidity; positive.
        rigidity_pn: f64,
    },
    /// Different rigidities in tension and compression.
    Sided {
        /// Rigidity at large tension; positive.
        tension_pn: f64,
        /// Rigidity at large compression; positive.
        compression_pn: f64,
        /// Width of the transition in strain; positive.
        width: f64,
    },
}

/// Law of shear.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub enum ShearLaw {
    /// Force with a linear and a cubic term.
    Cubic {
        /// Linear rigidities S1 and S2; each at least 0.
        linear_pn: [f64; 2],
        /// Force divided by the cube of the strain; at least 0, and positive unless S1 and S2 are.
        cubic_pn: f64,
    },
}

/// Law of extension against twist.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub enum TwistStretchLaw {
    /// `xi - 1` as a polynomial of the twist.
    Polynomial {
        /// `p_0` to `p_6` (nm^i/rad^i); finite.
        coefficients: [f64; 7],
        /// Largest twist in the data of the fit; positive, may be infinite (`inf`).
        range_per_nm: f64,
    },
    /// `xi - 1 = slope k - bend (sqrt(k^2 + half^2) - half) + cubic k^3`.
    Rooted {
        /// Slope at rest (nm/rad); finite.
        slope_nm: f64,
        /// Half the difference of the slopes on either side (nm/rad); finite.
        bend_nm: f64,
        /// Width of the transition in twist; positive.
        half_per_nm: f64,
        /// Coefficient of the cube (nm^3/rad^3); finite.
        cubic_nm3: f64,
        /// Largest twist in the data of the fit; positive and finite.
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

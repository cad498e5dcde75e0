//! The rod's constitutive law, as a scene writes it.

use serde::{Deserialize, Serialize};

/// How the rod departs from constant rigidities.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum RodLaw {
    /// Not at all.
    #[default]
    Constant,
    /// The paper's B3(kappa) and xi(kappa), all parameters as published, `p_0` included.
    PublishedExtension,
    /// The paper's B3(kappa) and an energy `C3 sigma_3 kappa_3` per length.
    CouplingEnergy,
    /// Laws fitted to measurements on filaments of monomers.
    Fitted,
    /// Laws of one's own; what is left out is constant.
    Laws(Box<RodLaws>),
}

/// A law for each deformation that has one.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RodLaws {
    /// Bending.
    pub bend: Option<BendLaw>,
    /// Twist.
    pub twist: Option<TwistLaw>,
    /// Stretch.
    pub stretch: Option<StretchLaw>,
    /// Shear.
    pub shear: Option<ShearLaw>,
    /// Natural length against twist.
    pub twist_stretch: Option<TwistStretchLaw>,
}

/// A law of bending.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub enum BendLaw {
    /// Rigidity that rises with bending, twist and shear.
    Stiffening {
        /// Rigidity at rest (pN nm^2).
        rest_pn_nm2: f64,
        /// What it gains (pN nm^2).
        rise_pn_nm2: f64,
        /// Curvature that gains half (rad/nm).
        curvature_per_nm: f64,
        /// Twist that gains half (rad/nm); without it twist does not stiffen.
        #[serde(default)]
        twist_per_nm: Option<f64>,
        /// Shear strain that gains half; without it shear does not stiffen.
        #[serde(default)]
        shear: Option<f64>,
        /// Largest curvature of the data behind it (rad/nm).
        range_per_nm: f64,
    },
}

/// A law of twist.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub enum TwistLaw {
    /// Three tanh steps, as published.
    Tanh {
        /// Limit of far over-twist (pN nm^2).
        b_plus_pn_nm2: f64,
        /// Limit of far under-twist (pN nm^2).
        b_minus_pn_nm2: f64,
        /// The seven parameters lambda.
        lambda: [f64; 7],
        /// Largest twist of the data behind it (rad/nm).
        range_per_nm: f64,
    },
    /// Saturating, with its own rise to either side.
    Sided {
        /// Rigidity at rest (pN nm^2).
        rest_pn_nm2: f64,
        /// In under-twist.
        under: TwistRise,
        /// In over-twist.
        over: TwistRise,
        /// Largest twist of the data behind it (rad/nm).
        range_per_nm: f64,
    },
}

/// One side of a law of twist: the secant gains `rise k^2 / (k^2 + slow |k| + half^2)`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TwistRise {
    /// What it gains far from rest (pN nm^2).
    pub rise_pn_nm2: f64,
    /// Twist at which half is gained if `slow` is none (rad/nm).
    pub half_per_nm: f64,
    /// How much the rise is drawn out (rad/nm).
    pub slow_per_nm: f64,
}

/// A law of stretch.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub enum StretchLaw {
    /// One rigidity at every strain, in place of the material's.
    Constant {
        /// Rigidity (pN).
        rigidity_pn: f64,
    },
    /// One rigidity in tension, another in compression.
    Sided {
        /// Far in tension (pN).
        tension_pn: f64,
        /// Far in compression (pN).
        compression_pn: f64,
        /// Strain over which one goes over into the other.
        width: f64,
    },
}

/// A law of shear.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum ShearLaw {
    /// Force with a linear and a cubic part.
    Cubic {
        /// S1 and S2 (pN), which may be 0.
        linear_pn: [f64; 2],
        /// Force over the cube of the strain (pN).
        cubic_pn: f64,
    },
}

/// A law of natural length against twist.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum TwistStretchLaw {
    /// `xi - 1` as a polynomial of the twist.
    Polynomial {
        /// `p_0` to `p_6` (nm^i/rad^i).
        coefficients: [f64; 7],
        /// Largest twist of the data behind it (rad/nm).
        range_per_nm: f64,
    },
    /// `xi - 1 = slope k - bend (sqrt(k^2 + half^2) - half) + cubic k^3`.
    Rooted {
        /// Slope at rest (nm/rad).
        slope_nm: f64,
        /// Half the difference of the slopes on either side (nm/rad).
        bend_nm: f64,
        /// Twist over which one goes over into the other (rad/nm).
        half_per_nm: f64,
        /// Coefficient of the cube (nm^3/rad^3).
        cubic_nm3: f64,
        /// Largest twist of the data behind it (rad/nm).
        range_per_nm: f64,
    },
}

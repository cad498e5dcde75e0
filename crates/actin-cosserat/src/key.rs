//! Names of parameters in errors.

use std::fmt;

/// Parameter of a rod or of its laws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RodKey {
    /// `S1` (pN).
    S1,
    /// `S2` (pN).
    S2,
    /// `S3` (pN).
    S3,
    /// `B1` (pN nm^2).
    B1,
    /// `B2` (pN nm^2).
    B2,
    /// `B3` (pN nm^2).
    B3,
    /// Rigidity at rest.
    Rest,
    /// Rise of a rigidity.
    Rise,
    /// Curvature at half the rise.
    Curvature,
    /// Twist scale of bending.
    Twist,
    /// Shear scale of bending.
    Shear,
    /// Limit of the range.
    Range,
    /// `b_plus` of [`TanhTwist`](crate::TanhTwist).
    BPlus,
    /// `b_minus` of [`TanhTwist`](crate::TanhTwist).
    BMinus,
    /// A `lambda` of [`TanhTwist`](crate::TanhTwist).
    Lambda,
    /// Width `lambda 2`.
    Lambda2,
    /// Width `lambda 5`.
    Lambda5,
    /// Width `lambda 7`.
    Lambda7,
    /// Slope of the torque at the limit of the range.
    EndSlope,
    /// Twist at half the rise.
    Half,
    /// Twist scale of the slow rise.
    Slow,
    /// Rigidity in tension.
    Tension,
    /// Rigidity in compression.
    Compression,
    /// Width of the transition.
    Width,
    /// Linear coefficient of [`RootedStretch`](crate::RootedStretch).
    Slope,
    /// Coefficient of the root of [`RootedStretch`](crate::RootedStretch).
    Bend,
    /// Cubic coefficient.
    Cubic,
    /// Coefficient of a polynomial.
    Coefficient,
    /// Cubic shear rigidity.
    CubicShear,
    /// Factor of rigidities.
    Factor,
    /// Rest curvature.
    RestCurvature,
    /// Mass per length.
    LinearDensity,
    /// Area of the cross-section.
    Area,
    /// Rest length of segments.
    SegmentLength,
    /// Temperature of a heat bath (K).
    Temperature,
}

impl fmt::Display for RodKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::S1 => "S1",
            Self::S2 => "S2",
            Self::S3 => "S3",
            Self::B1 => "B1",
            Self::B2 => "B2",
            Self::B3 => "B3",
            Self::Rest => "rest",
            Self::Rise => "rise",
            Self::Curvature => "curvature",
            Self::Twist => "twist",
            Self::Shear => "shear",
            Self::Range => "range",
            Self::BPlus => "b_plus",
            Self::BMinus => "b_minus",
            Self::Lambda => "lambda",
            Self::Lambda2 => "lambda 2",
            Self::Lambda5 => "lambda 5",
            Self::Lambda7 => "lambda 7",
            Self::EndSlope => "slope of the couple at the end of the range",
            Self::Half => "half",
            Self::Slow => "slow",
            Self::Tension => "tension",
            Self::Compression => "compression",
            Self::Width => "width",
            Self::Slope => "slope",
            Self::Bend => "bend",
            Self::Cubic => "cubic",
            Self::Coefficient => "p",
            Self::CubicShear => "cubic_shear",
            Self::Factor => "factor",
            Self::RestCurvature => "rest_curvature",
            Self::LinearDensity => "linear_density",
            Self::Area => "area",
            Self::SegmentLength => "segment length",
            Self::Temperature => "temperature",
        })
    }
}

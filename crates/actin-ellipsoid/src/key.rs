//! Parameter names in errors.

use crate::InterfaceKind;
use std::fmt;

/// A parameter of the ellipsoid model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EllipsoidKey {
    /// Distance of the centres from the axis.
    Radius,
    /// Rise from monomer to monomer.
    Rise,
    /// Turn from monomer to monomer.
    Turn,
    /// Azimuth of lattice index 0.
    Azimuth,
    /// Semi-axis of a monomer.
    SemiAxes,
    /// Mass of a monomer.
    Mass,
    /// Parameter of an interface.
    Interface(InterfaceKind, InterfaceKey),
}

/// A parameter of an interface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InterfaceKey {
    /// Rigidity of the interface.
    Rigidity,
    /// Number of bonds.
    Bonds,
    /// Minimum bond length.
    MinimumLength,
    /// Maximum bond length.
    MaximumLength,
}

impl fmt::Display for EllipsoidKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Radius => "radius",
            Self::Rise => "rise",
            Self::Turn => "turn",
            Self::Azimuth => "azimuth",
            Self::SemiAxes => "semi_axes",
            Self::Mass => "mass",
            Self::Interface(InterfaceKind::Lateral, key) => return write!(f, "lateral.{key}"),
            Self::Interface(InterfaceKind::Longitudinal, key) => {
                return write!(f, "longitudinal.{key}");
            }
        })
    }
}

impl fmt::Display for InterfaceKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Rigidity => "rigidity",
            Self::Bonds => "bonds",
            Self::MinimumLength => "minimum_length",
            Self::MaximumLength => "maximum_length",
        })
    }
}

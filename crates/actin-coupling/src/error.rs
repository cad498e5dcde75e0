//! Why a junction or a linker was refused.

use actin_cosserat::{RodError, RodParameterError};
use std::fmt;
use thiserror::Error;

/// Why a junction was refused.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum JunctionError {
    /// A parameter is out of range.
    #[error(transparent)]
    Parameter(#[from] RodParameterError),
    /// The rod of the junction was refused.
    #[error(transparent)]
    Rod(#[from] RodError),
    /// Too few or too many attached monomers.
    #[error("attached monomers = {0}: must be 1 or 2")]
    AttachedMonomers(usize),
    /// Not one junction frame for each attached monomer.
    #[error("{frames} junction frames for {monomers} attached monomers: must be as many")]
    JunctionFrames {
        /// Number of junction frames.
        frames: usize,
        /// Number of attached monomers.
        monomers: usize,
    },
    /// A monomer that is not on its own side of the rod's end.
    #[error(
        "attached monomer {monomer} stands {distance} nm from the rod's end along the axis, away \
         from the rod: must be positive and finite"
    )]
    AxialDistance {
        /// Which attached monomer, counted from 0.
        monomer: usize,
        /// Its axial distance from the rod's end, away from the rod (nm).
        distance: f64,
    },
    /// A junction frame that is not parallel to the rod's end in the state given as at rest.
    #[error(
        "junction frame {frame} is turned by {angle:e} rad from the rod's end segment: they must \
         be parallel at rest"
    )]
    NotParallel {
        /// Index of the frame in the state.
        frame: usize,
        /// Angle between the two frames (rad).
        angle: f64,
    },
}

/// Why a linker or its site was refused.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum LinkerError {
    /// A number that breaks the rule of its key.
    #[error("{key} = {value}: must be {rule}")]
    Parameter {
        /// Which parameter.
        key: LinkerKey,
        /// What it was.
        value: f64,
        /// What it must be.
        rule: &'static str,
    },
    /// The rod of the site was refused.
    #[error(transparent)]
    Rod(#[from] RodError),
    /// A segment that the rod does not have.
    #[error("segment {segment} of a rod that has {segments}, counted from 0")]
    Segment {
        /// Which segment was asked for.
        segment: usize,
        /// Number of segments of the rod.
        segments: usize,
    },
}

/// A number of a linker or of its site.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinkerKey {
    /// Where on a segment, as a share of it.
    Fraction,
    /// Distance from the axis.
    Radius,
    /// Azimuth about the axis.
    Azimuth,
    /// Place in the frame of a monomer.
    Arm,
    /// Stiffness of the spring.
    Stiffness,
    /// Length of the spring at rest.
    RestLength,
    /// Place of an anchor.
    Anchor,
}

impl fmt::Display for LinkerKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Fraction => "fraction",
            Self::Radius => "radius",
            Self::Azimuth => "azimuth",
            Self::Arm => "arm",
            Self::Stiffness => "stiffness",
            Self::RestLength => "rest_length",
            Self::Anchor => "anchor",
        })
    }
}

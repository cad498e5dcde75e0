use actin_cosserat::{RodError, RodParameterError};
use std::fmt;
use thiserror::Error;

/// Error of the construction of a junction.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum JunctionError {
    /// Invalid parameter of the rod material.
    #[error(transparent)]
    Parameter(#[from] RodParameterError),
    /// Invalid rod.
    #[error(transparent)]
    Rod(#[from] RodError),
    /// The number of attached monomers is not one or two.
    #[error("attached monomers = {0}: must be 1 or 2")]
    AttachedMonomers(usize),
    /// The numbers of junction frames and of attached monomers differ.
    #[error("{frames} junction frames for {monomers} attached monomers: the numbers must be equal")]
    JunctionFrames {
        /// Number of junction frames.
        frames: usize,
        /// Number of attached monomers.
        monomers: usize,
    },
    /// A monomer is on the wrong side of the end of the rod.
    #[error(
        "attached monomer {monomer} is at {distance} nm from the rod's end along the axis, away from \
         the rod: the distance must be positive and finite"
    )]
    AxialDistance {
        /// Index of the attached monomer.
        monomer: usize,
        /// Axial distance from the end of the rod, away from the rod (nm).
        distance: f64,
    },
    /// A junction frame is not parallel to the end of the rod at rest.
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

/// Error of the construction of a linker or site.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum LinkerError {
    /// Invalid parameter.
    #[error("{key} = {value}: must be {rule}")]
    Parameter {
        /// Parameter.
        key: LinkerKey,
        /// Rejected value.
        value: f64,
        /// Violated rule.
        rule: &'static str,
    },
    /// Invalid rod.
    #[error(transparent)]
    Rod(#[from] RodError),
    /// A linker with angular stiffness does not connect two frames.
    #[error("stiffness against tilt and twist needs sites of two different monomers or segments")]
    Angles,
    /// The segment does not exist.
    #[error("segment {segment} does not exist: the rod has {segments} segments, counted from 0")]
    Segment {
        /// Requested segment.
        segment: usize,
        /// Number of segments.
        segments: usize,
    },
}

/// Parameter of a linker or site.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinkerKey {
    /// Relative position on a segment.
    Fraction,
    /// Distance from the axis.
    Radius,
    /// Azimuth about the axis.
    Azimuth,
    /// Position in the frame of a monomer.
    Arm,
    /// Stiffness of the spring.
    Stiffness,
    /// Rest length of the spring.
    RestLength,
    /// Position of an anchor.
    Anchor,
    /// Stiffness against tilt.
    Tilt,
    /// Stiffness against twist.
    Twist,
    /// Length as built.
    Length,
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
            Self::Tilt => "tilt",
            Self::Twist => "twist",
            Self::Length => "length",
        })
    }
}

//! Why a junction or a linker was refused.

use actin_cosserat::{RodError, RodParameterError};
use thiserror::Error;

/// Why a junction was refused.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
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
pub enum LinkerError {
    /// A parameter is out of range.
    #[error(transparent)]
    Parameter(#[from] RodParameterError),
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

//! Errors of parameters and rods.

use crate::End;
use thiserror::Error;

/// A parameter out of range.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("{key} = {value}: must be {rule}")]
pub struct RodParameterError {
    /// Parameter, with its unit, as in scenes.
    pub key: &'static str,
    /// Rejected value.
    pub value: f64,
    /// Rule that the value violates.
    pub rule: &'static str,
}

/// Invalid rod.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum RodError {
    /// A parameter is out of range.
    #[error(transparent)]
    Parameter(#[from] RodParameterError),
    /// The rod has no segments.
    #[error("segments = 0: a rod has at least one")]
    NoSegments,
    /// A rest length or its inverse is not positive and finite.
    #[error(
        "rest length of segment {segment} = {value} nm: must be positive and finite, and so must its inverse"
    )]
    SegmentLength {
        /// Index of the segment.
        segment: usize,
        /// Rest length (nm).
        value: f64,
    },
    /// The inertia of a segment overflows or underflows.
    #[error(
        "rest length of segment {segment} = {value} nm: its mass and moments of inertia, and their inverses, \
         must be positive and finite"
    )]
    SegmentInertia {
        /// Index of the segment.
        segment: usize,
        /// Rest length (nm).
        value: f64,
    },
    /// A position or the orientation is not finite.
    #[error("the position of node {node} and the orientation of a rod must be finite")]
    Place {
        /// Index of the node.
        node: usize,
    },
    /// A rest shape is not finite.
    #[error("the rest shape of joint {joint} must be finite")]
    RestShape {
        /// Index of the joint.
        joint: usize,
    },
    /// A curvature is not finite.
    #[error("the curvature at s = {s} nm must be finite")]
    Curvature {
        /// Rest arc length from node 0 (nm).
        s: f64,
    },
    /// A rest distance or its inverse is not positive and finite.
    #[error(
        "rest distance of joint {joint} = {value} nm: must be positive and finite, and so must its inverse"
    )]
    JointDistance {
        /// Index of the joint.
        joint: usize,
        /// Rest distance (nm).
        value: f64,
    },
    /// The direction is zero or not finite.
    #[error("the direction of a rod must be finite and not zero")]
    NoAxis,
    /// The number of positions differs from the number of nodes.
    #[error("{given} positions for a rod of {needed} nodes: give one position per node")]
    Nodes {
        /// Number of positions.
        given: usize,
        /// Number of nodes.
        needed: usize,
    },
    /// Two neighbouring nodes coincide, or a position is not finite.
    #[error("the nodes of segment {segment} must have two different finite positions")]
    NoDirection {
        /// Index of the segment.
        segment: usize,
    },
    /// The interaction does not support a potential.
    #[error("{0} does not support a potential: use EnergyGradient")]
    Potential(&'static str),
    /// The end has no wall frame.
    #[error("the {0} of the rod has no wall frame to be clamped to: build it with one")]
    NoWall(End),
}

impl RodParameterError {
    /// Returns an error if `value` is not positive and finite.
    ///
    /// # Errors
    /// If `value` is zero, negative, infinite or NaN.
    pub(crate) fn unless_positive(key: &'static str, value: f64) -> Result<(), Self> {
        if value.is_finite() && value > 0.0 {
            Ok(())
        } else {
            let rule = "positive and finite";
            Err(Self { key, value, rule })
        }
    }

    /// Returns an error if `value` is not finite.
    ///
    /// # Errors
    /// If `value` is infinite or NaN.
    pub(crate) fn check_finite(key: &'static str, value: f64) -> Result<(), Self> {
        if value.is_finite() {
            Ok(())
        } else {
            let rule = "finite";
            Err(Self { key, value, rule })
        }
    }
}

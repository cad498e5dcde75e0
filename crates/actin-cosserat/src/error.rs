//! Why parameters or a rod were refused.

use crate::{RodEnd, RodKey};
use thiserror::Error;

/// A number that breaks the rule of its key.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("{key} = {value}: must be {rule}")]
pub struct RodParameterError {
    /// Which parameter.
    pub key: RodKey,
    /// What it was.
    pub value: f64,
    /// What it must be.
    pub rule: &'static str,
}

/// Why a rod was refused.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum RodError {
    /// A parameter is out of range.
    #[error(transparent)]
    Parameter(#[from] RodParameterError),
    /// A rod without segments.
    #[error("segments = 0: a rod has at least one")]
    NoSegments,
    /// A segment without a length that can be computed with.
    #[error(
        "rest length of segment {segment} = {value} nm: must be positive and finite, and so must its inverse"
    )]
    SegmentLength {
        /// Which segment, counted from 0.
        segment: usize,
        /// Its rest length (nm).
        value: f64,
    },
    /// A segment whose inertia overflows or underflows.
    #[error(
        "rest length of segment {segment} = {value} nm: its mass and moments of inertia, and their inverses, \
         must be positive and finite"
    )]
    SegmentInertia {
        /// Which segment, counted from 0.
        segment: usize,
        /// Its rest length (nm).
        value: f64,
    },
    /// A rod whose start, orientation or nodes are not finite.
    #[error("the place of node {node} of a rod and its orientation must be finite")]
    Place {
        /// Which node, counted from 0.
        node: usize,
    },
    /// A rest shape that is not finite.
    #[error("the rest shape of joint {joint} must be finite")]
    RestShape {
        /// Which joint, counted from 0.
        joint: usize,
    },
    /// A curvature that is not finite.
    #[error("the curvature at s = {s} nm must be finite")]
    Curvature {
        /// Rest arc length from node 0 (nm).
        s: f64,
    },
    /// A joint without a distance between its frames that can be computed with.
    #[error(
        "rest distance of joint {joint} = {value} nm: must be positive and finite, and so must its inverse"
    )]
    JointDistance {
        /// Which joint, counted from 0.
        joint: usize,
        /// Its rest distance (nm).
        value: f64,
    },
    /// A rod along a vector that is zero or not finite.
    #[error("the direction of a rod must be finite and not zero")]
    NoAxis,
    /// Not one place for each node.
    #[error("{given} places for a rod of {needed} nodes: must be as many")]
    Nodes {
        /// Number of places.
        given: usize,
        /// Number of nodes.
        needed: usize,
    },
    /// Two neighbouring nodes at the same place, or one at a place that is not finite.
    #[error("the nodes of segment {segment} must be at two different finite places")]
    NoDirection {
        /// Which segment, counted from 0.
        segment: usize,
    },
    /// A potential where nothing knows the curvature around a segment.
    #[error("{0} takes a law for each strain only: EnergyGradient takes a potential")]
    Potential(&'static str),
    /// A wall clamp at an end that was built without a wall frame.
    #[error("the {0} of the rod has no wall frame to be clamped to: build it with one")]
    NoWall(RodEnd),
}

impl RodParameterError {
    /// Refuses what is not a positive finite number.
    ///
    /// # Errors
    /// Zero, negative numbers, infinities and NaN.
    pub fn unless_positive(key: RodKey, value: f64) -> Result<(), Self> {
        if value.is_finite() && value > 0.0 {
            Ok(())
        } else {
            let rule = "positive and finite";
            Err(Self { key, value, rule })
        }
    }

    /// Refuses what is not a finite number.
    ///
    /// # Errors
    /// Infinities and NaN.
    pub fn unless_finite(key: RodKey, value: f64) -> Result<(), Self> {
        if value.is_finite() {
            Ok(())
        } else {
            let rule = "finite";
            Err(Self { key, value, rule })
        }
    }
}

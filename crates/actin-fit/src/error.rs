//! What can be wrong with data, settings and fits.

use crate::report::StartReport;
use thiserror::Error;

/// Why there is no fit.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum FitError {
    /// A list has another length than the one it belongs to.
    #[error("{what} must have length {expected}, but has {found}")]
    Dimension {
        /// The list.
        what: &'static str,
        /// The length that it must have.
        expected: usize,
        /// The length that it has.
        found: usize,
    },
    /// Data hold a number that is not finite.
    #[error("{what} {index} must be finite, but is {value}")]
    NotFinite {
        /// The list.
        what: &'static str,
        /// The place in it.
        index: usize,
        /// The number.
        value: f64,
    },
    /// A weight, deviation or setting is not positive and finite.
    #[error("{what} {index} must be positive and finite, but is {value}")]
    NotPositive {
        /// The list.
        what: &'static str,
        /// The place in it.
        index: usize,
        /// The number.
        value: f64,
    },
    /// There are fewer points than parameters and their uncertainty need.
    #[error("{needed} points are needed, but there are {points}")]
    TooFewPoints {
        /// Number of points.
        points: usize,
        /// Least number: the parameters that may vary, and one more unless deviations are known.
        needed: usize,
    },
    /// The columns of a design depend on one another.
    #[error(
        "the data determine {rank} of {parameters} parameters; not determined: {undetermined:?}"
    )]
    RankDeficient {
        /// Rank of the scaled design.
        rank: usize,
        /// Number of its columns.
        parameters: usize,
        /// Parameters that take part in a combination of which the data say nothing.
        undetermined: Vec<usize>,
    },
    /// A lower bound is not below the upper one, or one is not a number.
    #[error("bounds of parameter {parameter} must be in order, but are {lower} and {upper}")]
    BadBounds {
        /// The parameter.
        parameter: usize,
        /// Its lower bound.
        lower: f64,
        /// Its upper bound.
        upper: f64,
    },
    /// Starts cannot be drawn for a parameter without two finite bounds.
    #[error(
        "starts are drawn within finite bounds, but those of parameter {parameter} are {lower} and {upper}"
    )]
    Unbounded {
        /// The parameter.
        parameter: usize,
        /// Its lower bound.
        lower: f64,
        /// Its upper bound.
        upper: f64,
    },
    /// A start lies outside the bounds.
    #[error("start {start} must lie within bounds, but its parameter {parameter} is {value}")]
    StartOutside {
        /// Number of the start.
        start: usize,
        /// The parameter.
        parameter: usize,
        /// Its value.
        value: f64,
    },
    /// No start was given.
    #[error("a nonlinear fit needs a start, but none was given")]
    NoStart,
    /// The model is not finite at a point where it is asked for.
    #[error("the model is not finite at point {point}: {value}")]
    ModelNotFinite {
        /// The point.
        point: usize,
        /// Value or derivative.
        value: f64,
    },
    /// No start converged.
    #[error("none of {} starts converged", .starts.len())]
    NoConvergence {
        /// How each ended.
        starts: Vec<StartReport>,
    },
    /// The singular values could not be computed.
    #[error("the singular values of the {rows} x {columns} triangle were not found")]
    NoSingularValues {
        /// Rows of the triangle.
        rows: usize,
        /// Columns of the triangle.
        columns: usize,
    },
}

/// Checks a length.
pub(crate) fn same_length(
    what: &'static str,
    expected: usize,
    found: usize,
) -> Result<(), FitError> {
    if expected == found {
        return Ok(());
    }
    Err(FitError::Dimension {
        what,
        expected,
        found,
    })
}

/// Checks that all numbers are finite.
pub(crate) fn all_finite(what: &'static str, values: &[f64]) -> Result<(), FitError> {
    match values.iter().position(|v| !v.is_finite()) {
        None => Ok(()),
        Some(index) => Err(FitError::NotFinite {
            what,
            index,
            value: values[index],
        }),
    }
}

/// Checks that all numbers are positive and finite.
pub(crate) fn all_positive(what: &'static str, values: &[f64]) -> Result<(), FitError> {
    match values.iter().position(|v| !(v.is_finite() && *v > 0.0)) {
        None => Ok(()),
        Some(index) => Err(FitError::NotPositive {
            what,
            index,
            value: values[index],
        }),
    }
}

/// Checks the number of points against the number of parameters that may vary.
pub(crate) fn enough_points(points: usize, needed: usize) -> Result<(), FitError> {
    if points >= needed {
        return Ok(());
    }
    Err(FitError::TooFewPoints { points, needed })
}

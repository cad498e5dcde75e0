//! What can be wrong with data, settings and fits.

use crate::search_report::StartReport;
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
    /// A number is so large or small that squares overflow or vanish.
    #[error(
        "{what} {index} is {value:e}: must be from {least:e} to {most:e}, or squares are lost; \
         choose another unit"
    )]
    OutOfRange {
        /// The list.
        what: &'static str,
        /// The place in it.
        index: usize,
        /// The number.
        value: f64,
        /// Its least size.
        least: f64,
        /// Its largest size.
        most: f64,
    },
    /// A parameter or its variance is outside of what a number can hold.
    #[error(
        "the {what} of parameter {parameter} is too large or too small for a number; choose another \
         unit for the parameter or the data"
    )]
    Lost {
        /// Value or variance.
        what: &'static str,
        /// The parameter.
        parameter: usize,
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
    #[error("none of {} starts converged; {}", .starts.len(), closest(.starts, *.cosine))]
    NoConvergence {
        /// How each ended.
        starts: Vec<StartReport>,
        /// The cosine that was to be reached.
        cosine: f64,
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

/// The start that came closest, and why it ended.
fn closest(starts: &[StartReport], cosine: f64) -> String {
    let size = |start: &StartReport| match start.chi_squared {
        chi_squared if chi_squared.is_nan() => f64::INFINITY,
        chi_squared => chi_squared,
    };
    let order =
        |a: &(usize, &StartReport), b: &(usize, &StartReport)| size(a.1).total_cmp(&size(b.1));
    let closest = starts.iter().enumerate().min_by(order);
    closest.map_or_else(String::new, |(number, start)| {
        format!("the closest, start {number}, {}", start.reason(cosine))
    })
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

/// Sizes of numbers whose squares, and the squares of whose rounding errors, neither overflow nor
/// vanish.
pub(crate) const RANGE: [f64; 2] = [1e-100, 1e100];

/// Checks that sizes lie from `least` to `most`.
pub(crate) fn all_within(
    what: &'static str,
    values: impl IntoIterator<Item = f64>,
    [least, most]: [f64; 2],
) -> Result<(), FitError> {
    let mut places = values.into_iter().enumerate();
    let outside = places.find(|(_, v)| !(least..=most).contains(&v.abs()));
    outside.map_or(Ok(()), |(index, value)| {
        Err(FitError::OutOfRange {
            what,
            index,
            value,
            least,
            most,
        })
    })
}

/// Checks that no number is too large for its square, and not all of them too small; all of them
/// may be zero. `names` are those of a number and of the largest one.
pub(crate) fn squares_hold(
    names: [&'static str; 2],
    values: impl IntoIterator<Item = f64> + Clone,
) -> Result<(), FitError> {
    all_within(names[0], values.clone(), [0.0, RANGE[1]])?;
    let order = |a: &(usize, f64), b: &(usize, f64)| a.1.abs().total_cmp(&b.1.abs());
    match values.into_iter().enumerate().max_by(order) {
        Some((index, value)) if value != 0.0 && value.abs() < RANGE[0] => {
            Err(FitError::OutOfRange {
                what: names[1],
                index,
                value,
                least: RANGE[0],
                most: RANGE[1],
            })
        }
        _ => Ok(()),
    }
}

/// Checks that a scaled number kept its digits.
pub(crate) fn not_lost(
    what: &'static str,
    parameter: usize,
    before: f64,
    after: f64,
) -> Result<(), FitError> {
    if after.is_normal() || before == 0.0 && after == 0.0 {
        return Ok(());
    }
    Err(FitError::Lost { what, parameter })
}

/// Checks the number of points against the number of parameters that may vary.
pub(crate) fn enough_points(points: usize, needed: usize) -> Result<(), FitError> {
    if points >= needed {
        return Ok(());
    }
    Err(FitError::TooFewPoints { points, needed })
}

use crate::search_report::StartReport;
use thiserror::Error;

/// Error of a fit.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum FitError {
    /// A list has the wrong length.
    #[error("{what} must have length {expected}, but has {found}")]
    Dimension {
        /// Name of the list.
        what: &'static str,
        /// Required length.
        expected: usize,
        /// Actual length.
        found: usize,
    },
    /// A number is not finite.
    #[error("{what} {index} must be finite, but is {value}")]
    NotFinite {
        /// Name of the list.
        what: &'static str,
        /// Index in the list.
        index: usize,
        /// Value of the number.
        value: f64,
    },
    /// A weight, deviation or option is not positive and finite.
    #[error("{what} {index} must be positive and finite, but is {value}")]
    NotPositive {
        /// Name of the list.
        what: &'static str,
        /// Index in the list.
        index: usize,
        /// Value of the number.
        value: f64,
    },
    /// The square of a number would overflow or underflow.
    #[error(
        "{what} {index} is {value:e}: must lie between {least:e} and {most:e}, so that squares neither \
         overflow nor underflow; choose another unit"
    )]
    OutOfRange {
        /// Name of the list.
        what: &'static str,
        /// Index in the list.
        index: usize,
        /// Value of the number.
        value: f64,
        /// Least magnitude.
        least: f64,
        /// Largest magnitude.
        most: f64,
    },
    /// A parameter or its variance overflows or underflows.
    #[error(
        "the {what} of parameter {parameter} is too large or too small for a floating-point number; \
         choose another unit for the parameter or the data"
    )]
    Lost {
        /// `value` or `variance`.
        what: &'static str,
        /// Index of the parameter.
        parameter: usize,
    },
    /// There are too few points.
    #[error("{needed} points are needed, but there are {points}")]
    TooFewPoints {
        /// Number of points.
        points: usize,
        /// Required number: varying parameters, plus one unless deviations are known.
        needed: usize,
    },
    /// The columns of a design are linearly dependent.
    #[error(
        "the data determine {rank} of {parameters} parameters; not determined: {undetermined:?}"
    )]
    RankDeficient {
        /// Rank of the scaled design.
        rank: usize,
        /// Number of columns.
        parameters: usize,
        /// Parameters that the data do not determine.
        undetermined: Vec<usize>,
    },
    /// A lower bound exceeds the upper one, or a bound is not a number.
    #[error("bounds of parameter {parameter} must be in order, but are {lower} and {upper}")]
    BadBounds {
        /// Index of the parameter.
        parameter: usize,
        /// Lower bound.
        lower: f64,
        /// Upper bound.
        upper: f64,
    },
    /// Random starts need finite bounds.
    #[error(
        "random starts need finite bounds, but the bounds of parameter {parameter} are {lower} and {upper}"
    )]
    Unbounded {
        /// Index of the parameter.
        parameter: usize,
        /// Lower bound.
        lower: f64,
        /// Upper bound.
        upper: f64,
    },
    /// A start lies outside the bounds.
    #[error("start {start} must lie within bounds, but its parameter {parameter} is {value}")]
    StartOutside {
        /// Index of the start.
        start: usize,
        /// Index of the parameter.
        parameter: usize,
        /// Value of the parameter.
        value: f64,
    },
    /// No start was given.
    #[error("a nonlinear fit needs a start, but none was given")]
    NoStart,
    /// The model is not finite at a point.
    #[error("the model is not finite at point {point}: {value}")]
    ModelNotFinite {
        /// Index of the point.
        point: usize,
        /// Value or derivative of the model.
        value: f64,
    },
    /// No search converged.
    #[error("none of {} starts converged; {}", .starts.len(), closest(.starts, *.cosine))]
    NoConvergence {
        /// Reports of all searches.
        starts: Vec<StartReport>,
        /// Convergence tolerance, see [`Options`](crate::Options).
        cosine: f64,
    },
    /// The singular value decomposition failed.
    #[error("the singular value decomposition of the {rows} x {columns} triangle did not converge")]
    NoSingularValues {
        /// Number of rows.
        rows: usize,
        /// Number of columns.
        columns: usize,
    },
}

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

/// Magnitudes whose squares, and the squares of their rounding errors, neither overflow nor
/// underflow.
pub(crate) const RANGE: [f64; 2] = [1e-100, 1e100];

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

/// Checks that no square overflows and that the largest does not underflow. All values may be zero.
/// `names` describe a number and the largest one.
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

pub(crate) fn enough_points(points: usize, needed: usize) -> Result<(), FitError> {
    if points >= needed {
        return Ok(());
    }
    Err(FitError::TooFewPoints { points, needed })
}

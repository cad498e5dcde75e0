//! What a nonlinear fit says of its parameters.

use crate::precision::{Goodness, Precision};
use crate::search_report::StartReport;

/// What is known of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// The data determine it.
    Determined,
    /// The data determine it, but less than its bounds do: its standard error is larger than the
    /// distance of its two finite bounds.
    Weak,
    /// It takes part in a combination of parameters that changes nothing in the data.
    Undetermined,
    /// It sits at its lower bound, and a lower value would be better.
    AtLowerBound,
    /// It sits at its upper bound, and a higher value would be better.
    AtUpperBound,
    /// Its bounds are equal.
    Held,
}

/// A nonlinear fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The parameters.
    pub parameters: Vec<f64>,
    /// What is known of each.
    pub statuses: Vec<Status>,
    /// How well they are known. Parameters at a bound and held ones count as exact.
    pub precision: Precision,
    /// How well the data are met.
    pub goodness: Goodness,
    /// How the search from each start ended.
    pub starts: Vec<StartReport>,
    /// The start that led here.
    pub best: usize,
}

impl Fit {
    /// Number of starts that converged to the same chi squared, within `relative`, as the best.
    pub fn agreeing_starts(&self, relative: f64) -> usize {
        let best = self.starts[self.best].chi_squared;
        self.starts
            .iter()
            .filter(|s| s.ending.is_converged() && s.chi_squared <= best * (1.0 + relative))
            .count()
    }
}

use crate::precision::{Goodness, Precision};
use crate::search_report::StartReport;

/// Status of a fitted parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// Determined by the data.
    Determined,
    /// Weakly determined: the standard error exceeds the distance of the two finite bounds.
    Weak,
    /// Part of a combination of parameters that has no effect on the data.
    Undetermined,
    /// At the lower bound; a lower value would reduce chi squared.
    AtLowerBound,
    /// At the upper bound; a higher value would reduce chi squared.
    AtUpperBound,
    /// Fixed by equal bounds.
    Held,
}

/// Result of a nonlinear fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// Fitted parameters.
    pub parameters: Vec<f64>,
    /// Status of each parameter.
    pub statuses: Vec<Status>,
    /// Covariance, rank and condition number. Fixed parameters and parameters at a bound count as
    /// exact.
    pub precision: Precision,
    /// Residuals and chi squared.
    pub goodness: Goodness,
    /// Reports of the searches from all starts.
    pub starts: Vec<StartReport>,
    /// Index of the start of the best search.
    pub best: usize,
}

impl Fit {
    /// Number of starts that converged to the best chi squared within a relative tolerance.
    pub fn agreeing_starts(&self, relative: f64) -> usize {
        let best = self.starts[self.best].chi_squared;
        self.starts
            .iter()
            .filter(|s| s.ending.is_converged() && s.chi_squared <= best * (1.0 + relative))
            .count()
    }
}

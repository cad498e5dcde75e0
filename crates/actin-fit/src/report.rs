//! What a nonlinear fit says of itself.

use crate::precision::{Goodness, Precision};

/// Why a search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// The model meets the data to rounding.
    Exact,
    /// The residuals are orthogonal to what the free parameters can change, within the tolerance.
    Stationary,
    /// Chi squared changes by no more than its rounding.
    RoundingFloor,
    /// No shorter step lowers chi squared, though the derivatives promise it: they may be wrong, or
    /// the model is not smooth there.
    Stalled,
    /// The iterations were used up.
    Iterations,
    /// The model or its derivatives are not finite at the start, or at a point that was reached.
    NotFinite,
}

impl Ending {
    /// Whether what was found is a minimum within the bounds, as far as the search can tell.
    pub fn is_converged(self) -> bool {
        matches!(self, Self::Exact | Self::Stationary | Self::RoundingFloor)
    }
}

/// How the search from one start ended.
#[derive(Clone, Debug, PartialEq)]
pub struct StartReport {
    /// Where it started.
    pub start: Vec<f64>,
    /// Where it ended.
    pub parameters: Vec<f64>,
    /// Chi squared where it ended.
    pub chi_squared: f64,
    /// Why it ended.
    pub ending: Ending,
    /// Number of linearisations.
    pub iterations: usize,
    /// Number of times that all points were evaluated, derivatives not counted.
    pub evaluations: usize,
}

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

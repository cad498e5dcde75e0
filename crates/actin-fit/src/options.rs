use crate::error::{FitError, all_positive};

/// Options of [`LevenbergMarquardt`](crate::LevenbergMarquardt).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Maximum number of linearisations of a search; default 500.
    pub iterations: usize,
    /// Convergence tolerance; default 1e-10: largest cosine between the residuals and a column of
    /// the Jacobian. The error of the parameters is about this fraction of their standard errors,
    /// times the square root of the degrees of freedom.
    pub cosine: f64,
    /// Largest length of the first step relative to the length of the start, in the scaled norm;
    /// default 1. For a start at zero the distance of the bounds replaces its length.
    pub reach: f64,
    /// Relative tolerance of the rank; default 1e-12. Smaller singular values of the scaled
    /// Jacobian count as zero. So do columns whose effect over the range of the parameter is
    /// smaller than this fraction of the largest effect.
    pub rank_tolerance: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            iterations: 500,
            cosine: 1e-10,
            reach: 1.0,
            rank_tolerance: 1e-12,
        }
    }
}

impl Options {
    pub(crate) fn check(&self) -> Result<(), FitError> {
        let numbers = [self.cosine, self.reach, self.rank_tolerance];
        all_positive("setting cosine, reach, rank_tolerance number", &numbers)
    }
}

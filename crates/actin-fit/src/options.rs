//! What a search may do and when it is done.

use crate::error::{FitError, all_positive};

/// Settings of [`LevenbergMarquardt`](crate::LevenbergMarquardt).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Most linearisations of one search; 500.
    pub iterations: usize,
    /// Largest cosine between the residuals and a column of the derivatives at a minimum; 1e-10.
    /// The parameters are then within about as many standard errors of it, times the root of the
    /// degrees of freedom.
    pub cosine: f64,
    /// Length of the first step over that of the start, at most; 1. Lengths of both are those of
    /// what they change in the model, each parameter by itself. A start at zero is as long as its
    /// bounds are apart.
    pub reach: f64,
    /// Singular values of the scaled derivatives below this part of the largest count as zero;
    /// 1e-12. So do derivatives by a parameter which change the model that much less than others,
    /// over the range of that parameter.
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
    /// # Errors
    /// If one of the numbers is not positive.
    pub(crate) fn check(&self) -> Result<(), FitError> {
        let numbers = [self.cosine, self.reach, self.rank_tolerance];
        all_positive("setting cosine, reach, rank_tolerance number", &numbers)
    }
}

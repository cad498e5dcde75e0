//! Where parameters may be.

use crate::error::{FitError, same_length};

/// A lower and an upper bound for each parameter.
///
/// Infinite bounds leave a side open; equal ones hold a parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Bounds {
    lower: Vec<f64>,
    upper: Vec<f64>,
}

impl Bounds {
    /// Bounds `(lower, upper)` of each parameter.
    ///
    /// # Errors
    /// If a lower bound is above the upper one, if one is not a number, or both are infinite with
    /// the same sign.
    pub fn new(pairs: &[(f64, f64)]) -> Result<Self, FitError> {
        for (parameter, &(lower, upper)) in pairs.iter().enumerate() {
            let has_room = lower < f64::INFINITY && upper > f64::NEG_INFINITY;
            if !(lower <= upper && has_room) {
                return Err(FitError::BadBounds {
                    parameter,
                    lower,
                    upper,
                });
            }
        }
        let (lower, upper) = pairs.iter().copied().unzip();
        Ok(Self { lower, upper })
    }

    /// No bounds on any of `parameters` parameters.
    pub fn none(parameters: usize) -> Self {
        Self {
            lower: vec![f64::NEG_INFINITY; parameters],
            upper: vec![f64::INFINITY; parameters],
        }
    }

    /// Number of parameters.
    pub fn len(&self) -> usize {
        self.lower.len()
    }

    /// Whether there are no parameters.
    pub fn is_empty(&self) -> bool {
        self.lower.is_empty()
    }

    /// Lower bound of a parameter.
    ///
    /// # Panics
    /// If there is no such parameter.
    pub fn lower(&self, parameter: usize) -> f64 {
        self.lower[parameter]
    }

    /// Upper bound of a parameter.
    ///
    /// # Panics
    /// If there is no such parameter.
    pub fn upper(&self, parameter: usize) -> f64 {
        self.upper[parameter]
    }

    /// Distance of the two bounds of a parameter, infinite if one of them is.
    pub(crate) fn width(&self, parameter: usize) -> f64 {
        self.upper[parameter] - self.lower[parameter]
    }

    /// Whether a parameter is held by equal bounds.
    pub(crate) fn holds(&self, parameter: usize) -> bool {
        self.lower[parameter] >= self.upper[parameter]
    }

    /// Number of parameters that are not held.
    pub(crate) fn varying(&self) -> usize {
        (0..self.len()).filter(|&j| !self.holds(j)).count()
    }

    /// Checks that a start has the right length and lies within.
    pub(crate) fn check(&self, start: usize, p: &[f64]) -> Result<(), FitError> {
        same_length("a start", self.len(), p.len())?;
        for (parameter, &value) in p.iter().enumerate() {
            let within = self.lower[parameter] <= value && value <= self.upper[parameter];
            if !(within && value.is_finite()) {
                return Err(FitError::StartOutside {
                    start,
                    parameter,
                    value,
                });
            }
        }
        Ok(())
    }
}

use crate::error::{FitError, same_length};

/// Lower and upper bound of each parameter.
///
/// Bounds may be infinite. Equal bounds fix a parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Bounds {
    lower: Vec<f64>,
    upper: Vec<f64>,
}

impl Bounds {
    /// Creates bounds from pairs `(lower, upper)`.
    ///
    /// # Errors
    /// If a lower bound is above the upper one, a bound is not a number, or both are infinite with
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

    /// Creates infinite bounds for all parameters.
    pub fn none(parameters: usize) -> Self {
        Self {
            lower: vec![f64::NEG_INFINITY; parameters],
            upper: vec![f64::INFINITY; parameters],
        }
    }

    /// Number of parameters.
    pub(crate) fn len(&self) -> usize {
        self.lower.len()
    }

    /// Lower bound of a parameter.
    ///
    /// # Panics
    /// If the index is out of range.
    pub(crate) fn lower(&self, parameter: usize) -> f64 {
        self.lower[parameter]
    }

    /// Upper bound of a parameter.
    ///
    /// # Panics
    /// If the index is out of range.
    pub(crate) fn upper(&self, parameter: usize) -> f64 {
        self.upper[parameter]
    }

    pub(crate) fn width(&self, parameter: usize) -> f64 {
        self.upper[parameter] - self.lower[parameter]
    }

    pub(crate) fn holds(&self, parameter: usize) -> bool {
        self.lower[parameter] >= self.upper[parameter]
    }

    pub(crate) fn varying(&self) -> usize {
        (0..self.len()).filter(|&j| !self.holds(j)).count()
    }

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

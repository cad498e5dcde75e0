//! Values against a variable, with standard errors.

use crate::statistics::{largest, rms};
use actin_fit::{Data, FitError, Observations};

/// Values against a variable: twist (rad/nm, positive in over-twist), curvature (rad/nm) or force
/// (pN).
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Column {
    pub x: Vec<f64>,
    pub value: Vec<f64>,
    /// Standard errors; empty if unknown.
    pub error: Vec<f64>,
}

/// Weights of values without standard errors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Weight {
    Equal,
    /// Inverse squares of the values: residuals are relative.
    Relative,
}

impl FromIterator<(f64, f64)> for Column {
    fn from_iter<I: IntoIterator<Item = (f64, f64)>>(pairs: I) -> Self {
        let mut column = Self::default();
        for (x, value) in pairs {
            column.push(x, value);
        }
        column
    }
}

impl Column {
    pub(super) fn push(&mut self, x: f64, value: f64) {
        self.x.push(x);
        self.value.push(value);
    }

    pub(crate) fn len(&self) -> usize {
        self.value.len()
    }

    pub(super) fn is_empty(&self) -> bool {
        self.value.is_empty()
    }

    /// Largest absolute value of the variable.
    pub(crate) fn range(&self) -> f64 {
        self.x.iter().fold(0.0, |most, x| x.abs().max(most))
    }

    /// Largest absolute value.
    pub(super) fn largest(&self) -> f64 {
        self.value.iter().fold(0.0, |most, v| v.abs().max(most))
    }

    /// The value at the smallest absolute value of the variable.
    pub(super) fn at_rest(&self) -> f64 {
        let least = self.pairs().min_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
        least.map_or(0.0, |(_, value)| value)
    }

    /// The value at the largest `sign * x`.
    pub(super) fn at_end(&self, sign: f64) -> f64 {
        let end = self
            .pairs()
            .max_by(|a, b| (sign * a.0).total_cmp(&(sign * b.0)));
        end.map_or(0.0, |(_, value)| value)
    }

    /// Number of values with `sign * x > 0`.
    pub(super) fn on_side(&self, sign: f64) -> usize {
        self.x.iter().filter(|x| sign * **x > 0.0).count()
    }

    pub(crate) fn pairs(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.x.iter().copied().zip(self.value.iter().copied())
    }

    /// Returns `true` if the standard errors are known.
    pub(crate) fn is_known(&self) -> bool {
        !self.error.is_empty()
    }

    /// Differences, or relative differences, between `law` and the values.
    fn errors<'a>(
        &'a self,
        law: impl Fn(f64) -> f64 + 'a,
        relative: bool,
    ) -> impl Iterator<Item = f64> + 'a {
        self.pairs().map(move |(x, value)| {
            let scale = if relative { value } else { 1.0 };
            (law(x) - value) / scale
        })
    }

    /// Root mean square of the differences from `law`.
    pub(crate) fn rms(&self, law: impl Fn(f64) -> f64, relative: bool) -> f64 {
        rms(self.errors(law, relative))
    }

    /// Largest difference from `law`.
    pub(super) fn largest_error(&self, law: impl Fn(f64) -> f64, relative: bool) -> f64 {
        largest(self.errors(law, relative).map(f64::abs))
    }

    /// Converts the column to data for a fit, weighted by its standard errors if known.
    pub(super) fn observed(&self, weight: Weight) -> Result<Data, FitError> {
        let observations = Observations::new(&self.value)?;
        let observations = if self.is_known() {
            observations.with_deviations(&self.error)?
        } else if weight == Weight::Relative {
            let weights: Vec<f64> = self.value.iter().map(|v| v.powi(-2)).collect();
            observations.with_weights(&weights)?
        } else {
            observations
        };
        Data::new(&self.x, observations)
    }
}

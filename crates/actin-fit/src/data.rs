//! Places where something was measured, with what was measured there.

use crate::error::{FitError, all_finite, same_length};
use crate::observations::Observations;

/// Points of a fit: rows of independent variables and their observations.
///
/// A row may hold anything that a model needs to know of a point: one coordinate, several, or the
/// number of the point as a key into data that the model owns.
#[derive(Clone, Debug, PartialEq)]
pub struct Data {
    width: usize,
    rows: Vec<f64>,
    observations: Observations,
}

impl Data {
    /// Points with one independent variable each.
    ///
    /// # Errors
    /// If there are not as many places as observations, or one is not finite.
    pub fn new(x: &[f64], observations: Observations) -> Result<Self, FitError> {
        Self::from_rows(1, x, observations)
    }

    /// Points with `width` independent variables each, row after row in `rows`.
    ///
    /// # Errors
    /// If `rows` does not hold `width` numbers for each observation, or one is not finite.
    pub fn from_rows(
        width: usize,
        rows: &[f64],
        observations: Observations,
    ) -> Result<Self, FitError> {
        same_length("x", width * observations.len(), rows.len())?;
        all_finite("x", rows)?;
        Ok(Self {
            width,
            rows: rows.to_vec(),
            observations,
        })
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.observations.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.observations.is_empty()
    }

    /// Independent variables of a point.
    ///
    /// # Panics
    /// If there is no such point.
    pub fn row(&self, point: usize) -> &[f64] {
        &self.rows[point * self.width..(point + 1) * self.width]
    }

    /// All rows, one after the other.
    pub fn rows(&self) -> &[f64] {
        &self.rows
    }

    /// Number of independent variables of a point.
    pub fn width(&self) -> usize {
        self.width
    }

    /// What was measured.
    pub fn observations(&self) -> &Observations {
        &self.observations
    }
}

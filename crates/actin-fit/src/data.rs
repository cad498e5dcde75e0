use crate::error::{FitError, all_finite, same_length};
use crate::observations::Observations;

/// Points of a fit: rows of independent variables with their observations.
///
/// A row can hold several coordinates, or an index into data of the model.
#[derive(Clone, Debug, PartialEq)]
pub struct Data {
    width: usize,
    rows: Vec<f64>,
    observations: Observations,
}

impl Data {
    /// Creates points with one independent variable each.
    ///
    /// # Errors
    /// If the numbers of values and observations differ, or a value is not finite.
    pub fn new(x: &[f64], observations: Observations) -> Result<Self, FitError> {
        Self::from_rows(1, x, observations)
    }

    /// Creates points with `width` independent variables each, stored row by row.
    ///
    /// # Errors
    /// If `rows` does not hold `width` numbers per observation, or a number is not finite.
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

    /// Returns `true` if the data contain no points.
    pub fn is_empty(&self) -> bool {
        self.observations.is_empty()
    }

    /// Independent variables of a point.
    ///
    /// # Panics
    /// If the index is out of range.
    pub fn row(&self, point: usize) -> &[f64] {
        &self.rows[point * self.width..(point + 1) * self.width]
    }

    /// Rows of all points, concatenated.
    pub(crate) fn rows(&self) -> &[f64] {
        &self.rows
    }

    /// Number of independent variables per point.
    pub(crate) fn width(&self) -> usize {
        self.width
    }

    /// Observations of the points.
    pub fn observations(&self) -> &Observations {
        &self.observations
    }
}

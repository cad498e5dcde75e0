//! Measured values, and what is known of their noise.

use crate::error::{
    FitError, RANGE, all_finite, all_positive, all_within, same_length, squares_hold,
};

/// What is known of the noise of observations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Noise {
    /// The same for all, its size unknown: it is estimated from the residuals.
    Unknown,
    /// Known up to one factor, which is estimated from the residuals.
    Relative,
    /// Standard deviations are known; residuals do not change the stated uncertainty.
    Known,
}

/// Measured values with their noise.
///
/// ```
/// use actin_fit::{Noise, Observations};
///
/// let observations = Observations::new(&[1.0, 2.0])?.with_weights(&[1.0, 4.0])?;
/// assert_eq!(observations.noise(), Noise::Relative);
/// // A weight is one over a variance.
/// assert_eq!(observations.deviations(), [1.0, 0.5]);
/// # Ok::<(), actin_fit::FitError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Observations {
    values: Vec<f64>,
    deviations: Vec<f64>,
    noise: Noise,
}

impl Observations {
    /// Values of equal but unknown accuracy.
    ///
    /// # Errors
    /// If a value is not finite or larger than 1e100, or the largest is below 1e-100 and not zero:
    /// sums of squares would overflow or vanish.
    pub fn new(values: &[f64]) -> Result<Self, FitError> {
        all_finite("observation", values)?;
        let names = ["observation", "the largest observation, number"];
        squares_hold(names, values.iter().copied())?;
        Ok(Self {
            values: values.to_vec(),
            deviations: vec![1.0; values.len()],
            noise: Noise::Unknown,
        })
    }

    /// The same values with weights, proportional to one over their variances.
    ///
    /// # Errors
    /// If the number of weights is not that of values, or one is not positive or not from 1e-200 to
    /// 1e200; if values times roots of weights are not as the values of [`new`](Self::new).
    pub fn with_weights(self, weights: &[f64]) -> Result<Self, FitError> {
        same_length("weights", self.values.len(), weights.len())?;
        all_positive("weight", weights)?;
        let squared = RANGE.map(|size| size * size);
        all_within("weight", weights.iter().copied(), squared)?;
        let deviations = weights.iter().map(|w| 1.0 / w.sqrt()).collect();
        self.scaled(deviations, Noise::Relative)
    }

    /// The same values with known standard deviations.
    ///
    /// # Errors
    /// If the number of deviations is not that of values, or one is not positive or not from 1e-100
    /// to 1e100; if values over deviations are not as the values of [`new`](Self::new).
    pub fn with_deviations(self, deviations: &[f64]) -> Result<Self, FitError> {
        same_length("deviations", self.values.len(), deviations.len())?;
        all_positive("deviation", deviations)?;
        all_within("deviation", deviations.iter().copied(), RANGE)?;
        self.scaled(deviations.to_vec(), Noise::Known)
    }

    fn scaled(self, deviations: Vec<f64>, noise: Noise) -> Result<Self, FitError> {
        let names = [
            "over its deviation observation",
            "over its deviation the largest observation, number",
        ];
        let ratios = self.values.iter().zip(&deviations).map(|(y, s)| y / s);
        squares_hold(names, ratios)?;
        Ok(Self {
            deviations,
            noise,
            ..self
        })
    }

    /// Number of values.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// The values.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Standard deviations; 1 where the noise is unknown, up to one factor where it is relative.
    pub fn deviations(&self) -> &[f64] {
        &self.deviations
    }

    /// What is known of the noise.
    pub fn noise(&self) -> Noise {
        self.noise
    }

    /// Fewest points for this many parameters: one more than parameters where the residuals must
    /// also tell the noise.
    pub(crate) fn needed(&self, parameters: usize) -> usize {
        parameters + usize::from(self.noise != Noise::Known)
    }
}

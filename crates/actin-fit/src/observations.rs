use crate::error::{
    FitError, RANGE, all_finite, all_positive, all_within, same_length, squares_hold,
};

/// Knowledge of the noise of observations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Noise {
    /// Equal but unknown deviations, estimated from the residuals.
    Unknown,
    /// Deviations known up to a common factor, which is estimated from the residuals.
    Relative,
    /// Known standard deviations.
    Known,
}

/// Observed values and their noise.
///
/// ```
/// use actin_fit::{Noise, Observations};
///
/// let observations = Observations::new(&[1.0, 2.0])?.with_weights(&[1.0, 4.0])?;
/// assert_eq!(observations.noise(), Noise::Relative);
/// // A weight is an inverse variance.
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
    /// Creates observations with equal, unknown deviations.
    ///
    /// # Errors
    /// If a value is not finite or exceeds 1e100, or if the largest is below 1e-100 and not zero.
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

    /// Sets weights, proportional to the inverse variances.
    ///
    /// # Errors
    /// If the number of weights is wrong, or a weight is not between 1e-200 and 1e200. Also if the
    /// ratios of value to deviation violate the limits of [`new`](Self::new).
    pub fn with_weights(self, weights: &[f64]) -> Result<Self, FitError> {
        same_length("weights", self.values.len(), weights.len())?;
        all_positive("weight", weights)?;
        let squared = RANGE.map(|size| size * size);
        all_within("weight", weights.iter().copied(), squared)?;
        let deviations = weights.iter().map(|w| 1.0 / w.sqrt()).collect();
        self.scaled(deviations, Noise::Relative)
    }

    /// Sets known standard deviations.
    ///
    /// # Errors
    /// If the number of deviations is wrong, or a deviation is not between 1e-100 and 1e100. Also
    /// if the ratios of value to deviation violate the limits of [`new`](Self::new).
    pub fn with_deviations(self, deviations: &[f64]) -> Result<Self, FitError> {
        same_length("deviations", self.values.len(), deviations.len())?;
        all_positive("deviation", deviations)?;
        all_within("deviation", deviations.iter().copied(), RANGE)?;
        self.scaled(deviations.to_vec(), Noise::Known)
    }

    fn scaled(self, deviations: Vec<f64>, noise: Noise) -> Result<Self, FitError> {
        let names = [
            "ratio of observation to deviation at point",
            "the largest ratio of observation to deviation, at point",
        ];
        let ratios = self.values.iter().zip(&deviations).map(|(y, s)| y / s);
        squares_hold(names, ratios)?;
        Ok(Self {
            deviations,
            noise,
            ..self
        })
    }

    /// Number of observations.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// Returns `true` if there are zero observations.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// Observed values.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Standard deviations: 1 for unknown noise, known up to a common factor for relative noise.
    pub fn deviations(&self) -> &[f64] {
        &self.deviations
    }

    /// Knowledge of the noise.
    pub fn noise(&self) -> Noise {
        self.noise
    }

    pub(crate) fn needed(&self, parameters: usize) -> usize {
        parameters + usize::from(self.noise != Noise::Known)
    }
}

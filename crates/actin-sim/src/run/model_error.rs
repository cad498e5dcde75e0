//! Error of one quantity of an equilibrium against a run of the same scene with every monomer.

use crate::scene::{Quantity, SceneProblem};
use crate::{Assembly, Record};
use serde::{Deserialize, Serialize};

/// Model error and scatter of a quantity, or the reason for their absence.
pub(crate) type ModelErrorResult = Result<(ModelError, Scatter), SceneProblem>;

/// Measurement of the model error of a quantity in the last record of an equilibrium.
pub(crate) type MeasureModelError = fn(&Assembly, &Record, Quantity) -> ModelErrorResult;

/// Error of a quantity of an equilibrium against every monomer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModelError {
    /// Quantity with this error.
    pub quantity: Quantity,
    /// Value in the [unit](Quantity::unit) of the quantity; the size of a vector.
    pub value: f64,
    /// Correction in the same unit: the value with every monomer minus `value`.
    pub error: f64,
    /// Size of the difference divided by the size with every monomer. The difference of vectors includes their direction.
    pub relative: f64,
}

impl ModelError {
    pub(crate) fn note(&self, scatter: &Scatter) -> String {
        let size = self.corrected().abs().max(f64::MIN_POSITIVE);
        format!(
            "{} is {}, and {} in the all-monomer model (error {:.2} %); filaments with {} sampled bonds per interface differ \
             from the all-monomer model by {:+.2} % on average, with a root mean square difference of {:.2} %",
            self.quantity,
            self.quantity.show(self.value),
            self.quantity.show(self.corrected()),
            100.0 * self.relative,
            scatter.bonds,
            100.0 * scatter.shift / size,
            100.0 * scatter.deviation / size
        )
    }

    /// Returns the value with every monomer.
    fn corrected(&self) -> f64 {
        self.value + self.error
    }
}

/// Scatter of a quantity between filaments with sampled bonds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scatter {
    /// Sampled bonds per interface.
    pub bonds: usize,
    /// Number of filaments.
    pub filaments: u64,
    /// Mean over the filaments minus the value with quadrature bonds, in the unit of the quantity.
    pub shift: f64,
    /// Root mean square difference from the value with quadrature bonds, in the same unit. The difference of vectors
    /// includes their direction.
    pub deviation: f64,
}

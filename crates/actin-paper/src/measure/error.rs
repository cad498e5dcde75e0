//! Why nothing was measured.

use actin_equilibrium::OptionsError;
use actin_sim::SceneProblem;
use thiserror::Error;

/// Why a protocol could not begin. A curve that ends early is no error: it says what is missing.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum MeasureError {
    /// The filament, or what is asked of it, breaks a rule.
    #[error(transparent)]
    Refused(#[from] SceneProblem),
    /// A value at which nothing can be measured.
    #[error("{name} = {value}: must be {rule}")]
    Value {
        /// What it stands for.
        name: &'static str,
        /// What it was.
        value: f64,
        /// What it must be.
        rule: &'static str,
    },
    /// The solver refused its settings.
    #[error(transparent)]
    Options(#[from] OptionsError),
}

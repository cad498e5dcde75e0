//! Errors of measuring protocols.

use actin_equilibrium::OptionsError;
use actin_sim::SceneProblem;
use thiserror::Error;

/// Reason why a protocol could not begin. A path that ends early is not an error; see
/// [`super::Curve`].
#[derive(Clone, Debug, PartialEq, Error)]
pub enum MeasureError {
    /// Invalid filament or protocol.
    #[error(transparent)]
    Refused(#[from] SceneProblem),
    /// Prescribed value for which a measurement is undefined.
    #[error("{name} = {value}: must be {rule}")]
    Value {
        /// Name of the value.
        name: &'static str,
        /// The value.
        value: f64,
        /// Valid values.
        rule: &'static str,
    },
    /// Invalid settings of the solver.
    #[error(transparent)]
    Options(#[from] OptionsError),
}

use crate::{
    BathError, CompositionError, DragError, FrequencyError, RunFailure, RunSettingError, StepError,
    StopRuleError, UnknownScheme,
};
use thiserror::Error;

/// Any error of this crate.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum IntegrationError {
    /// Invalid table of coefficients.
    #[error(transparent)]
    Composition(#[from] CompositionError),
    /// Unknown method.
    #[error(transparent)]
    Scheme(#[from] UnknownScheme),
    /// Invalid drag.
    #[error(transparent)]
    Drag(#[from] DragError),
    /// Invalid heat bath.
    #[error(transparent)]
    Bath(#[from] BathError),
    /// Invalid stop rule.
    #[error(transparent)]
    StopRule(#[from] StopRuleError),
    /// The largest frequency could not be determined.
    #[error(transparent)]
    Frequency(#[from] FrequencyError),
    /// The time step could not be determined.
    #[error(transparent)]
    Step(#[from] StepError),
    /// Invalid setting of a run.
    #[error(transparent)]
    Run(#[from] RunSettingError),
    /// Failure of a run.
    #[error(transparent)]
    Failure(#[from] RunFailure),
}

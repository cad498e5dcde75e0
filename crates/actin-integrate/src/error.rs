//! The error of all of this crate's tasks.

use crate::{
    BathError, CompositionError, DragError, FrequencyError, RunFailure, RunSettingError, StepError,
    StopRuleError, UnknownScheme,
};
use thiserror::Error;

/// Why a motion could not be set up or broke: what any function of this crate may return, for use
/// with `?`.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum IntegrationError {
    /// A table of coefficients was refused.
    #[error(transparent)]
    Composition(#[from] CompositionError),
    /// There is no method of that name.
    #[error(transparent)]
    Scheme(#[from] UnknownScheme),
    /// A drag was refused.
    #[error(transparent)]
    Drag(#[from] DragError),
    /// A heat bath was refused.
    #[error(transparent)]
    Bath(#[from] BathError),
    /// A stop rule was refused.
    #[error(transparent)]
    StopRule(#[from] StopRuleError),
    /// The largest frequency was not found.
    #[error(transparent)]
    Frequency(#[from] FrequencyError),
    /// There is no stable time step.
    #[error(transparent)]
    Step(#[from] StepError),
    /// A setting of a run was refused.
    #[error(transparent)]
    Run(#[from] RunSettingError),
    /// A run broke.
    #[error(transparent)]
    Failure(#[from] RunFailure),
}

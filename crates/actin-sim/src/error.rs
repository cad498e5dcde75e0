//! Common error type of scenes and runs.

use crate::{EnsembleError, RunError, SceneError, SceneProblem};
use thiserror::Error;

/// Error of reading, building or running a scene, for use with `?`.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SimError {
    /// The text of a scene is invalid.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A scene cannot be built.
    #[error(transparent)]
    SceneProblem(#[from] SceneProblem),
    /// A run failed.
    #[error(transparent)]
    Run(#[from] RunError),
    /// An ensemble was refused, or a replica failed.
    #[error(transparent)]
    Ensemble(#[from] EnsembleError),
}

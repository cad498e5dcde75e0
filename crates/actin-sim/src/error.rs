//! Common error type of scenes and runs.

use crate::{
    CheckpointError, EnsembleError, RunDirectoryError, RunError, SceneError, SceneProblem,
};
use thiserror::Error;

/// Error of reading, building, running or writing a scene, for use with `?`.
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
    /// A run directory was refused, or cannot be written or read.
    #[error(transparent)]
    Directory(#[from] RunDirectoryError),
    /// A checkpoint cannot be written or read.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
}

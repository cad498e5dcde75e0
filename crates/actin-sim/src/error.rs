//! The error of all that a scene goes through.

use crate::{
    CheckpointError, EnsembleError, RunDirectoryError, RunError, SceneError, SceneProblem,
};
use thiserror::Error;

/// Why a scene could not be read, built, run or written: what any of these steps may return, for
/// use with `?`.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SimError {
    /// The text of a scene was refused.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A scene cannot be built.
    #[error(transparent)]
    SceneProblem(#[from] SceneProblem),
    /// A run broke.
    #[error(transparent)]
    Run(#[from] RunError),
    /// An ensemble was refused, or one of its replicas broke.
    #[error(transparent)]
    Ensemble(#[from] EnsembleError),
    /// A run directory was refused, or cannot be written or read.
    #[error(transparent)]
    Directory(#[from] RunDirectoryError),
    /// A checkpoint cannot be written or read.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
}

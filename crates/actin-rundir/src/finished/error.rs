//! Errors of reading finished runs.

use crate::RunDirectoryError;
use crate::names::{SCENE, STATES};
use actin_sim::{SceneError, SceneProblem};
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Error of reading a finished run.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FinishedRunError {
    /// The directory has no scene.
    #[error("{} is not a run directory: it has no {SCENE}", .path.display())]
    NotARun {
        /// The directory.
        path: PathBuf,
    },
    /// The directory has no states.
    #[error(
        "{} has no {STATES}: its run has not ended, or its scene has `output: (states: false)`",
        .path.display()
    )]
    NoStates {
        /// The directory.
        path: PathBuf,
    },
    /// The scene is invalid.
    #[error("{}:{error}", .path.display())]
    Scene {
        /// The file.
        path: PathBuf,
        /// Error of the scene.
        error: SceneError,
    },
    /// The scene cannot be built.
    #[error("{}: {problem}", .path.display())]
    Problem {
        /// The file.
        path: PathBuf,
        /// Reason.
        problem: SceneProblem,
    },
    /// The states cannot be read.
    #[error(transparent)]
    States(#[from] RunDirectoryError),
    /// The file system refused.
    #[error("{}: {source}", .path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// Error of the file system.
        source: io::Error,
    },
}

impl FinishedRunError {
    pub(super) fn io(path: &Path) -> impl FnOnce(io::Error) -> Self {
        move |source| Self::Io {
            path: path.to_owned(),
            source,
        }
    }
}

//! Why the states of a run cannot be read.

use super::super::RunDirectoryError;
use super::super::names::{SCENE, STATES};
use crate::{SceneError, SceneProblem};
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Why the states of a run cannot be read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FinishedRunError {
    /// There is no scene.
    #[error("{} is not a run directory: it has no {SCENE}", .path.display())]
    NotARun {
        /// The directory.
        path: PathBuf,
    },
    /// There are no states.
    #[error(
        "{} has no {STATES}: its run has not ended, or its scene has `output: (states: false)`",
        .path.display()
    )]
    NoStates {
        /// The directory.
        path: PathBuf,
    },
    /// The scene is refused.
    #[error("{}:{error}", .path.display())]
    Scene {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        error: SceneError,
    },
    /// The scene cannot be built.
    #[error("{}: {problem}", .path.display())]
    Problem {
        /// The file.
        path: PathBuf,
        /// Why not.
        problem: SceneProblem,
    },
    /// States that cannot be read.
    #[error(transparent)]
    States(#[from] RunDirectoryError),
    /// The file system refused.
    #[error("{}: {source}", .path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the file system says.
        source: io::Error,
    },
}

impl FinishedRunError {
    /// The error of an operation on `path`.
    pub(super) fn io(path: &Path) -> impl FnOnce(io::Error) -> Self {
        move |source| Self::Io {
            path: path.to_owned(),
            source,
        }
    }
}

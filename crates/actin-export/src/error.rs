//! Why a run cannot be exported.

use actin_sim::{FinishedRunError, RunDirectoryError};
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Why a run cannot be exported.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ExportError {
    /// The run cannot be read.
    #[error(transparent)]
    Run(#[from] FinishedRunError),
    /// Its states cannot be read.
    #[error(transparent)]
    States(#[from] RunDirectoryError),
    /// There is a file of that name.
    #[error(
        "{} exists: files are never overwritten unless that is asked for; name another, or ask to overwrite",
        .path.display()
    )]
    Exists {
        /// The file.
        path: PathBuf,
    },
    /// The place of the file is a directory.
    #[error("{} is a directory: name a file", .path.display())]
    IsDirectory {
        /// The directory.
        path: PathBuf,
    },
    /// What is written to refuses.
    #[error(transparent)]
    Output(#[from] io::Error),
    /// The file system refused.
    #[error("{}: {source}", .path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the file system says.
        source: io::Error,
    },
}

impl ExportError {
    /// The error of an operation on `path`.
    pub(crate) fn io(path: &Path) -> impl FnOnce(io::Error) -> Self {
        move |source| Self::Io {
            path: path.to_owned(),
            source,
        }
    }
}

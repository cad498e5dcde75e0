//! Errors of exports.

use actin_rundir::{FinishedRunError, RunDirectoryError};
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Error of an export.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ExportError {
    /// The run cannot be read.
    #[error(transparent)]
    Run(#[from] FinishedRunError),
    /// The states of the run cannot be read.
    #[error(transparent)]
    States(#[from] RunDirectoryError),
    /// The output file exists.
    #[error(
        "{} exists: name another file, or allow overwriting",
        .path.display()
    )]
    Exists {
        /// The file.
        path: PathBuf,
    },
    /// The output path is a directory.
    #[error("{} is a directory: name a file", .path.display())]
    IsDirectory {
        /// The directory.
        path: PathBuf,
    },
    /// The writer returned an error.
    #[error(transparent)]
    Output(#[from] io::Error),
    /// A file system operation failed.
    #[error("{}: {source}", .path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// Error of the file system.
        source: io::Error,
    },
}

impl ExportError {
    pub(crate) fn io(path: &Path) -> impl FnOnce(io::Error) -> Self {
        move |source| Self::Io {
            path: path.to_owned(),
            source,
        }
    }
}

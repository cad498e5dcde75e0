//! Errors of run directories.

use crate::CheckpointError;
use crate::names::{MANIFEST, SCENE, STATES};
use actin_sim::{RecordsError, SceneError, SceneProblem, Summary};
use std::fmt::Display;
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Error of reading or writing a run directory.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RunDirectoryError {
    /// The directory is not empty.
    #[error(
        "{} exists and is not empty: results are never overwritten without request; \
         name another directory, or overwrite them (--overwrite; in Python overwrite=True)", .0.display()
    )]
    NotEmpty(PathBuf),
    /// A directory to be overwritten has no manifest.
    #[error(
        "{} is not empty and has no {MANIFEST}, the list of the files that a run has written: nothing in it \
         is removed; name another directory, or remove this one if it is to go", .0.display()
    )]
    NoManifest(PathBuf),
    /// A file, folder or link that the run has not written has the name of a result.
    #[error(
        "{} was not written by the run whose files {MANIFEST} lists: it is left alone; move it, or name \
         another directory", .0.display()
    )]
    NotOfARun(PathBuf),
    /// A text of an earlier run was changed after that run wrote it.
    #[error(
        "{} has been changed since the run wrote it: it is left alone; move it, or name another directory",
        .0.display()
    )]
    Changed(PathBuf),
    /// The manifest is invalid or has another version.
    #[error(
        "{} is not the list of a run's files that it should be: {reason}; nothing is removed; name another \
         directory, or remove this one if it is to go", .0.display(), reason = .1
    )]
    Manifest(PathBuf, String),
    /// The directory to be overwritten is a link.
    #[error(
        "{} is a link to {target}: nothing is removed through a link; name {target} itself", .path.display(),
        target = .target.display()
    )]
    Link {
        /// The link.
        path: PathBuf,
        /// Target of the link.
        target: PathBuf,
    },
    /// The path is not a directory.
    #[error("{} is not a directory: a run writes several files into one directory", .0.display())]
    NotADirectory(PathBuf),
    /// Another run is using the directory.
    #[error(
        "{} is in use: another run{} is writing into it; wait for its end, or name another \
         directory", .path.display(), by(*.process)
    )]
    InUse {
        /// The directory.
        path: PathBuf,
        /// Process number of that run, if available.
        process: Option<u32>,
    },
    /// The file in place of the lock was not written by a run.
    #[error(
        "{} has the name of the lock but was not written by a run: move it, or name another \
         directory", .0.display()
    )]
    ForeignLock(PathBuf),
    /// The file system refused.
    #[error("{}: {source}", .path.display())]
    Io {
        /// The file or directory.
        path: PathBuf,
        /// Error of the file system.
        source: io::Error,
    },
    /// The records cannot be read back, or do not belong to the assembly.
    #[error(transparent)]
    Records(#[from] RecordsError),
    /// The checkpoint cannot be read, or belongs to another run.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
    /// A file of results is damaged.
    #[error("{} is damaged: {reason}", .0.display(), reason = .1)]
    Damaged(PathBuf, String),
    /// The directory was written by a newer program.
    #[error(
        "{} has the format version {found}: this program reads versions up to {}, use a newer one",
        .path.display(), Summary::FORMAT
    )]
    NewerFormat {
        /// The summary of the run.
        path: PathBuf,
        /// Version of the format.
        found: u32,
    },
    /// Results do not belong to the scene in the directory.
    #[error("{} does not belong to the scene: {reason}", .0.display(), reason = .1)]
    OtherBodies(PathBuf, String),
    /// The directory has no scene.
    #[error("{} is not a run directory: it has no {SCENE}", .0.display())]
    NotARun(PathBuf),
    /// The directory has no states.
    #[error(
        "{} has no {STATES}: its run has not ended, or its scene has `output: (states: false)`",
        .0.display()
    )]
    NoStates(PathBuf),
    /// The scene in the directory is invalid.
    #[error(transparent)]
    Scene(SceneError),
    /// The scene in the directory cannot be built.
    #[error("{}: {reason}", .0.display(), reason = .1)]
    Problem(PathBuf, SceneProblem),
    /// The file of an export exists.
    #[error("{} exists: name another file, or allow overwriting", .0.display())]
    Exists(PathBuf),
    /// The file of an export is a directory.
    #[error("{} is a directory: name a file", .0.display())]
    IsDirectory(PathBuf),
    /// The file of an export cannot be written.
    #[error("{}: {source}", .path.display())]
    Export {
        /// The file.
        path: PathBuf,
        /// Error of the file system.
        source: io::Error,
    },
    /// A value is not finite.
    #[error("{file}: {quantity}{} is {value}: only finite numbers are written", place(.index))]
    NotFinite {
        /// File to be written.
        file: String,
        /// Name of the quantity in that file.
        quantity: String,
        /// Index in the array of the quantity; empty for a scalar.
        index: Vec<usize>,
        /// The value.
        value: f64,
    },
}

impl RunDirectoryError {
    /// Adds a path to an error of the file system. Other errors inside of `io::Error` are returned
    /// unchanged.
    pub(crate) fn io(path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_owned();
        move |error| match error.downcast() {
            Ok(error) => error,
            Err(source) => Self::Io { path, source },
        }
    }

    /// Error of a damaged file of results.
    pub(crate) fn damaged(path: &Path, reason: &dyn Display) -> Self {
        Self::Damaged(path.to_owned(), reason.to_string())
    }

    /// Refuses a value that is not finite, for writing as `quantity` of `file`.
    pub(crate) fn ensure_finite(
        file: &str,
        quantity: &str,
        index: &[usize],
        value: f64,
    ) -> io::Result<()> {
        if value.is_finite() {
            return Ok(());
        }
        Err(io::Error::other(Self::NotFinite {
            file: file.to_owned(),
            quantity: quantity.to_owned(),
            index: index.to_owned(),
            value,
        }))
    }
}

fn by(process: Option<u32>) -> String {
    process.map_or_else(String::new, |id| format!(" (process {id})"))
}

fn place(index: &[usize]) -> String {
    if index.is_empty() {
        String::new()
    } else {
        format!("{index:?}")
    }
}

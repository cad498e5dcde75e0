//! Errors of sweeps. A failed run is a row of the table, not an error.

use actin_rundir::RunDirectoryError;
use actin_sim::SceneError;
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Error of a sweep.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SweepError {
    /// Mistakes in the sweep or its scene.
    #[error("{}", lines(.file, .mistakes))]
    Refused {
        /// The file.
        file: PathBuf,
        /// Contents of the file; empty if it is not text.
        text: String,
        /// All mistakes, at least one, in the order of the text.
        mistakes: Vec<SceneError>,
    },
    /// The directory is not empty and is not the directory of a sweep.
    #[error(
        "{} is not empty and holds no sweep: name another directory, or remove this one",
        .path.display()
    )]
    NotASweep {
        /// The directory.
        path: PathBuf,
    },
    /// The directory contains this sweep, and `resume` is false.
    #[error("{} holds a sweep already: --resume continues it; otherwise name another directory", .path.display())]
    NotEmpty {
        /// The directory.
        path: PathBuf,
    },
    /// The directory contains another sweep, or a sweep of another program version.
    #[error(
        "{} holds another sweep: line {line} of {file} is {kept:?} there and {given:?} now; name another \
         directory", .path.display()
    )]
    Other {
        /// The directory.
        path: PathBuf,
        /// The file that differs.
        file: &'static str,
        /// First differing line, from 1.
        line: usize,
        /// That line in the directory.
        kept: String,
        /// That line of the given sweep.
        given: String,
    },
    /// A run index is out of range.
    #[error("there is no run {run}: the sweep has {runs}, counted from 0")]
    NoRun {
        /// Index of the run.
        run: usize,
        /// Number of runs.
        runs: usize,
    },
    /// A file system operation failed.
    #[error("{}: {source}", .path.display())]
    Io {
        /// The file or directory.
        path: PathBuf,
        /// Error of the file system.
        source: io::Error,
    },
    /// The directory of a run is not usable, or its results could not be written.
    #[error(transparent)]
    Run(#[from] RunDirectoryError),
}

fn lines(file: &Path, mistakes: &[SceneError]) -> String {
    let lines = mistakes.iter();
    let lines = lines.map(|mistake| format!("{}:{mistake}", file.display()));
    lines.collect::<Vec<_>>().join("\n")
}

impl SweepError {
    pub(crate) fn refused(file: &Path, text: &str, mut mistakes: Vec<SceneError>) -> Self {
        mistakes.sort_by_key(|mistake| (mistake.line, mistake.column));
        mistakes.dedup();
        Self::Refused {
            file: file.to_owned(),
            text: text.to_owned(),
            mistakes,
        }
    }

    pub(crate) fn io(path: &Path) -> impl FnOnce(io::Error) -> Self {
        move |source| Self::Io {
            path: path.to_owned(),
            source,
        }
    }
}

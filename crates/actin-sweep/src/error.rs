//! Why a sweep cannot go on. A run that fails is no error: it is a row of the table.

use actin_sim::{CheckpointError, RunDirectoryError, SceneError};
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Why a sweep was refused, or ended before all runs were made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SweepError {
    /// The sweep or its scene was refused, with every mistake, a line each.
    #[error("{}", lines(.file, .mistakes))]
    Refused {
        /// The file.
        file: PathBuf,
        /// What it holds; empty where that is no text.
        text: String,
        /// What is wrong, where, in the order of the text; at least one mistake.
        mistakes: Vec<SceneError>,
    },
    /// The directory holds something else.
    #[error(
        "{} is not empty and holds no sweep: name another directory, or remove this one if it is to go",
        .path.display()
    )]
    NotASweep {
        /// The directory.
        path: PathBuf,
    },
    /// The directory holds a sweep.
    #[error("{} holds a sweep already: --resume continues it; otherwise name another directory", .path.display())]
    NotEmpty {
        /// The directory.
        path: PathBuf,
    },
    /// The directory holds another sweep, or that of another version of the program.
    #[error(
        "{} holds another sweep: line {line} of {file} is {kept:?} there and {given:?} now; name another \
         directory", .path.display()
    )]
    Other {
        /// The directory.
        path: PathBuf,
        /// The file that differs.
        file: &'static str,
        /// The first line that does, from 1.
        line: usize,
        /// That line as it was.
        kept: String,
        /// The same now.
        given: String,
    },
    /// A run that does not exist.
    #[error("there is no run {run}: the sweep has {runs}, counted from 0")]
    NoRun {
        /// Its number.
        run: usize,
        /// How many there are.
        runs: usize,
    },
    /// The file system refused.
    #[error("{}: {source}", .path.display())]
    Io {
        /// The file or directory.
        path: PathBuf,
        /// What the file system says.
        source: io::Error,
    },
    /// The directory of a run was refused, or its results could not be written.
    #[error(transparent)]
    Run(#[from] RunDirectoryError),
    /// What is kept of a run belongs to another scene.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
}

fn lines(file: &Path, mistakes: &[SceneError]) -> String {
    let lines = mistakes.iter();
    let lines = lines.map(|mistake| format!("{}:{mistake}", file.display()));
    lines.collect::<Vec<_>>().join("\n")
}

impl SweepError {
    /// A file with mistakes, in any order.
    pub(crate) fn refused(file: &Path, text: &str, mut mistakes: Vec<SceneError>) -> Self {
        mistakes.sort_by_key(|mistake| (mistake.line, mistake.column));
        mistakes.dedup();
        Self::Refused {
            file: file.to_owned(),
            text: text.to_owned(),
            mistakes,
        }
    }

    /// The error of an operation on `path`.
    pub(crate) fn io(path: &Path) -> impl FnOnce(io::Error) -> Self {
        move |source| Self::Io {
            path: path.to_owned(),
            source,
        }
    }
}

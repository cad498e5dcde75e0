//! Why a run directory was refused or could not be written.

use super::names::MANIFEST;
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Why a run directory was refused or could not be written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RunDirectoryError {
    /// There is something in the directory already.
    #[error(
        "{} exists and is not empty: results are never overwritten unless that is asked for; \
         name another directory, or ask to overwrite", .path.display()
    )]
    NotEmpty {
        /// The directory.
        path: PathBuf,
    },
    /// A directory that was to be overwritten has no manifest.
    #[error(
        "{} is not empty and has no {MANIFEST}, the list of the files that a run has written: nothing in it \
         is removed; name another directory, or remove this one if it is to go", .path.display()
    )]
    NoManifest {
        /// The directory.
        path: PathBuf,
    },
    /// Something has a name that runs write, and is not a file that the run has written.
    #[error(
        "{} was not written by the run whose files {MANIFEST} lists: it is left alone; move it, or name \
         another directory", .path.display()
    )]
    NotOfARun {
        /// The file, folder or link.
        path: PathBuf,
    },
    /// A text of an earlier run is no longer what that run has written.
    #[error(
        "{} has been changed since the run wrote it: it is left alone; move it, or name another directory",
        .path.display()
    )]
    Changed {
        /// The file.
        path: PathBuf,
    },
    /// A manifest that no run has written, or another version.
    #[error(
        "{} is not the list of a run's files that it should be: {reason}; nothing is removed; name another \
         directory, or remove this one if it is to go", .path.display()
    )]
    Manifest {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// A link to a directory was to be overwritten.
    #[error(
        "{} is a link to {target}: nothing is removed through a link; name {target} itself", .path.display(),
        target = .target.display()
    )]
    Link {
        /// The link.
        path: PathBuf,
        /// What it points to.
        target: PathBuf,
    },
    /// The path names something that is no directory.
    #[error("{} is not a directory: a run writes several files into one directory", .path.display())]
    NotADirectory {
        /// The path.
        path: PathBuf,
    },
    /// Another run is going on in the directory.
    #[error(
        "{} is in use: another run{} is writing into it; wait for its end, or name another \
         directory", .path.display(), by(*.process)
    )]
    InUse {
        /// The directory.
        path: PathBuf,
        /// The process of that run, if it has said.
        process: Option<u32>,
    },
    /// The lock of the directory is a file that no run has written.
    #[error(
        "{} is in the place of the lock and was not written by a run: it is left alone; move it, or \
         name another directory", .path.display()
    )]
    ForeignLock {
        /// The file.
        path: PathBuf,
    },
    /// The file system refused.
    #[error("{}: {source}", .path.display())]
    Io {
        /// The file or directory.
        path: PathBuf,
        /// What the file system says.
        source: io::Error,
    },
    /// A record of the run could not be read back.
    #[error("a record cannot be read back: {0}")]
    Unreadable(io::Error),
    /// A file of results that is not what a run has written.
    #[error("{} is damaged: {reason}", .path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// Results of other bodies than those of the scene beside them.
    #[error("{} does not belong to the scene: {reason}", .path.display())]
    OtherBodies {
        /// The file.
        path: PathBuf,
        /// What differs.
        reason: String,
    },
    /// A number that is not finite.
    #[error("{file}: {quantity}{} is {value}: only finite numbers are written", place(.index))]
    NotFinite {
        /// The file that would have held it.
        file: String,
        /// Name of the quantity in that file.
        quantity: String,
        /// Index in the quantity's array; empty for a single number.
        index: Vec<usize>,
        /// The number.
        value: f64,
    },
    /// There is nothing to write.
    #[error("the trajectory holds no record: a run directory needs at least one")]
    NoRecord,
    /// A record that does not belong to the assembly.
    #[error("record {record} holds {found} {quantity} where the assembly has {expected}")]
    Mismatch {
        /// Index of the record.
        record: usize,
        /// What was counted.
        quantity: &'static str,
        /// Number in the record.
        found: usize,
        /// Number in the assembly.
        expected: usize,
    },
}

impl RunDirectoryError {
    /// The error of an operation on `path`.
    pub(super) fn io(path: &Path) -> impl FnOnce(io::Error) -> Self {
        move |source| Self::Io {
            path: path.to_owned(),
            source,
        }
    }
}

/// The process in brackets, where it is known.
fn by(process: Option<u32>) -> String {
    process.map_or_else(String::new, |id| format!(" (process {id})"))
}

/// The index in brackets; nothing for a single number.
fn place(index: &[usize]) -> String {
    if index.is_empty() {
        String::new()
    } else {
        format!("{index:?}")
    }
}

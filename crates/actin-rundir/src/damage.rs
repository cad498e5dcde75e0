//! Errors of checkpoints.

use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Error of reading or writing a checkpoint file.
#[derive(Debug, Error)]
#[error("{}: {damage}", .path.display())]
pub struct CheckpointError {
    /// The file.
    pub path: PathBuf,
    /// Reason.
    pub damage: Damage,
}

/// Reason for refusing a checkpoint.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Damage {
    /// The file does not exist.
    #[error("missing: there is nothing to resume from; run without --resume to begin")]
    Missing,
    /// The file system refused an operation.
    #[error("{0}")]
    Io(#[from] io::Error),
    /// The file has another format.
    #[error("not a checkpoint: it does not begin with {0:?}")]
    OtherFile(&'static str),
    /// The version of the format is not supported.
    #[error("format version {found}: this program reads version {known}")]
    Format {
        /// Version of the file.
        found: u32,
        /// Supported version.
        known: u32,
    },
    /// The file has the wrong length.
    #[error("{found} bytes where its header says {expected}: truncated or appended to")]
    Length {
        /// Actual length in bytes.
        found: u64,
        /// Expected length in bytes.
        expected: u64,
    },
    /// A checksum is wrong.
    #[error("damaged: the checksum of {part} is {found:08x} and should be {expected:08x}")]
    Checksum {
        /// Part of the file.
        part: String,
        /// Actual checksum.
        found: u32,
        /// Expected checksum.
        expected: u32,
    },
    /// The file was written by another version of the program.
    #[error(
        "written by version {found} of this program, which is {here}: bits may differ, so the run \
         can only be resumed with {found}"
    )]
    Program {
        /// Version that wrote the file.
        found: String,
        /// Version of this program.
        here: String,
    },
    /// The file belongs to another scene.
    #[error(
        "belongs to another scene: line {line} of the resolved scene was {kept:?} and is {given:?}"
    )]
    Scene {
        /// First line that differs, starting at 1.
        line: usize,
        /// Line of the stored scene.
        kept: String,
        /// Line of the given scene.
        given: String,
    },
    /// The run that `start` of the scene names has changed.
    #[error(
        "start.directory has changed since this run began: restore that run, or use --overwrite"
    )]
    Start,
    /// A completed motion cannot be extended.
    #[error("the run cannot be extended: {0}")]
    Extension(String),
    /// The contents are inconsistent although the checksum is correct.
    #[error("inconsistent contents: {0}")]
    Contents(String),
}

impl Damage {
    /// Adds the path of the file.
    pub(crate) fn of(self, path: &Path) -> CheckpointError {
        CheckpointError {
            path: path.to_owned(),
            damage: self,
        }
    }
}

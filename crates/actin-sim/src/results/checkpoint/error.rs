//! Why a checkpoint was refused or could not be written.

use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Why a checkpoint was refused or could not be written: which file, and what is wrong with it.
#[derive(Debug, Error)]
#[error("{}: {damage}", .path.display())]
pub struct CheckpointError {
    /// The file.
    pub path: PathBuf,
    /// What is wrong with it.
    pub damage: Damage,
}

/// What is wrong with a checkpoint.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Damage {
    /// There is no such file.
    #[error("missing: there is nothing to resume from; run without --resume to begin")]
    Missing,
    /// The file system refused.
    #[error("{0}")]
    Io(#[from] io::Error),
    /// Another kind of file.
    #[error("not a checkpoint: it does not begin with {expected:?}")]
    OtherFile {
        /// What it should begin with.
        expected: &'static str,
    },
    /// A format of another version of this program.
    #[error("format version {found}: this program reads version {known}")]
    Format {
        /// The version of the file.
        found: u32,
        /// The version that is read.
        known: u32,
    },
    /// Too few or too many bytes.
    #[error("{found} bytes where its header says {expected}: truncated or appended to")]
    Length {
        /// Bytes that there are.
        found: u64,
        /// Bytes that there should be.
        expected: u64,
    },
    /// Bytes that are not those that were written.
    #[error("damaged: the checksum of {part} is {found:08x} and should be {expected:08x}")]
    Checksum {
        /// Which part of the file.
        part: String,
        /// The checksum of what is there.
        found: u32,
        /// The checksum of what was written.
        expected: u32,
    },
    /// Written by another program.
    #[error(
        "written by version {found} of this program, which is {here}: bits may differ, so the run \
         can only be resumed with {found}"
    )]
    Program {
        /// The version that wrote it.
        found: String,
        /// This version.
        here: String,
    },
    /// A run of another scene.
    #[error(
        "belongs to another scene: line {line} of the resolved scene was {kept:?} and is {given:?}"
    )]
    Scene {
        /// The first line that differs, from 1.
        line: usize,
        /// The line as it was.
        kept: String,
        /// The line as it is.
        given: String,
    },
    /// Contents that make no sense although the checksum is right.
    #[error("makes no sense: {0}")]
    Contents(String),
}

impl Damage {
    /// The same with its file.
    pub(super) fn of(self, path: &Path) -> CheckpointError {
        CheckpointError {
            path: path.to_owned(),
            damage: self,
        }
    }
}

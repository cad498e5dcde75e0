//! Why an ensemble was refused or has no result.

use crate::RunError;
use thiserror::Error;

/// Why an ensemble was refused, or ended before all its replicas had.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum EnsembleError {
    /// All replicas would be the same.
    #[error(
        "the scene draws nothing that takes a seed (bonds with anchors: Independent, thermal noise, \
         imperfections): all replicas would be the same"
    )]
    NothingDrawn,
    /// A replica could not be built, or failed.
    #[error("replica {index} (seed {seed}): {error}")]
    Replica {
        /// Its number, from 0.
        index: usize,
        /// What the seeds of its scene were set to.
        seed: u64,
        /// What went wrong.
        error: RunError,
    },
    /// It was interrupted.
    #[error("interrupted when {ended} of {of} replicas had ended")]
    Interrupted {
        /// Replicas that had ended, and were observed.
        ended: usize,
        /// Replicas that there are.
        of: usize,
    },
}

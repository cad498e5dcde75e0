//! Errors of ensembles.

use crate::RunError;
use thiserror::Error;

/// Error of an ensemble.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum EnsembleError {
    /// All replicas would be identical.
    #[error(
        "the scene has nothing that depends on a seed (bonds with anchors: Independent, thermal noise, \
         imperfections): all replicas would be identical"
    )]
    NothingDrawn,
    /// A replica could not be built, or failed.
    #[error("replica {index} (seed {seed}): {error}")]
    Replica {
        /// Index of the replica.
        index: usize,
        /// Seed of the replica.
        seed: u64,
        /// Cause of the failure.
        error: RunError,
    },
}

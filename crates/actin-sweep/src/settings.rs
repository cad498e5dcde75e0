//! Settings of the execution of a sweep.

use actin_rundir::CheckpointError;
use std::num::NonZeroUsize;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// Settings of the execution.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Number of simultaneous runs, each on one thread; by default the number of cores.
    pub jobs: Option<NonZeroUsize>,
    /// Wall-clock time between checkpoints of a run.
    pub checkpoint_every: Duration,
    /// Interrupts all runs with checkpoints when set.
    pub interrupted: Arc<AtomicBool>,
    /// Called for checkpoints that cannot be written or read; the runs continue.
    pub warn: fn(&CheckpointError),
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            jobs: None,
            checkpoint_every: Duration::from_mins(1),
            interrupted: Arc::default(),
            warn: |_| (),
        }
    }
}

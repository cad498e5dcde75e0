//! A sink that also ends its run when its ensemble does.

use crate::{Progress, Record, Recorded, RunPosition, Sink};
use actin_mechanics::State;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// What ends a replica before its time.
pub(super) struct Stop<'a> {
    /// Its number.
    pub(super) index: usize,
    /// The first replica with an error.
    pub(super) first_failed: &'a AtomicUsize,
    pub(super) interrupted: Option<&'a AtomicBool>,
}

impl Stop<'_> {
    /// Whether the replica is to end: the ensemble is interrupted, or one before it has failed.
    pub(super) fn is_set(&self) -> bool {
        let is_interrupted = self.interrupted.is_some_and(|i| i.load(Ordering::Relaxed));
        is_interrupted || self.first_failed.load(Ordering::Relaxed) < self.index
    }

    /// A sink that passes everything on, and ends the run as well.
    pub(super) fn over<'s>(&'s self, sink: &'s mut dyn Sink) -> impl Sink + 's {
        Stopped { stop: self, sink }
    }
}

struct Stopped<'a> {
    stop: &'a Stop<'a>,
    sink: &'a mut dyn Sink,
}

impl Sink for Stopped<'_> {
    fn record(&mut self, record: &Record) {
        self.sink.record(record);
    }

    fn progress(&mut self, progress: &Progress) {
        self.sink.progress(progress);
    }

    fn is_interrupted(&mut self) -> bool {
        self.stop.is_set() || self.sink.is_interrupted()
    }

    fn is_left(&mut self, step: u64, state: &State) -> bool {
        self.sink.is_left(step, state)
    }

    fn is_checkpoint_due(&mut self) -> bool {
        self.sink.is_checkpoint_due()
    }

    fn checkpoint(&mut self, position: &RunPosition, recorded: &Recorded, wall_s: f64) {
        self.sink.checkpoint(position, recorded, wall_s);
    }
}

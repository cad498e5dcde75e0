//! Sink that stops the run of a replica together with its ensemble.

use crate::{Progress, Record, RecordSummary, RunPosition, Sink};
use actin_mechanics::State;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

pub(super) struct ReplicaStop<'a> {
    pub(super) index: usize,
    pub(super) first_failed: &'a AtomicUsize,
    pub(super) interrupted: Option<&'a AtomicBool>,
}

impl ReplicaStop<'_> {
    /// Returns `true` if the ensemble is interrupted or an earlier replica has failed.
    pub(super) fn is_set(&self) -> bool {
        let is_interrupted = self.interrupted.is_some_and(|i| i.load(Ordering::Relaxed));
        is_interrupted || self.first_failed.load(Ordering::Relaxed) < self.index
    }

    pub(super) fn over<'s>(&'s self, sink: &'s mut dyn Sink) -> impl Sink + 's {
        StoppableSink { stop: self, sink }
    }
}

struct StoppableSink<'a> {
    stop: &'a ReplicaStop<'a>,
    sink: &'a mut dyn Sink,
}

impl Sink for StoppableSink<'_> {
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

    fn checkpoint(&mut self, position: &RunPosition, recorded: &RecordSummary, wall_s: f64) {
        self.sink.checkpoint(position, recorded, wall_s);
    }
}

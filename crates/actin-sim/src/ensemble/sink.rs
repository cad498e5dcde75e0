//! Sink that stops the run of a replica after the failure of an earlier one.

use crate::{Record, Sink, Trajectory};
use std::sync::atomic::{AtomicUsize, Ordering};

pub(super) struct ReplicaStop<'a> {
    pub(super) index: usize,
    pub(super) first_failed: &'a AtomicUsize,
}

impl ReplicaStop<'_> {
    /// Returns `true` if an earlier replica has failed.
    pub(super) fn is_set(&self) -> bool {
        self.first_failed.load(Ordering::Relaxed) < self.index
    }

    pub(super) fn over<'s>(&'s self, sink: &'s mut Trajectory) -> impl Sink + 's {
        StoppableSink { stop: self, sink }
    }
}

struct StoppableSink<'a> {
    stop: &'a ReplicaStop<'a>,
    sink: &'a mut Trajectory,
}

impl Sink for StoppableSink<'_> {
    fn record(&mut self, record: &Record) {
        self.sink.record(record);
    }

    fn is_interrupted(&mut self) -> bool {
        self.stop.is_set()
    }
}

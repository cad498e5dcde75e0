//! The records of a run as they are taken: what is known of them without keeping them.

use super::slip::{LinkWatch, Slip};
use super::{Progress, Record, RunPosition, Sink};
use crate::assembly::worst_of;
use crate::{Assembly, BeyondUse};
use actin_mechanics::State;

/// Passes records on to a sink, unless twist was lost on the way to them.
pub(super) struct Taken<'a> {
    pub(super) sink: &'a mut dyn Sink,
    assembly: &'a Assembly,
    links: LinkWatch,
    slip: Option<Slip>,
    count: usize,
    last: Option<Record>,
    beyond_use: Vec<BeyondUse>,
}

impl<'a> Taken<'a> {
    /// Records of a run that begins in `start`, of which the `earlier` ones were taken before it was
    /// interrupted; the sink has those.
    pub(super) fn new(
        assembly: &'a Assembly,
        start: &State,
        earlier: Vec<Record>,
        sink: &'a mut dyn Sink,
    ) -> Self {
        let mut links = LinkWatch::new(assembly, start);
        links.follow(assembly, &earlier);
        Self {
            sink,
            assembly,
            links,
            slip: None,
            count: earlier.len(),
            beyond_use: assembly.worst_beyond_use(earlier.iter().map(|record| &record.state)),
            last: earlier.into_iter().next_back(),
        }
    }

    /// Takes a record; false, with nothing taken, where twist was lost on the way to it.
    pub(super) fn take(&mut self, record: Record) -> bool {
        let before = self.last.as_ref().map(|record| &record.state);
        let here = (&record.state, record.time_ns);
        self.slip = self.links.slip(self.assembly, here, before);
        if self.slip.is_some() {
            return false;
        }
        self.take_unchecked(record);
        true
    }

    /// Takes a record whose twist is not looked at: that of an attempt which failed.
    pub(super) fn take_unchecked(&mut self, record: Record) {
        self.sink.record(&record);
        let beyond = self.assembly.beyond_use(&record.state);
        self.beyond_use = worst_of(self.beyond_use.drain(..).chain(beyond).collect::<Vec<_>>());
        self.count += 1;
        self.last = Some(record);
    }

    /// The last record.
    pub(super) fn last(&self) -> Option<&Record> {
        self.last.as_ref()
    }

    /// How many there are.
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// Whether twist was lost.
    pub(super) fn has_slipped(&self) -> bool {
        self.slip.is_some()
    }

    /// How twist was lost, if it was.
    pub(super) fn slip(&mut self) -> Option<Slip> {
        self.slip.take()
    }

    /// What is beyond any use in them, the worst of all.
    pub(super) fn into_beyond_use(self) -> Vec<BeyondUse> {
        self.beyond_use
    }

    /// Passes a checkpoint on that comes behind all records but the last `less`.
    pub(super) fn checkpoint(&mut self, position: &RunPosition, less: usize, wall_s: f64) {
        self.sink.checkpoint(position, self.count - less, wall_s);
    }

    /// Passes on how far the run has come.
    pub(super) fn progress(&mut self, progress: &Progress) {
        self.sink.progress(progress);
    }
}

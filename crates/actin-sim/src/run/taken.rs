//! The records of a run as they are taken: what is known of them without keeping them.

use super::slip::{LinkWatch, Slip};
use super::{Plan, Progress, Record, RunPosition, Sink};
use crate::assembly::worst_of;
use crate::{Assembly, BeyondUse};

/// What a run remembers of the records that it has taken. It holds one of them, the last.
#[derive(Clone, Debug)]
pub struct Recorded {
    links: LinkWatch,
    count: usize,
    last: Option<Record>,
    beyond_use: Vec<BeyondUse>,
}

impl Recorded {
    /// That of a run of `assembly` that has taken none.
    pub(crate) fn new(assembly: &Assembly) -> Self {
        let mut start = assembly.system.state().clone();
        // Without a path, held ends are where the caller has put them.
        if !assembly.drive.is_still() {
            assembly.drive.place(&mut start, 0.0);
        }
        Self {
            links: LinkWatch::new(assembly, &start),
            count: 0,
            last: None,
            beyond_use: Vec::new(),
        }
    }

    /// That of a run that has taken `records`, in order: what a sink of one's own needs to
    /// [resume](crate::Plan::resume_into).
    pub fn of(plan: &Plan<'_>, records: impl IntoIterator<Item = Record>) -> Self {
        let mut recorded = Self::new(plan.assembly());
        for record in records {
            recorded.follow(plan.assembly(), record);
        }
        recorded
    }

    /// How many records there are.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Adds a record that was found good when it was taken.
    pub(crate) fn follow(&mut self, assembly: &Assembly, record: Record) {
        self.links.follow(assembly, &record);
        self.push(assembly, record);
    }

    fn push(&mut self, assembly: &Assembly, record: Record) {
        let beyond = assembly.beyond_use(&record.state);
        self.beyond_use = worst_of(self.beyond_use.drain(..).chain(beyond).collect::<Vec<_>>());
        self.count += 1;
        self.last = Some(record);
    }
}

/// Passes records on to a sink, unless twist was lost on the way to them.
pub(super) struct Taken<'a> {
    pub(super) sink: &'a mut dyn Sink,
    assembly: &'a Assembly,
    recorded: Recorded,
    slip: Option<Slip>,
}

impl<'a> Taken<'a> {
    /// Records of a run, of which the sink has those that are `recorded`.
    pub(super) fn new(
        assembly: &'a Assembly,
        recorded: Option<Recorded>,
        sink: &'a mut dyn Sink,
    ) -> Self {
        Self {
            sink,
            assembly,
            recorded: recorded.unwrap_or_else(|| Recorded::new(assembly)),
            slip: None,
        }
    }

    /// Takes a record and returns true, unless twist was lost since the one before.
    pub(super) fn take(&mut self, record: Record) -> bool {
        let Recorded { links, last, .. } = &mut self.recorded;
        let before = last.as_ref().map(|record| &record.state);
        let here = (&record.state, record.at);
        self.slip = links.slip(self.assembly, here, before);
        if self.slip.is_some() {
            return false;
        }
        self.take_unchecked(record);
        true
    }

    /// Takes a record whose twist is not looked at: that of an attempt which failed.
    pub(super) fn take_unchecked(&mut self, record: Record) {
        self.sink.record(&record);
        self.recorded.push(self.assembly, record);
    }

    /// The last record.
    pub(super) fn last(&self) -> Option<&Record> {
        self.recorded.last.as_ref()
    }

    /// How many there are.
    pub(super) fn count(&self) -> usize {
        self.recorded.count
    }

    /// Whether twist was lost.
    pub(super) fn has_slipped(&self) -> bool {
        self.slip.is_some()
    }

    /// How twist was lost, if it was.
    pub(super) fn slip(&mut self) -> Option<Slip> {
        self.slip.take()
    }

    /// What is far outside the range of the model in them, the worst of all.
    pub(super) fn into_beyond_use(self) -> Vec<BeyondUse> {
        self.recorded.beyond_use
    }

    /// Passes a checkpoint on that comes behind all records but the last `less`.
    pub(super) fn checkpoint(&mut self, position: &RunPosition, less: usize, wall_s: f64) {
        self.sink.checkpoint(position, self.count() - less, wall_s);
    }

    /// Passes on how far the run has come.
    pub(super) fn progress(&mut self, progress: &Progress) {
        self.sink.progress(progress);
    }
}

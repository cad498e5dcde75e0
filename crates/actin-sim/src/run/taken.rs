//! The records of a run as they are taken: what is known of them without keeping them.

use super::hinge::slip_between;
use super::slip::{LinkWatch, Lost};
use super::{At, Plan, Progress, Record, RunPosition, Sink};
use crate::assembly::{RangeWatch, TwistRecords, worst_of};
use crate::observe::{Memory, View};
use crate::{Assembly, BeyondRange, BeyondUse, UnstableTwist};
use actin_mechanics::State;
use serde::{Deserialize, Serialize};

/// What a run remembers of the records that it has taken. It holds one of them, the last.
#[derive(Clone, Debug)]
pub struct Recorded {
    pub(crate) carried: Carried,
    pub(crate) last: Option<Record>,
}

/// What a run carries from record to record, besides the last of them. A checkpoint holds it.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Carried {
    /// How many records there are.
    pub(crate) count: usize,
    links: LinkWatch,
    beyond_use: Vec<BeyondUse>,
    ranges: RangeWatch,
    twist: TwistRecords,
    observed: Memory,
}

/// What is wrong with the states of a run, the worst of all records.
#[derive(Debug)]
pub(super) struct Remarks {
    pub(super) beyond_use: Vec<BeyondUse>,
    pub(super) beyond_range: Vec<BeyondRange>,
    pub(super) unstable_twist: Vec<UnstableTwist>,
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
            carried: Carried {
                count: 0,
                links: LinkWatch::new(assembly, &start),
                beyond_use: Vec::new(),
                ranges: RangeWatch::new(assembly),
                twist: TwistRecords::new(assembly),
                observed: assembly.observers.memory(),
            },
            last: None,
        }
    }

    /// That of a run that has taken `records`, in order: what a sink of one's own needs to
    /// [resume](crate::Plan::resume_into).
    pub fn of(plan: &Plan<'_>, records: impl IntoIterator<Item = Record>) -> Self {
        let assembly = plan.assembly();
        let mut recorded = Self::new(assembly);
        for record in records {
            recorded.carried.links.follow(assembly, &record);
            recorded.push(assembly, record);
        }
        recorded
    }

    /// That of a run of `assembly` which goes on behind a switch of cells with a first record: of the records before
    /// it keeps what does not depend on the resolution.
    pub(crate) fn behind_switch(&self, assembly: &Assembly, first: Record) -> Self {
        let mut recorded = Self::new(assembly);
        recorded.carried.links = self.carried.links.clone();
        recorded.carried.observed = self.carried.observed.clone();
        recorded.carried.links.follow(assembly, &first);
        recorded.push(assembly, first);
        recorded
    }

    /// The last record.
    pub fn last(&self) -> Option<&Record> {
        self.last.as_ref()
    }

    /// How many records there are.
    pub fn count(&self) -> usize {
        self.carried.count
    }

    /// Adds a record, with what the scene observes of it.
    fn push(&mut self, assembly: &Assembly, mut record: Record) -> &Record {
        let all = &mut self.carried;
        let energies = (record.energies_pn_nm.as_slice(), record.kinetic_pn_nm);
        let view = View::new(assembly, (record.at, &record.state), energies);
        record.booked = assembly.booked(&record.state);
        record.observed = assembly.observers.row(&view, &mut all.observed);
        let beyond = assembly.beyond_use(&record.state);
        all.beyond_use = worst_of(all.beyond_use.drain(..).chain(beyond).collect::<Vec<_>>());
        all.ranges.add(assembly, &record.state);
        all.twist.add(assembly, &record.state);
        all.count += 1;
        self.last.insert(record)
    }
}

impl Carried {
    /// Whether it is of a run of the same scene as `other`, which has taken no records.
    pub(crate) fn fits(&self, other: &Self) -> bool {
        self.observed.fits(&other.observed)
            && self.links.fits(&other.links)
            && self.twist.fits(&other.twist)
    }
}

/// Passes records on to a sink, unless twist was lost on the way to them.
pub(super) struct Taken<'a> {
    pub(super) sink: &'a mut dyn Sink,
    assembly: &'a Assembly,
    recorded: Recorded,
    lost: Option<Lost>,
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
            lost: None,
        }
    }

    /// Takes a record and returns true, unless turns were lost since the one before.
    pub(super) fn take(&mut self, record: Record) -> bool {
        let Recorded { carried, last } = &mut self.recorded;
        let good = carried.links.clone();
        let before = last.as_ref().map(|record| &record.state);
        let here = (&record.state, record.at);
        let twist = carried.links.slip(self.assembly, here, before);
        // In time, hinges are looked at more often. A turn that a hinge has lost the filament lacks, too.
        let path = before.filter(|_| matches!(record.at, At::Path(_)));
        let hinge = path.and_then(|path| slip_between(self.assembly, path, here));
        self.lost = hinge.map(Lost::Hinge).or(twist.map(Lost::Twist));
        if self.lost.is_some() {
            carried.links = good;
            return false;
        }
        self.take_unchecked(record);
        true
    }

    /// Takes a record whose twist is not looked at: that of an attempt which failed.
    pub(super) fn take_unchecked(&mut self, record: Record) {
        let record = self.recorded.push(self.assembly, record);
        self.sink.record(record);
    }

    /// Whether a state that is not recorded has all turns of the last record.
    pub(super) fn has_all_turns(&self, here: (&State, At)) -> bool {
        let mut links = self.recorded.carried.links.clone();
        let before = self.last().map(|record| &record.state);
        links.slip(self.assembly, here, before).is_none()
    }

    /// The last record.
    pub(super) fn last(&self) -> Option<&Record> {
        self.recorded.last.as_ref()
    }

    /// What is remembered of all records.
    pub(super) fn recorded(&self) -> &Recorded {
        &self.recorded
    }

    /// Takes note of turns that were lost between records.
    pub(super) fn lose(&mut self, lost: Lost) {
        self.lost = Some(lost);
    }

    /// Whether turns were lost.
    pub(super) fn has_lost(&self) -> bool {
        self.lost.is_some()
    }

    /// How turns were lost, if they were.
    pub(super) fn lost(&mut self) -> Option<Lost> {
        self.lost.take()
    }

    /// What is wrong with the states of all records.
    pub(super) fn into_remarks(self) -> Remarks {
        let carried = self.recorded.carried;
        Remarks {
            beyond_use: carried.beyond_use,
            beyond_range: carried.ranges.end(self.assembly),
            unstable_twist: carried.twist.end(),
        }
    }

    /// Passes a checkpoint on that comes behind all records.
    pub(super) fn checkpoint(&mut self, position: &RunPosition, wall_s: f64) {
        self.sink.checkpoint(position, &self.recorded, wall_s);
    }

    /// Passes a checkpoint on that comes behind those that are `recorded`.
    pub(super) fn checkpoint_behind(
        &mut self,
        position: &RunPosition,
        recorded: &Recorded,
        wall_s: f64,
    ) {
        self.sink.checkpoint(position, recorded, wall_s);
    }

    /// Passes on how far the run has come.
    pub(super) fn progress(&mut self, progress: &Progress) {
        self.sink.progress(progress);
    }
}

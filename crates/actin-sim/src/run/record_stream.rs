//! Record stream of a run with running diagnostics, without storing the records.

use super::hinge::slip_between;
use super::slip::{LinkWatch, TurnLoss};
use super::step_check::StepComparisons;
use super::{At, Progress, Record, RunPosition, Sink};
use crate::assembly::{RangeWatch, TwistRecords, worst_of};
use crate::observe::{Memory, View};
use crate::{Assembly, LawExtrapolation, ModelLimitExceeded, UnstableTwist};
use actin_mechanics::State;
use serde::{Deserialize, Serialize};

/// Summary of the records of a run, including the last record.
#[derive(Clone, Debug)]
pub struct RecordSummary {
    /// Running statistics.
    pub carried: RunStatistics,
    /// Last record.
    pub last: Option<Record>,
}

/// Running statistics of the records, stored in checkpoints.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct RunStatistics {
    /// Number of records.
    pub count: usize,
    links: LinkWatch,
    beyond_use: Vec<ModelLimitExceeded>,
    ranges: RangeWatch,
    twist: TwistRecords,
    observed: Memory,
    pub(super) steps: StepComparisons,
}

#[derive(Debug)]
pub(super) struct StateWarnings {
    pub(super) beyond_use: Vec<ModelLimitExceeded>,
    pub(super) beyond_range: Vec<LawExtrapolation>,
    pub(super) unstable_twist: Vec<UnstableTwist>,
    pub(super) steps: StepComparisons,
}

impl RecordSummary {
    /// Creates the summary of a run of `assembly` without records.
    pub fn new(assembly: &Assembly) -> Self {
        let mut start = assembly.system.state().clone();
        // Without a path, the caller sets held ends.
        if !assembly.drive.is_still() {
            assembly.drive.place(&mut start, 0.0);
        }
        Self {
            carried: RunStatistics {
                count: 0,
                links: LinkWatch::new(assembly, &start),
                beyond_use: Vec::new(),
                ranges: RangeWatch::new(assembly),
                twist: TwistRecords::new(assembly),
                observed: assembly.observers.memory(),
                steps: StepComparisons::default(),
            },
            last: None,
        }
    }

    /// Creates the summary of a run that continues after a switch of cells with a first record.
    /// Statistics that do not depend on the resolution are kept.
    pub(crate) fn behind_switch(&self, assembly: &Assembly, first: Record) -> Self {
        let mut recorded = Self::new(assembly);
        recorded.carried.links = self.carried.links.clone();
        recorded.carried.observed = self.carried.observed.clone();
        recorded.carried.links.follow(assembly, &first);
        recorded.push(assembly, first);
        recorded
    }

    /// Returns the last record.
    pub fn last(&self) -> Option<&Record> {
        self.last.as_ref()
    }

    /// Returns the number of records.
    pub fn count(&self) -> usize {
        self.carried.count
    }

    fn push(&mut self, assembly: &Assembly, mut record: Record) -> &Record {
        let all = &mut self.carried;
        let energies = (record.energies_pn_nm.as_slice(), record.kinetic_pn_nm);
        let view = View::new(assembly, (record.at, &record.state), energies);
        let observed = assembly.observers.row(&view, &mut all.observed);
        record.row.booked = assembly.booked(&record.state);
        record.row.observed = observed;
        let beyond = assembly.beyond_use(&record.state);
        all.beyond_use = worst_of(all.beyond_use.drain(..).chain(beyond).collect::<Vec<_>>());
        all.ranges.add(assembly, &record.state);
        all.twist.add(assembly, &record.state);
        all.count += 1;
        self.last.insert(record)
    }
}

impl RunStatistics {
    /// Returns `true` if the statistics belong to the same observers and filaments.
    pub fn fits(&self, other: &Self) -> bool {
        self.observed.fits(&other.observed)
            && self.links.fits(&other.links)
            && self.twist.fits(&other.twist)
    }
}

/// Passes records to a sink while checking for lost twist.
pub(super) struct RecordStream<'a> {
    pub(super) sink: &'a mut dyn Sink,
    assembly: &'a Assembly,
    recorded: RecordSummary,
    lost: Option<TurnLoss>,
}

impl<'a> RecordStream<'a> {
    pub(super) fn new(
        assembly: &'a Assembly,
        recorded: Option<RecordSummary>,
        sink: &'a mut dyn Sink,
    ) -> Self {
        Self {
            sink,
            assembly,
            recorded: recorded.unwrap_or_else(|| RecordSummary::new(assembly)),
            lost: None,
        }
    }

    /// Accepts a record and returns `true`, unless turns were lost since the previous record.
    pub(super) fn take(&mut self, record: Record) -> bool {
        let RecordSummary { carried, last } = &mut self.recorded;
        let good = carried.links.clone();
        let before = last.as_ref().map(|record| &record.state);
        let here = (&record.state, record.at);
        let twist = carried.links.slip(self.assembly, here, before);
        // In a motion, hinges are checked more often. A turn lost by a hinge is also missing in the
        // filament.
        let path = before.filter(|_| matches!(record.at, At::Path(_)));
        let hinge = path.and_then(|path| slip_between(self.assembly, path, here));
        self.lost = hinge.map(TurnLoss::Hinge).or(twist.map(TurnLoss::Twist));
        if self.lost.is_some() {
            carried.links = good;
            return false;
        }
        self.take_unchecked(record);
        true
    }

    /// Accepts the record of a failed attempt without a check of its twist.
    pub(super) fn take_unchecked(&mut self, record: Record) {
        let record = self.recorded.push(self.assembly, record);
        self.sink.record(record);
    }

    /// Returns `true` if an unrecorded state has all turns of the last record.
    pub(super) fn has_all_turns(&self, here: (&State, At)) -> bool {
        let mut links = self.recorded.carried.links.clone();
        let before = self.last().map(|record| &record.state);
        links.slip(self.assembly, here, before).is_none()
    }

    pub(super) fn last(&self) -> Option<&Record> {
        self.recorded.last.as_ref()
    }

    pub(super) fn step_comparisons(&mut self) -> &mut StepComparisons {
        &mut self.recorded.carried.steps
    }

    pub(super) fn recorded(&self) -> &RecordSummary {
        &self.recorded
    }

    pub(super) fn lose(&mut self, lost: TurnLoss) {
        self.lost = Some(lost);
    }

    pub(super) fn has_lost(&self) -> bool {
        self.lost.is_some()
    }

    pub(super) fn lost(&mut self) -> Option<TurnLoss> {
        self.lost.take()
    }

    pub(super) fn into_remarks(self) -> StateWarnings {
        let carried = self.recorded.carried;
        StateWarnings {
            beyond_use: carried.beyond_use,
            beyond_range: carried.ranges.end(self.assembly),
            unstable_twist: carried.twist.end(),
            steps: carried.steps,
        }
    }

    pub(super) fn checkpoint(&mut self, position: &RunPosition, wall_s: f64) {
        self.sink.checkpoint(position, &self.recorded, wall_s);
    }

    pub(super) fn checkpoint_behind(
        &mut self,
        position: &RunPosition,
        recorded: &RecordSummary,
        wall_s: f64,
    ) {
        self.sink.checkpoint(position, recorded, wall_s);
    }

    pub(super) fn progress(&mut self, progress: &Progress) {
        self.sink.progress(progress);
    }
}

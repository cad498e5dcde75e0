//! Record stream of a run with running diagnostics, without storing the records.

use super::hinge::slip_between;
use super::record_summary::{RecordSummary, StateWarnings};
use super::slip::TurnLoss;
use super::step_check::StepComparisons;
use super::{Progress, Record, RunPosition, Sink};
use crate::Assembly;
use crate::At;
use crate::observe::Observers;
use actin_mechanics::State;

/// Passes records to a sink while checking for lost twist.
pub(super) struct RecordStream<'a> {
    pub(super) sink: &'a mut dyn Sink,
    assembly: &'a Assembly,
    observers: Observers,
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
            observers: Observers::new(assembly),
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
        let record = self.recorded.push((self.assembly, &self.observers), record);
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
        self.recorded.into_warnings(self.assembly)
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

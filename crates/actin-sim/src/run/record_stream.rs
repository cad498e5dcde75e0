//! Record stream of a run with running diagnostics, without storing the records.

use super::hinge::slip_between;
use super::slip::TurnLoss;
use super::{Record, RecordSummary, RunPosition, Sink};
use crate::Assembly;
use crate::At;
use actin_mechanics::State;

/// Passes records to a sink while checking for lost twist.
pub(super) struct RecordStream<'a> {
    pub(super) sink: &'a mut dyn Sink,
    assembly: &'a Assembly,
    pub(super) recorded: RecordSummary,
    /// Turns lost since the last record.
    pub(super) lost: Option<TurnLoss>,
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

    pub(super) fn checkpoint(&mut self, position: &RunPosition, wall_s: f64) {
        self.sink.checkpoint(position, &self.recorded, wall_s);
    }
}

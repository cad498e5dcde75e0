//! Statistics over all records of a run for its summary.

use super::{LateKinetic, Summary, ThermalSummary};
use crate::observe::Averages;
use crate::{Assembly, Outcome, Record, Records, RecordsError, StoredRecord};

/// Means and checks over the records of a run, added in order.
struct RecordStatistics<'a> {
    assembly: &'a Assembly,
    records: usize,
    kinetic: LateKinetic,
    averages: Averages,
}

impl<'a> RecordStatistics<'a> {
    /// Creates the statistics of a run of `assembly` with `count` records.
    fn new(assembly: &'a Assembly, count: usize) -> Self {
        Self {
            assembly,
            records: 0,
            kinetic: LateKinetic::new(count),
            averages: Averages::new(assembly),
        }
    }

    /// Adds the next record.
    ///
    /// # Errors
    /// The record has other bodies or columns than the assembly.
    fn add(&mut self, record: &StoredRecord<'_>) -> Result<(), RecordsError> {
        record.ensure_fits(self.records, (self.assembly, self.averages.width()))?;
        let row = &record.row;
        self.records += 1;
        self.kinetic.add(row.kinetic_pn_nm);
        self.averages.add(row.at.value(), &row.observed);
        Ok(())
    }

    /// Returns the summary of the run, which ended with the record `last`.
    fn summary(self, last: &Record, outcome: &Outcome) -> Summary {
        Summary {
            beyond_range: outcome.beyond_range.clone(),
            unstable_twist: outcome.unstable_twist.clone(),
            step_errors: outcome.step_errors.clone(),
            observables: self.averages.end(),
            thermal: ThermalSummary::new(self.assembly, &self.kinetic),
            ..Summary::without_derived_warnings(self.assembly, last, outcome)
        }
        .with_derived_warnings()
    }
}

impl Summary {
    /// Creates the summary of a whole run, with means and worst cases over all records.
    ///
    /// # Errors
    /// The records are empty or unreadable, or belong to another assembly.
    pub fn from_run(
        assembly: &Assembly,
        records: &dyn Records,
        outcome: &Outcome,
    ) -> Result<Self, RecordsError> {
        let (summary, _) = Self::with_last_record(assembly, records, outcome)?;
        Ok(summary)
    }

    /// Summary of a run and its last record.
    ///
    /// # Errors
    /// As [`from_run`](Self::from_run).
    pub fn with_last_record(
        assembly: &Assembly,
        records: &dyn Records,
        outcome: &Outcome,
    ) -> Result<(Self, Record), RecordsError> {
        let mut statistics = RecordStatistics::new(assembly, records.count());
        let mut last = None;
        for record in records.iter() {
            let record = record.map_err(RecordsError::Unreadable)?;
            statistics.add(&record)?;
            last = Some(record);
        }
        let last = last.and_then(StoredRecord::into_record);
        let last = last.ok_or(RecordsError::Empty)?;
        Ok((statistics.summary(&last, outcome), last))
    }
}

//! Statistics over all records of a run for its summary.

use super::{Summary, ThermalSummary};
use crate::observe::Averages;
use crate::{Assembly, Outcome, Record, Records, RecordsError, StoredRecord};

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
        let mut averages = Averages::new(assembly);
        // Sum and number of kinetic energies in the second half of the records.
        let mut late = (0.0, 0);
        let half = records.count() / 2;
        let mut last = None;
        for (i, record) in records.iter().enumerate() {
            let record = record.map_err(RecordsError::Unreadable)?;
            record.ensure_fits(i, (assembly, averages.width()))?;
            averages.add(record.row.at.value(), &record.row.observed);
            if i >= half {
                late = (late.0 + record.row.kinetic_pn_nm, late.1 + 1);
            }
            last = Some(record);
        }
        let last = last.and_then(StoredRecord::into_record);
        let last = last.ok_or(RecordsError::Empty)?;
        let summary = Self {
            beyond_range: outcome.beyond_range.clone(),
            unstable_twist: outcome.unstable_twist.clone(),
            observables: averages.end(),
            thermal: ThermalSummary::new(assembly, late),
            ..Self::without_derived_warnings(assembly, &last, outcome)
        };
        Ok((summary.with_derived_warnings(), last))
    }
}

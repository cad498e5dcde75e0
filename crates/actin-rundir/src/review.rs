//! Validation of all records and statistics over them.

use crate::RunDirectoryError;
use crate::energies::EnergyTable;
use crate::observables::ObservableTable;
use crate::states::States;
use actin_sim::{Assembly, Record, RecordStatistics, Records, RecordsError};
use std::borrow::Cow;

pub(crate) struct Review<'a> {
    pub(crate) statistics: RecordStatistics<'a>,
    pub(crate) last: Record,
    /// First value that is not finite; `energies.csv` takes precedence over `states.npz`.
    pub(crate) are_finite: Result<(), RunDirectoryError>,
}

pub(crate) struct Tables<'a> {
    pub(crate) energies: EnergyTable<'a>,
    pub(crate) observables: ObservableTable<'a>,
    pub(crate) states: States<'a>,
}

impl<'a> Tables<'a> {
    pub(crate) fn new(assembly: &'a Assembly) -> Self {
        Self {
            energies: EnergyTable::new(assembly),
            observables: ObservableTable::new(assembly),
            states: States::new(assembly),
        }
    }
}

impl<'a> Review<'a> {
    /// Validates the records, with their states if they are stored.
    ///
    /// # Errors
    /// The records are empty or unreadable, or do not match the assembly.
    pub(crate) fn new(
        assembly: &'a Assembly,
        records: &dyn Records,
        tables: &Tables<'_>,
    ) -> Result<Self, RunDirectoryError> {
        let mut last = None;
        let (mut rows, mut places) = (Ok(()), Ok(()));
        for (i, record) in records.iter().enumerate() {
            let record = record.map_err(RecordsError::Unreadable)?;
            record.ensure_fits(i, assembly)?;
            places = places.and_then(|()| tables.states.ensure_finite(i, &record));
            last = Some(record);
        }
        let last = last.map(Cow::into_owned);
        let mut statistics = RecordStatistics::new(assembly, records.count());
        for (i, row) in records.rows().enumerate() {
            let row = row.map_err(RecordsError::Unreadable)?;
            statistics.add(&row)?;
            rows = rows.and_then(|()| tables.energies.ensure_finite(i, &row));
            rows = rows.and_then(|()| tables.observables.ensure_finite(i, &row));
        }
        Ok(Self {
            statistics,
            last: last.ok_or(RecordsError::Empty)?,
            are_finite: rows.and(places),
        })
    }
}

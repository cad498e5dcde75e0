//! Validation of all records and statistics over them for the summary.

use super::RunDirectoryError;
use super::energies::EnergyTable;
use super::observables::ObservableTable;
use super::states::States;
use super::summary::LateKinetic;
use crate::observe::Averages;
use crate::{Assembly, ObservableSummary, Record, Records, Row};
use std::borrow::Cow;
use std::collections::BTreeMap;

pub(super) struct Review {
    pub(super) kinetic: LateKinetic,
    pub(super) observables: BTreeMap<String, ObservableSummary>,
    pub(super) last: Option<Record>,
    /// First value that is not finite; `energies.csv` takes precedence over `states.npz`.
    pub(super) are_finite: Result<(), RunDirectoryError>,
}

pub(super) struct Tables<'a> {
    pub(super) energies: EnergyTable<'a>,
    pub(super) observables: ObservableTable<'a>,
    pub(super) states: States<'a>,
}

impl<'a> Tables<'a> {
    pub(super) fn new(assembly: &'a Assembly) -> Self {
        Self {
            energies: EnergyTable::new(assembly),
            observables: ObservableTable::new(assembly),
            states: States::new(assembly),
        }
    }
}

impl Review {
    /// Validates the records, with their states if they are stored.
    ///
    /// # Errors
    /// Records that cannot be read or whose bodies, terms or columns do not match the assembly.
    pub(super) fn new(
        assembly: &Assembly,
        records: &dyn Records,
        tables: &Tables<'_>,
    ) -> Result<Self, RunDirectoryError> {
        let mut last = None;
        let (mut rows, mut places) = (Ok(()), Ok(()));
        for (i, record) in records.iter().enumerate() {
            let record = record.map_err(RunDirectoryError::Unreadable)?;
            ensure_same_bodies(assembly, i, &record)?;
            places = places.and_then(|()| tables.states.ensure_finite(i, &record));
            last = Some(record);
        }
        let last = last.map(Cow::into_owned);
        let mut kinetic = LateKinetic::new(records.count());
        let mut averages = Averages::new(assembly);
        for (i, row) in records.rows().enumerate() {
            let row = row.map_err(RunDirectoryError::Unreadable)?;
            ensure_same_numbers(assembly, i, &row)?;
            kinetic.add(row.kinetic_pn_nm);
            averages.add(row.at.value(), &row.observed);
            rows = rows.and_then(|()| tables.energies.ensure_finite(i, &row));
            rows = rows.and_then(|()| tables.observables.ensure_finite(i, &row));
        }
        Ok(Self {
            kinetic,
            observables: averages.end(),
            last,
            are_finite: rows.and(places),
        })
    }
}

fn ensure_same_bodies(
    assembly: &Assembly,
    i: usize,
    record: &Record,
) -> Result<(), RunDirectoryError> {
    let state = &record.state;
    ensure_same(i, ("points", state.points.len()), assembly.points.len())?;
    ensure_same(i, ("frames", state.frames.len()), assembly.frames.len())
}

fn ensure_same_numbers(assembly: &Assembly, i: usize, row: &Row) -> Result<(), RunDirectoryError> {
    let energies = ("energies", row.energies_pn_nm.len());
    ensure_same(i, energies, assembly.terms.len())?;
    let columns = assembly.observers.columns().len();
    ensure_same(i, ("observables", row.observed.len()), columns)
}

fn ensure_same(
    record: usize,
    (quantity, found): (&'static str, usize),
    expected: usize,
) -> Result<(), RunDirectoryError> {
    if found == expected {
        return Ok(());
    }
    Err(RunDirectoryError::Mismatch {
        record,
        quantity,
        found,
        expected,
    })
}

//! Looking at all records of a run, one by one: what is wrong with them, and what a summary says of all.

use super::RunDirectoryError;
use super::energies::EnergyTable;
use super::observables::ObservableTable;
use super::states::States;
use super::summary::LateKinetic;
use crate::observe::Averages;
use crate::{Assembly, ObservableSummary, Record, Records, Row};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// What is known of records that were looked at one by one.
pub(super) struct Review {
    pub(super) kinetic: LateKinetic,
    pub(super) observables: BTreeMap<String, ObservableSummary>,
    pub(super) last: Option<Record>,
    /// The first number that is not, those of `energies.csv` before those of `states.npz`.
    pub(super) are_finite: Result<(), RunDirectoryError>,
}

/// The files that are written of all records.
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
    /// Looks at all records: at their states as far as they are kept, then at the rest.
    ///
    /// # Errors
    /// Records of other bodies, terms or columns than those of the assembly, or that cannot be read.
    pub(super) fn of(
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
        let mut kinetic = LateKinetic::of(records.count());
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

/// Refuses record `i` if it has other bodies than those of the assembly.
fn ensure_same_bodies(
    assembly: &Assembly,
    i: usize,
    record: &Record,
) -> Result<(), RunDirectoryError> {
    let state = &record.state;
    ensure_same(i, ("points", state.points.len()), assembly.points.len())?;
    ensure_same(i, ("frames", state.frames.len()), assembly.frames.len())
}

/// Refuses record `i` if it has other terms or columns.
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

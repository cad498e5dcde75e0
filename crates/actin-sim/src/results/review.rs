//! Looking at all records of a run, one by one: what is wrong with them, and what a summary says of all.

use super::RunDirectoryError;
use super::energies::EnergyTable;
use super::states::States;
use super::summary::LateKinetic;
use crate::assembly::{RangeWatch, TwistRecords};
use crate::{Assembly, Record, Records};
use std::borrow::Cow;

/// What is known of records that were looked at one by one.
pub(super) struct Review<'a> {
    pub(super) ranges: RangeWatch<'a>,
    pub(super) twist: TwistRecords<'a>,
    pub(super) kinetic: LateKinetic,
    pub(super) last: Option<Record>,
    /// The first number that is not, those of `energies.csv` before those of `states.npz`.
    pub(super) are_finite: Result<(), RunDirectoryError>,
}

impl<'a> Review<'a> {
    /// Looks at all records.
    ///
    /// # Errors
    /// Records of other bodies or terms than those of the assembly, or that cannot be read.
    pub(super) fn of(
        assembly: &'a Assembly,
        records: &dyn Records,
        (table, states): (&EnergyTable<'_>, &States<'_>),
    ) -> Result<Self, RunDirectoryError> {
        let mut ranges = RangeWatch::new(assembly);
        let mut twist = TwistRecords::new(assembly);
        let mut kinetic = LateKinetic::of(records.count());
        let mut last = None;
        let (mut energies, mut places) = (Ok(()), Ok(()));
        for (i, record) in records.iter().enumerate() {
            let record = record.map_err(RunDirectoryError::Unreadable)?;
            ensure_same_bodies(assembly, i, &record)?;
            ranges.add(&record.state);
            twist.add(&record.state);
            kinetic.add(&record);
            energies = energies.and_then(|()| table.ensure_finite(i, &record));
            places = places.and_then(|()| states.ensure_finite(i, &record));
            last = Some(record);
        }
        Ok(Self {
            ranges,
            twist,
            kinetic,
            last: last.map(Cow::into_owned),
            are_finite: energies.and(places),
        })
    }
}

/// Refuses record `i` if it has other bodies or terms than those of the assembly.
fn ensure_same_bodies(
    assembly: &Assembly,
    i: usize,
    record: &Record,
) -> Result<(), RunDirectoryError> {
    let Record {
        state,
        energies_pn_nm,
        ..
    } = record;
    for (quantity, found, expected) in [
        ("points", state.points.len(), assembly.points.len()),
        ("frames", state.frames.len(), assembly.frames.len()),
        ("energies", energies_pn_nm.len(), assembly.terms.len()),
    ] {
        if found != expected {
            return Err(RunDirectoryError::Mismatch {
                record: i,
                quantity,
                found,
                expected,
            });
        }
    }
    Ok(())
}

//! `observables.csv`: observables, one row per record.

use crate::finite::ensure_finite_in;
use crate::names::OBSERVABLES;
use crate::{RunDirectoryError, clock};
use actin_sim::{Assembly, Records, Row};
use std::io::{self, Write};

pub(crate) struct ObservableTable<'a> {
    assembly: &'a Assembly,
}

impl<'a> ObservableTable<'a> {
    pub(crate) fn new(assembly: &'a Assembly) -> Self {
        Self { assembly }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.columns().is_empty()
    }

    fn columns(&self) -> &'a [String] {
        self.assembly.observed()
    }

    /// Refuses infinite values of record `i`; NaN means that no value is available yet.
    pub(crate) fn ensure_finite(&self, i: usize, row: &Row) -> Result<(), RunDirectoryError> {
        let mut columns = self.columns().iter().zip(&row.observed);
        columns.try_for_each(|(name, value)| {
            let known = Some(*value).filter(|value| !value.is_nan());
            ensure_finite_in((OBSERVABLES, name), i, &[], known)
        })
    }

    /// Writes the table of `records`. Numbers have enough digits for an exact round trip; cells
    /// without a value are empty.
    pub(crate) fn write(&self, records: &dyn Records, out: &mut impl Write) -> io::Result<()> {
        let mut writer = csv::Writer::from_writer(out);
        let columns = self.columns().iter().map(String::as_str);
        writer.write_record(std::iter::once(clock(self.assembly)).chain(columns))?;
        for row in records.rows() {
            let row = row?;
            let cell = |value: &f64| match value {
                value if value.is_nan() => String::new(),
                value => format!("{value:?}"),
            };
            let time = format!("{:?}", row.at.value());
            writer.write_record(std::iter::once(time).chain(row.observed.iter().map(cell)))?;
        }
        writer.flush()
    }
}

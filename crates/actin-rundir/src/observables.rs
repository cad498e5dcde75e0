//! `observables.csv`: observables, one row per record.

use crate::clock;
use crate::names::OBSERVABLES;
use crate::table::{self, Cell};
use actin_sim::{Assembly, Records, observed_columns};
use std::io::{self, Write};

/// Writes the table of `records`. Cells without a value yet (NaN) are empty.
pub(crate) fn write(
    assembly: &Assembly,
    records: &dyn Records,
    out: &mut impl Write,
) -> io::Result<()> {
    let mut columns = vec![clock(assembly).to_owned()];
    columns.extend(observed_columns(assembly));
    let rows = records.iter().map(|record| {
        let row = record?.row.into_owned();
        let observed = row.observed.into_iter().map(|value| match value {
            value if value.is_nan() => Cell::Text(String::new()),
            value => Cell::Number(value),
        });
        Ok(std::iter::once(Cell::Number(row.at.value())).chain(observed))
    });
    table::write(OBSERVABLES, &columns, rows, out)
}

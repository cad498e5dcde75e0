//! Tables of a run as CSV.

use crate::RunDirectoryError;
use std::io::{self, Write};

/// Cell of a table.
pub(crate) enum Cell {
    /// Finite number, written with enough digits for an exact round trip.
    Number(f64),
    /// Text, or nothing.
    Text(String),
}

/// Writes a table with the given columns and rows.
///
/// # Errors
/// A number is not finite, a row cannot be read, or `out` returns an error.
pub(crate) fn write<R: IntoIterator<Item = Cell>>(
    file: &str,
    columns: &[String],
    rows: impl IntoIterator<Item = io::Result<R>>,
    out: &mut impl Write,
) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    writer.write_record(columns)?;
    for (i, row) in rows.into_iter().enumerate() {
        for (cell, column) in row?.into_iter().zip(columns) {
            match cell {
                Cell::Number(value) => {
                    RunDirectoryError::ensure_finite(file, column, &[i], value)?;
                    writer.write_field(format!("{value:?}"))?;
                }
                Cell::Text(text) => writer.write_field(text)?,
            }
        }
        writer.write_record(None::<&[u8]>)?;
    }
    writer.flush()
}

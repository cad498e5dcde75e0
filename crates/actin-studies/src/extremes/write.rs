//! The table of extremes as CSV.

use super::row::Row;
use actin_draw::report::write_csv;
use std::fs;
use std::path::Path;

pub(super) fn table(rows: &[Row], out: &Path) -> Result<(), String> {
    let header = ["varied", "case", "is_sound", "outcome"];
    let cells = rows.iter().map(|row| {
        let is_sound = row.is_sound().to_string();
        vec![
            row.varied.to_owned(),
            row.case.clone(),
            is_sound,
            row.outcome.words(),
        ]
    });
    write_csv(out, "extremes.csv", &header, cells)
}

/// Copies the table and the pictures of the documents from `out`.
pub(super) fn document(out: &Path, docs: &Path) -> Result<(), String> {
    for file in ["extremes.csv", "extremes-limits.svg", "extremes-energy.svg"] {
        let path = docs.join(file);
        fs::copy(out.join(file), &path).map_err(|e| format!("{}: {e}", path.display()))?;
    }
    Ok(())
}

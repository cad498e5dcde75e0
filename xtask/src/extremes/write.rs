//! The table of extremes as CSV and as Markdown.

use super::cases::row::Row;
use std::fs;
use std::path::Path;

/// Writes `extremes.csv`.
pub(super) fn csv(rows: &[Row], out: &Path) -> Result<(), String> {
    let path = out.join("extremes.csv");
    let failed = |e: csv::Error| format!("{}: {e}", path.display());
    let mut writer = csv::Writer::from_path(&path).map_err(failed)?;
    writer
        .write_record(["varied", "case", "is_sound", "outcome"])
        .map_err(failed)?;
    for row in rows {
        let is_sound = row.outcome.is_sound().to_string();
        let fields = [row.varied, &row.case, &is_sound, &row.outcome.words()];
        writer.write_record(fields).map_err(failed)?;
    }
    writer
        .flush()
        .map_err(|e| format!("{}: {e}", path.display()))
}

/// Writes `extremes.md`: a table for each number that was varied.
pub(super) fn markdown(rows: &[Row], out: &Path) -> Result<(), String> {
    let groups = rows.chunk_by(|a, b| a.varied == b.varied);
    let text: String = groups.map(table).collect();
    let path = out.join("extremes.md");
    fs::write(&path, text).map_err(|e| format!("{}: {e}", path.display()))
}

/// Heading and table of the rows of one number.
fn table(rows: &[Row]) -> String {
    let line = |row: &Row| {
        let outcome = row.outcome.words().replace('|', "\\|").replace('\n', " ");
        format!("| {} | {outcome} |\n", row.case)
    };
    let lines: String = rows.iter().map(line).collect();
    let varied = rows.first().map_or("", |row| row.varied);
    format!("\n### {varied}\n\n| case | outcome |\n|---|---|\n{lines}")
}

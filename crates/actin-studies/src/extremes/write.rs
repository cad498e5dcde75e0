//! Output of the table as CSV and Markdown.

use super::row::Row;
use actin_draw::report::{save, write_csv};
use std::fmt::Write as _;
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
    write_csv(out, "extremes.csv", &header, cells)?;
    save(out, "extremes.md", &tables(rows))
}

pub(super) fn document(rows: &[Row], out: &Path, docs: &Path) -> Result<(), String> {
    save(
        docs,
        "tables/extremes.md",
        &(HEAD.to_owned() + &tables(rows)),
    )?;
    for picture in ["extremes-limits.svg", "extremes-energy.svg"] {
        let path = docs.join(picture);
        fs::copy(out.join(picture), &path).map_err(|e| format!("{}: {e}", path.display()))?;
    }
    Ok(())
}

const HEAD: &str = "# Extremes, case by case

Computed by `cargo xtask extremes --long --write`; the short rows are tests (`cargo test -p actin-studies
extremes`). [Extremes](../extremes.md) says what they show.
";

fn tables(rows: &[Row]) -> String {
    let mut text = String::new();
    for group in rows.chunk_by(|a, b| a.varied == b.varied) {
        let varied = group[0].varied;
        _ = writeln!(text, "\n### {varied}\n\n| case | outcome |\n|---|---|");
        for row in group {
            let outcome = row.outcome.words().replace('|', "\\|").replace('\n', " ");
            _ = writeln!(text, "| {} | {outcome} |", row.case);
        }
    }
    text
}

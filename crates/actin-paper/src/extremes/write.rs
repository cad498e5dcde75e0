//! The table of extremes as CSV and as Markdown.

use super::row::Row;
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
    save(&out.join("extremes.md"), &tables(rows))
}

/// Replaces the tables and the pictures of the document by those of `rows` and in `out`.
pub(super) fn document(rows: &[Row], out: &Path, docs: &Path) -> Result<(), String> {
    let path = docs.join(DOCUMENT);
    let text = fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    let text = with_tables(&text, &tables(rows)).map_err(|e| format!("{}: {e}", path.display()))?;
    save(&path, &text)?;
    for picture in PICTURES {
        let path = docs.join(picture);
        fs::copy(out.join(picture), &path).map_err(|e| format!("{}: {e}", path.display()))?;
    }
    Ok(())
}

/// The page that holds the tables, and its pictures.
const DOCUMENT: &str = "tables/extremes.md";
const PICTURES: [&str; 2] = ["extremes-limits.svg", "extremes-energy.svg"];

/// Lines between which the tables stand in the document.
const BEGIN: &str = "<!-- written by cargo xtask extremes --long --write: begin -->\n";
const END: &str = "<!-- written by cargo xtask extremes --long --write: end -->\n";

/// The document with other tables between its marks.
fn with_tables(document: &str, tables: &str) -> Result<String, String> {
    let parts = document.split_once(BEGIN);
    let parts = parts.and_then(|(before, rest)| Some((before, rest.split_once(END)?.1)));
    let (before, after) = parts.ok_or("the marks of the tables are missing")?;
    if [before, after]
        .iter()
        .any(|part| part.contains(BEGIN.trim()) || part.contains(END.trim()))
    {
        return Err("the marks of the tables stand there twice".to_owned());
    }
    Ok([before, BEGIN, tables, "\n", END, after].concat())
}

fn save(path: &Path, text: &str) -> Result<(), String> {
    fs::write(path, text).map_err(|e| format!("{}: {e}", path.display()))
}

/// A table for each number that was varied.
fn tables(rows: &[Row]) -> String {
    rows.chunk_by(|a, b| a.varied == b.varied)
        .map(table)
        .collect()
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::workspace_root;

    /// The page can be written anew: between its marks stand its tables, all of them, and nothing
    /// else does.
    #[test]
    fn the_page_has_its_marks_around_its_tables() {
        let text = fs::read_to_string(workspace_root().join("docs").join(DOCUMENT)).unwrap();
        let inside = text.split_once(BEGIN).unwrap().1.split_once(END).unwrap().0;
        assert_eq!(
            with_tables(&text, inside.strip_suffix('\n').unwrap()),
            Ok(text.clone())
        );
        let emptied = with_tables(&text, "").unwrap();
        assert!(!emptied.contains("| case | outcome |"));
        for line in inside.lines() {
            let is_table = line.is_empty() || line.starts_with("### ") || line.starts_with('|');
            assert!(is_table, "{line}");
        }
    }

    #[test]
    fn marks_that_are_missing_or_there_twice_are_errors() {
        let page = format!("a\n{BEGIN}old\n{END}b\n");
        let expected = format!("a\n{BEGIN}new\n\n{END}b\n");
        assert_eq!(with_tables(&page, "new\n"), Ok(expected));
        assert!(with_tables(&page.replace(END, ""), "").is_err());
        assert!(with_tables(&page.replace(BEGIN, ""), "").is_err());
        assert!(with_tables(&[page.as_str(), BEGIN].concat(), "").is_err());
    }
}

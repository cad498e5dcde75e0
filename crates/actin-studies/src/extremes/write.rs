//! The table of extremes as CSV and as Markdown.

use super::row::Row;
use actin_draw::report::{save, write_csv};
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

/// Writes `extremes.csv`, and `extremes.md` with a table for each number that was varied.
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

/// Replaces the tables and the pictures of the document by those of `rows` and in `out`.
pub(super) fn document(rows: &[Row], out: &Path, docs: &Path) -> Result<(), String> {
    let path = docs.join(DOCUMENT);
    let text = fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    let text = with_tables(&text, &tables(rows)).map_err(|e| format!("{}: {e}", path.display()))?;
    save(docs, DOCUMENT, &text)?;
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

/// A table for each number that was varied.
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

#[cfg(test)]
mod tests {
    use super::*;
    use actin_paper::workspace_root;

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

//! Tables as Markdown and CSV, and their places in the page.

use actin_draw::report::{save, write_csv};
use std::path::Path;

/// A table of texts.
#[derive(Clone, Debug)]
pub(super) struct Listing {
    /// Names of the columns.
    pub header: Vec<&'static str>,
    pub rows: Vec<Vec<String>>,
}

impl Listing {
    /// As Markdown, with the first column to the left and numbers to the right.
    pub(super) fn markdown(&self) -> String {
        let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
        let header: Vec<String> = self.header.iter().map(ToString::to_string).collect();
        let rule = self.header.iter().enumerate();
        let rule: Vec<String> = rule
            .map(|(i, _)| if i == 0 { "---" } else { "---:" }.to_owned())
            .collect();
        let rows: String = self.rows.iter().map(|row| line(row)).collect();
        [line(&header), line(&rule), rows].concat()
    }

    /// As `bonds_NAME.csv`.
    pub(super) fn write_csv(&self, out: &Path, name: &str) -> Result<(), String> {
        let name = format!("bonds_{name}.csv");
        write_csv(out, &name, &self.header, self.rows.clone())
    }
}

/// Replaces the table of a name in the document.
pub(super) fn replace(document: &Path, name: &str, table: &str) -> Result<(), String> {
    let fail = |e: &dyn std::fmt::Display| format!("{}: {e}", document.display());
    let text = std::fs::read_to_string(document).map_err(|e| fail(&e))?;
    let text = with_table(&text, name, table).map_err(|e| fail(&e))?;
    let folder = document.parent().unwrap_or(Path::new("."));
    save(folder, "bonds.md", &text)
}

/// The text with another table between the marks of a name.
fn with_table(text: &str, name: &str, table: &str) -> Result<String, String> {
    let mark =
        |end: &str| format!("<!-- written by cargo xtask bonds --write: {name}: {end} -->\n");
    let (begin, end) = (mark("begin"), mark("end"));
    let parts = text.split_once(&begin);
    let parts = parts.and_then(|(before, rest)| Some((before, rest.split_once(&end)?.1)));
    let (before, after) = parts.ok_or_else(|| format!("the marks of {name} are missing"))?;
    Ok([before, &begin, table, &end, after].concat())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_take_each_others_place() {
        let listing = Listing {
            header: vec!["bonds", "B3"],
            rows: vec![vec!["12 weighted".into(), "1.5 %".into()]],
        };
        let table = listing.markdown();
        assert_eq!(
            table,
            "| bonds | B3 |\n| --- | ---: |\n| 12 weighted | 1.5 % |\n"
        );
        let text = "a\n<!-- written by cargo xtask bonds --write: heat: begin -->\nold\n\
                    <!-- written by cargo xtask bonds --write: heat: end -->\nb\n";
        let once = with_table(text, "heat", &table).unwrap();
        assert!(once.contains("12 weighted") && !once.contains("old"));
        assert_eq!(with_table(&once, "heat", &table).as_ref(), Ok(&once));
        assert!(with_table(text, "motion", &table).is_err());
    }
}

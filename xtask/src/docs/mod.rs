//! `cargo xtask check-docs`: numbers in the documents against a report.
//!
//! A number that is followed by a mark, `36.74 <!-- fig8:height/over/180/rod-140 -->`, must be what
//! the report holds under that name, to the digits shown; `marks.rs` says how marks are written. Where
//! a number has no mark, the text says so (`unmarked.rs`). Whether the report itself is up to date a test
//! of `actin-paper` finds with a quick run.

mod marks;
mod number;
mod unmarked;

use crate::command::workspace_root;
use actin_draw::report;
use actin_paper::committed::{REFERENCE, Report, by_name};
use marks::{Mark, Of, marks};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Documents whose marks are checked.
const DOCUMENTS: [&str; 2] = ["docs/validation.md", "docs/errata.md"];
/// The document in which numbers without a mark are counted.
const COUNTED: &str = "docs/validation.md";

/// Which report, and what is done about differences.
#[derive(clap::Args, Debug)]
pub(crate) struct Options {
    /// The report; that in `docs` by default.
    report: Option<PathBuf>,
    /// Takes the artefacts of the report over into that in `docs`, and writes its numbers into the
    /// documents.
    #[arg(long)]
    write: bool,
}

/// Checks the documents, or brings them up to date.
pub(crate) fn run(options: &Options) -> Result<(), String> {
    let root = workspace_root();
    let mut rows = by_name(report::read(&root.join(REFERENCE))?);
    if let Some(path) = &options.report {
        let others = by_name(report::read(path)?);
        let theirs: BTreeSet<String> = others.keys().map(|name| name.0.clone()).collect();
        rows.retain(|(artefact, _), _| !theirs.contains(artefact));
        rows.extend(others);
    }
    if options.write {
        let text = report::text(rows.values().cloned().collect())?;
        save(&root.join(REFERENCE), &text)?;
        for name in DOCUMENTS {
            let path = root.join(name);
            let text = read(&path)?;
            save(&path, &updated(name, &text, &rows)?)?;
        }
    }
    let (checked, findings) = findings(&root, &rows)?;
    if findings.is_empty() {
        println!("{checked} numbers agree with the report");
        return Ok(());
    }
    Err(format!("documents:\n  {}", findings.join("\n  ")))
}

/// How many numbers are marked in the documents, and those that are not what the report holds.
fn findings(root: &Path, rows: &Report) -> Result<(usize, Vec<String>), String> {
    let (mut checked, mut all) = (0, Vec::new());
    for name in DOCUMENTS {
        let text = read(&root.join(name))?;
        let marks = marks(name, &text)?;
        checked += marks.len();
        all.extend(marks.iter().filter_map(|mark| finding(name, mark, rows)));
        if name == COUNTED {
            all.extend(unmarked::findings(name, &text, &marks));
        }
    }
    Ok((checked, all))
}

fn finding(document: &str, mark: &Mark, rows: &Report) -> Option<String> {
    let place = format!("{document}:{}: {}", mark.line, mark.name());
    match expected(mark, rows) {
        Err(error) => Some(format!("{place}: {error}")),
        Ok(text) if text != mark.shown => Some(format!(
            "{place} reads {}, the report says {text}",
            mark.shown
        )),
        Ok(_) => None,
    }
}

/// What the document should read at a mark.
fn expected(mark: &Mark, rows: &Report) -> Result<String, String> {
    let row = rows
        .get(&(mark.artefact.clone(), mark.quantity.clone()))
        .ok_or("no such row in the report")?;
    let number = |value: f64| number::like(&mark.shown, value / mark.unit);
    match mark.of {
        Of::Ours => Ok(number(row.ours)),
        Of::Paper => Ok(number(row.paper.ok_or("the paper gives nothing")?)),
        Of::Verdict => {
            let pass = row.pass.ok_or("there is no verdict")?;
            Ok(if pass { "yes" } else { "no" }.to_owned())
        }
    }
}

/// The document with the report's numbers at its marks.
fn updated(name: &str, text: &str, rows: &Report) -> Result<String, String> {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    // From the last to the first, so that places before stay where they are.
    for mark in marks(name, text)?.iter().rev() {
        let place = mark.start..mark.start + mark.shown.len();
        let text =
            expected(mark, rows).map_err(|e| format!("{name}:{}: {}: {e}", mark.line, mark.name()));
        lines[mark.line - 1].replace_range(place, &text?);
    }
    Ok(lines.join("\n") + "\n")
}

fn read(path: &Path) -> Result<String, String> {
    fs::read_to_string(path).map_err(|e| format!("{}: {e}", path.display()))
}

fn save(path: &Path, text: &str) -> Result<(), String> {
    fs::write(path, text).map_err(|e| format!("{}: {e}", path.display()))
}

#[cfg(test)]
mod tests;

//! `cargo xtask docs`: generated pages of the book (keys of scenes, tables of results, mistakes), and a limit on the
//! length of other pages.

mod mistakes;
mod scenes;
mod tables;
mod words;

use actin_draw::report;
use actin_paper::committed::{REFERENCE, by_name};
use actin_paper::workspace_root;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Largest number of words of pages that are not generated.
const MOST_WORDS: usize = 15_000;

#[derive(clap::Args, Debug)]
pub(crate) struct Options {
    /// Report of `reproduce-figures` whose artefacts replace those in `docs/report.json`.
    #[arg(requires = "write")]
    report: Option<PathBuf>,
    /// Writes the generated pages.
    #[arg(long)]
    write: bool,
    /// Prints the number of words of every page that is not generated.
    #[arg(long)]
    words: bool,
}

pub(crate) fn run(options: &Options) -> Result<(), String> {
    let root = workspace_root();
    if let Some(path) = &options.report {
        take_over(&root, path)?;
    }
    if options.write {
        for (page, text) in generated(&root)? {
            save(&root.join(page), &text)?;
        }
    }
    let counts = words::by_hand(&root)?;
    if options.words {
        for (page, count) in &counts {
            println!("{count:6} {page}");
        }
    }
    let all: usize = counts.iter().map(|(_, count)| count).sum();
    println!("{all} words written by hand, at most {MOST_WORDS}");
    let findings = findings(&root)?;
    if findings.is_empty() {
        return Ok(());
    }
    Err(findings.join("\n  "))
}

/// Returns outdated generated pages, and an excess of words.
///
/// # Errors
/// If a file cannot be read.
pub(crate) fn findings(root: &Path) -> Result<Vec<String>, String> {
    let mut all = Vec::new();
    for (page, text) in generated(root)? {
        if fs::read_to_string(root.join(&page)).ok().as_ref() != Some(&text) {
            all.push(format!("{page} is stale: cargo xtask docs --write"));
        }
    }
    let counts = words::by_hand(root)?.into_iter();
    let words: usize = counts.map(|(_, count)| count).sum();
    if words > MOST_WORDS {
        all.push(format!(
            "{words} words written by hand, at most {MOST_WORDS}: cargo xtask docs --words"
        ));
    }
    Ok(all)
}

fn generated(root: &Path) -> Result<BTreeMap<String, String>, String> {
    let mut files = scenes::files();
    files.extend(mistakes::file(root)?);
    files.extend(tables::files(&report::read(&root.join(REFERENCE))?));
    Ok(files)
}

fn take_over(root: &Path, report: &Path) -> Result<(), String> {
    let mut rows = by_name(report::read(&root.join(REFERENCE))?);
    let others = by_name(report::read(report)?);
    let theirs: BTreeSet<String> = others.keys().map(|name| name.0.clone()).collect();
    rows.retain(|(artefact, _), _| !theirs.contains(artefact));
    rows.extend(others);
    let text = report::text(rows.into_values().collect())?;
    save(&root.join(REFERENCE), &text)
}

fn save(path: &Path, text: &str) -> Result<(), String> {
    fs::write(path, text).map_err(|e| format!("{}: {e}", path.display()))
}

//! Comparison of the rows of a run with the committed reports in `docs`.
//!
//! `report.json` is from a full run and the source of the documents. `report-quick.json` is from a quick run, which a
//! test repeats. Numbers that both runs compute from the same scenes and settings are compared with both files.

use crate::{ProgressSink, figures, workspace_root};
use actin_draw::report::{self, Row, save};
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

/// Report of a full run, relative to the workspace root.
pub const REFERENCE: &str = "docs/report.json";
/// Report of a quick run.
const QUICK: &str = "docs/report-quick.json";

/// Relative tolerance. The stopping residual of 1e-7 pN determines tips, energies and torques to 2e-8. Replacing
/// AVX-512 by AVX2 in all libraries changes rows outside `sensitive.csv` by less than 1e-7.
const AGREES: f64 = 1e-6;
/// Tolerance of fitted parameters in standard errors. Such a step changes the sum of squares by 1e-6 of its variance.
const AGREES_IN_STANDARD_ERRORS: f64 = 1e-3;
const MOST_LISTED: usize = 20;

/// Rows by artefact and quantity.
pub(crate) type Report = BTreeMap<(String, String), Row>;

/// Group of rows that rounding changes by more than [`AGREES`].
#[derive(Debug, Deserialize)]
struct RoundingSensitivity {
    artefact: String,
    part: String,
    /// Relative tolerance; `None` if the rows are not compared.
    share: Option<f64>,
    also_rods: bool,
}

static SENSITIVE: LazyLock<Vec<RoundingSensitivity>> =
    LazyLock::new(|| crate::published::table(include_str!("../data/sensitive.csv")));

/// Indexes rows by artefact and quantity.
pub fn by_name(rows: Vec<Row>) -> Report {
    let named = rows.into_iter();
    named.map(|row| (name(&row), row)).collect()
}

fn name(row: &Row) -> (String, String) {
    (row.artefact.to_owned(), row.quantity.clone())
}

/// Lists differences from the committed rows and, for a full run, misses without an explanation.
///
/// # Errors
/// A committed report cannot be read.
pub fn compare(rows: &[Row], quick: bool, tell: ProgressSink<'_>) -> Result<(), String> {
    let lines = if quick {
        stale(rows)?
    } else {
        CommittedReport::full()?.differences(rows)
    };
    tell(format_args!(
        "{} rows differ from the committed ones",
        lines.len()
    ));
    let mut lines: Vec<String> = lines.into_iter().take(MOST_LISTED).collect();
    if !quick {
        lines.extend(figures::unexplained(rows));
    }
    for line in lines {
        tell(format_args!("  {line}"));
    }
    Ok(())
}

/// Replaces the artefacts of a quick run in `docs/report-quick.json`. Notes are omitted, because they are not compared.
///
/// # Errors
/// The report cannot be read or written.
pub fn write_quick(rows: &[Row], tell: ProgressSink<'_>) -> Result<(), String> {
    let root = workspace_root();
    let mut all = if root.join(QUICK).exists() {
        CommittedReport::quick()?.rows
    } else {
        Report::new()
    };
    let ours: BTreeSet<&str> = rows.iter().map(|row| row.artefact).collect();
    all.retain(|(artefact, _), _| !ours.contains(artefact.as_str()));
    let without_notes = rows.iter().map(|row| Row {
        note: String::new(),
        ..row.clone()
    });
    all.extend(by_name(without_notes.collect()));
    tell(format_args!("written: {QUICK}"));
    save(&root, QUICK, &report::text(all.into_values().collect())?)
}

/// Differences of a quick run from both committed reports, one line each.
pub(crate) fn stale(rows: &[Row]) -> Result<Vec<String>, String> {
    let mut all = CommittedReport::quick()?.differences(rows);
    let shared: Vec<Row> = rows.iter().filter(|row| is_in_full(row)).cloned().collect();
    all.extend(CommittedReport::full()?.changes(&shared));
    Ok(all)
}

struct CommittedReport {
    file: &'static str,
    command: &'static str,
    rows: Report,
}

impl CommittedReport {
    fn quick() -> Result<Self, String> {
        Self::read(QUICK, "cargo xtask reproduce-figures --quick --write")
    }

    fn full() -> Result<Self, String> {
        let command =
            "cargo xtask reproduce-figures && cargo xtask docs target/figures/report.json --write";
        Self::read(REFERENCE, command)
    }

    fn read(file: &'static str, command: &'static str) -> Result<Self, String> {
        let rows = by_name(report::read(&workspace_root().join(file))?);
        Ok(Self {
            file,
            command,
            rows,
        })
    }

    /// New, changed and missing rows of the artefacts of a run.
    fn differences(&self, rows: &[Row]) -> Vec<String> {
        let mut all = self.changes(rows);
        let artefacts: BTreeSet<&str> = rows.iter().map(|row| row.artefact).collect();
        let ours: BTreeSet<_> = rows.iter().map(name).collect();
        let gone = self.rows.iter().filter(|(name, _)| !ours.contains(*name));
        let gone = gone.filter(|(name, _)| artefacts.contains(name.0.as_str()));
        all.extend(gone.map(|(_, row)| self.line(row, &format!("is in {} only", self.file))));
        all
    }

    fn changes(&self, rows: &[Row]) -> Vec<String> {
        let compared = rows.iter().filter(|row| agreement(row).is_some());
        let changed = compared.filter_map(|row| {
            let what = match self.rows.get(&name(row)) {
                None => Some(format!("is not in {}", self.file)),
                Some(old) => self.change(row, old),
            };
            what.map(|what| self.line(row, &what))
        });
        changed.collect()
    }

    fn line(&self, row: &Row, what: &str) -> String {
        let (artefact, quantity, command) = (row.artefact, &row.quantity, self.command);
        format!("{artefact}:{quantity} {what}; to accept the change, run: {command}")
    }

    /// Description of a difference in number, expected number or verdict.
    fn change(&self, row: &Row, old: &Row) -> Option<String> {
        let (share, file) = (agreement(row)?, self.file);
        let flat = AGREES_IN_STANDARD_ERRORS * old.standard_error.unwrap_or(0.0);
        let floor = floor(row.unit).max(flat);
        let differs =
            |a: f64, b: f64| (a - b).abs() > f64::max(share * a.abs().max(b.abs()), floor);
        let expected = match row.paper.zip(old.paper) {
            Some((a, b)) => differs(a, b),
            None => row.paper != old.paper,
        };
        if differs(row.ours, old.ours) {
            Some(format!("is {}, in {file} {}", row.ours, old.ours))
        } else if expected {
            Some(format!(
                "expects {:?}, in {file} {:?}",
                row.paper, old.paper
            ))
        } else {
            let words = || format!("has the verdict {:?}, in {file} {:?}", row.pass, old.pass);
            (row.pass != old.pass).then(words)
        }
    }
}

/// Absolute tolerance by unit: effect of a residual of 1e-7 pN on a zero.
fn floor(unit: &str) -> f64 {
    match unit {
        "nm" | "pN" | "pN nm" | "deg" => 1e-6,
        _ => 1e-9,
    }
}

/// Index of the first matching entry of [`SENSITIVE`].
fn entry(row: &Row) -> Option<usize> {
    let is_rod = row.quantity.ends_with("/rod");
    SENSITIVE.iter().position(|entry| {
        let is_exempt = is_rod && !entry.also_rods;
        entry.artefact == row.artefact && row.quantity.contains(&entry.part) && !is_exempt
    })
}

/// Relative tolerance of a row; `None` if rounding selects the state.
fn agreement(row: &Row) -> Option<f64> {
    entry(row).map_or(Some(AGREES), |entry| SENSITIVE[entry].share)
}

/// True for rows that full and quick runs compute from the same scene and settings: parameters, fits to rows of the
/// paper, pure rods, and single filaments of the first sampling.
fn is_in_full(row: &Row) -> bool {
    let quantity = row.quantity.as_str();
    let is_rod = quantity.ends_with("/rod");
    let is_mean = quantity.contains("mean-filament");
    match row.artefact {
        "table1" | "table2" => true,
        "fig9" => !quantity.contains("monomers"),
        "table3" | "table5" => {
            is_mean || quantity.contains("/seed-0/") || quantity == "printed_length"
        }
        "table4" => is_mean || quantity.starts_with("printed/") || quantity.starts_with("s_p"),
        "fig5" | "fig6" => quantity.starts_with("energy/"),
        "fig7" | "fig8" | "fig10" => is_rod && agreement(row).is_some(),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(artefact: &'static str, quantity: &str, ours: f64) -> Row {
        Row::measured(artefact, quantity, "nm", ours, "")
    }

    fn committed(rows: Vec<Row>) -> CommittedReport {
        CommittedReport {
            rows: by_name(rows),
            ..CommittedReport::quick().unwrap()
        }
    }

    #[test]
    fn changes_are_listed() {
        let height = row("fig8", "height/rod", 39.4).with_paper_value(39.0, 1.0);
        let reference = committed(vec![height.clone(), row("fig8", "force", 16.0)]);
        let moved = |ours: f64, tolerance| {
            let height = row("fig8", "height/rod", ours).with_paper_value(39.0, tolerance);
            reference.differences(&[height, row("fig8", "force", 16.0)])
        };
        assert_eq!(moved(39.4 * (1.0 + 1e-8), 1.0), [""; 0]);
        let (file, command) = (reference.file, reference.command);
        let line = format!(
            "fig8:height/rod is 39.401, in {file} 39.4; to accept the change, run: {command}"
        );
        assert_eq!(moved(39.401, 1.0), [line]);
        assert_eq!(moved(39.4, 0.1).len(), 1);
        assert_eq!(
            reference.differences(std::slice::from_ref(&height)).len(),
            1
        );
        let more = [height, row("fig8", "force", 16.0), row("fig8", "new", 1.0)];
        assert_eq!(reference.differences(&more).len(), 1);
    }

    #[test]
    fn rounding_differences_are_tolerated() {
        let count = |artefact, quantity: &str, old, new| {
            let reference = committed(vec![row(artefact, quantity, old)]);
            reference.differences(&[row(artefact, quantity, new)]).len()
        };
        assert_eq!(count("fig8", "order_difference", 1e-10, 3e-10), 0);
        assert_eq!(count("fig8", "height", 10.0, 10.0002), 1);
        assert_eq!(count("fig6", "node_spread", 10.0, 10.002), 0);
        assert_eq!(count("fig10", "height/over/270/rod-40", 28.8, 29.2), 0);
        assert_eq!(count("fig10", "height/over/270/rod", 28.8, 29.2), 0);
        assert_eq!(count("fig8", "height/under/180/rod-40", 28.8, 29.2), 0);
        assert_eq!(count("fig8", "height/under/180/rod", 28.8, 29.2), 1);
        assert_eq!(count("fig10", "height/under/270/rod-40", 28.8, 29.2), 1);
    }

    /// Guards against outdated entries and against entries that match additional rows.
    #[test]
    fn sensitive_entries_match_known_numbers_of_rows() {
        let committed = report::read(&workspace_root().join(QUICK)).unwrap();
        let of_entry = |i| committed.iter().filter(|row| entry(row) == Some(i)).count();
        let counts: Vec<usize> = (0..SENSITIVE.len()).map(of_entry).collect();
        assert_eq!(
            counts,
            [
                0, 68, 8, 46, 37, 4, 4, 29, 2, 1, 1, 15, 16, 57, 23, 8, 63, 3, 3, 4, 2, 17, 8, 2
            ]
        );
    }

    #[test]
    fn quick_run_is_compared_with_full_report() {
        let reference = committed(vec![row("fig7", "turn/rod", 5.285)]);
        assert_eq!(
            reference.changes(&[row("fig7", "turn/rod", 5.286)]).len(),
            1
        );
        let committed = report::read(&workspace_root().join(QUICK)).unwrap();
        for artefact in [
            "table1", "table3", "table4", "table5", "fig5", "fig6", "fig7", "fig8", "fig9", "fig10",
        ] {
            let own = committed.iter().filter(|row| row.artefact == artefact);
            assert!(own.filter(|row| is_in_full(row)).count() >= 4, "{artefact}");
        }
    }
}

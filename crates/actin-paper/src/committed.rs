//! Rows of a run compared with the committed reports in `docs`: `report.json` of a full run, the source of the
//! documents, and `report-quick.json` of a quick run, which a test computes again. Numbers that both runs compute
//! from the same scenes and settings are compared with both files, so that neither becomes stale unnoticed.

use crate::{Tell, figures, workspace_root};
use actin_draw::report::{self, Row, save};
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

/// The report of a full run, below the folder of the workspace.
pub const REFERENCE: &str = "docs/report.json";
/// The report of a quick run.
const QUICK: &str = "docs/report-quick.json";

/// Rows agree within this share: a residual of 1e-7 pN, the stop rule of all equilibria, determines tips, energies and
/// couples to 2e-8. With AVX2 instead of AVX-512 in all libraries no row that is not sensitive moves by more than 1e-7.
const AGREES: f64 = 1e-6;
/// Fitted parameters agree within this share of their standard error: such a step changes the sum of squares by
/// 1e-6 of its variance, so the fitted curve is the same.
const AGREES_IN_STANDARD_ERRORS: f64 = 1e-3;
/// Most differences that are listed.
const MOST_LISTED: usize = 20;

/// Rows by artefact and quantity.
pub type Report = BTreeMap<(String, String), Row>;

/// Rows that rounding moves further than [`AGREES`].
#[derive(Debug, Deserialize)]
struct Sensitive {
    artefact: String,
    /// Part of the quantity.
    part: String,
    /// The share within which the rows agree; `None` if they are not compared.
    share: Option<f64>,
    /// Pure rods are included.
    also_rods: bool,
}

static SENSITIVE: LazyLock<Vec<Sensitive>> =
    LazyLock::new(|| crate::published::table(include_str!("../data/sensitive.csv")));

/// Rows under their names.
pub fn by_name(rows: Vec<Row>) -> Report {
    let named = rows.into_iter();
    named.map(|row| (name(&row), row)).collect()
}

fn name(row: &Row) -> (String, String) {
    (row.artefact.to_owned(), row.quantity.clone())
}

/// Lists differences of a run's rows from the committed ones, and, of a full run, misses without an explanation;
/// neither is an error.
///
/// # Errors
/// A committed report that cannot be read.
pub fn compare(rows: &[Row], quick: bool, tell: Tell<'_>) -> Result<(), String> {
    let lines = if quick {
        stale(rows)?
    } else {
        Committed::full()?.differences(rows)
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

/// Takes the artefacts of a quick run over into `docs/report-quick.json`. Notes are dropped: they are long
/// and not compared.
///
/// # Errors
/// A file that cannot be read or written.
pub fn write_quick(rows: &[Row], tell: Tell<'_>) -> Result<(), String> {
    let root = workspace_root();
    let mut all = if root.join(QUICK).exists() {
        Committed::quick()?.rows
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

/// Differences of a quick run from the committed files, a line each.
pub(crate) fn stale(rows: &[Row]) -> Result<Vec<String>, String> {
    let mut all = Committed::quick()?.differences(rows);
    let shared: Vec<Row> = rows.iter().filter(|row| is_in_full(row)).cloned().collect();
    all.extend(Committed::full()?.changes(&shared));
    Ok(all)
}

/// A committed report.
struct Committed {
    file: &'static str,
    /// Brings it up to date.
    command: &'static str,
    rows: Report,
}

impl Committed {
    fn quick() -> Result<Self, String> {
        Self::read(QUICK, "cargo xtask reproduce-figures --quick --write")
    }

    fn full() -> Result<Self, String> {
        let command =
            "cargo xtask reproduce-figures && cargo xtask docs target/figures/report.json --write";
        Self::read(REFERENCE, command)
    }

    fn read(file: &'static str, command: &'static str) -> Result<Self, String> {
        let rows = report::read(&workspace_root().join(file))?;
        Ok(Self {
            file,
            command,
            rows: by_name(rows),
        })
    }

    /// New and changed rows, and rows that are gone from the artefacts of a run.
    fn differences(&self, rows: &[Row]) -> Vec<String> {
        let mut all = self.changes(rows);
        let artefacts: BTreeSet<&str> = rows.iter().map(|row| row.artefact).collect();
        let ours: BTreeSet<_> = rows.iter().map(name).collect();
        let gone = self.rows.iter().filter(|(name, _)| !ours.contains(*name));
        let gone = gone.filter(|(name, _)| artefacts.contains(name.0.as_str()));
        all.extend(gone.map(|(_, row)| self.line(row, &format!("is in {} only", self.file))));
        all
    }

    /// New and changed rows.
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
        let Row {
            artefact, quantity, ..
        } = row;
        format!(
            "{artefact}:{quantity} {what}; if that is meant: {}",
            self.command
        )
    }

    /// Number, expected number or verdict that differs, with both values.
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

/// Smallest difference that counts, by unit: what a residual of 1e-7 pN leaves of a zero.
fn floor(unit: &str) -> f64 {
    match unit {
        "nm" | "pN" | "pN nm" | "deg" => 1e-6,
        _ => 1e-9,
    }
}

/// Index of the first entry of [`SENSITIVE`] that matches a row.
fn entry(row: &Row) -> Option<usize> {
    let is_rod = row.quantity.ends_with("/rod");
    SENSITIVE.iter().position(|entry| {
        let is_exempt = is_rod && !entry.also_rods;
        entry.artefact == row.artefact && row.quantity.contains(&entry.part) && !is_exempt
    })
}

/// The share within which a row agrees on every machine; `None` if rounding selects the state.
fn agreement(row: &Row) -> Option<f64> {
    entry(row).map_or(Some(AGREES), |entry| SENSITIVE[entry].share)
}

/// True if a full run computes the number of a quick run from the same scene and settings: parameters, fits of the
/// paper's rows, pure rods, and single filaments of the first sampling.
fn is_in_full(row: &Row) -> bool {
    let quantity = row.quantity.as_str();
    let is_rod = quantity.ends_with("/rod");
    // The mean filament is one, however many samplings there are.
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

    fn committed(rows: Vec<Row>) -> Committed {
        Committed {
            rows: by_name(rows),
            ..Committed::quick().unwrap()
        }
    }

    /// A number that moves by more than rounding, a row that comes or goes, another verdict is a difference. The
    /// line names row, both values and command.
    #[test]
    fn changes_are_listed() {
        let height = row("fig8", "height/rod", 39.4).against(39.0, 1.0);
        let reference = committed(vec![height.clone(), row("fig8", "force", 16.0)]);
        let moved = |ours: f64, tolerance| {
            let height = row("fig8", "height/rod", ours).against(39.0, tolerance);
            reference.differences(&[height, row("fig8", "force", 16.0)])
        };
        assert_eq!(moved(39.4 * (1.0 + 1e-8), 1.0), [""; 0]);
        let (file, command) = (reference.file, reference.command);
        let line =
            format!("fig8:height/rod is 39.401, in {file} 39.4; if that is meant: {command}");
        assert_eq!(moved(39.401, 1.0), [line]);
        assert_eq!(moved(39.4, 0.1).len(), 1);
        assert_eq!(
            reference.differences(std::slice::from_ref(&height)).len(),
            1
        );
        let more = [height, row("fig8", "force", 16.0), row("fig8", "new", 1.0)];
        assert_eq!(reference.differences(&more).len(), 1);
    }

    /// Zeros may differ by the effect of a residual, free filaments by more; states that rounding selects are not compared.
    #[test]
    fn rounding_is_allowed_for() {
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

    /// An entry without a row is outdated; one that matches more than before loosens rows without a reason.
    #[test]
    fn each_exception_is_needed() {
        let committed = report::read(&workspace_root().join(QUICK)).unwrap();
        let of_entry = |i| committed.iter().filter(|row| entry(row) == Some(i)).count();
        let counts: Vec<usize> = (0..SENSITIVE.len()).map(of_entry).collect();
        assert_eq!(
            counts,
            [
                133, 142, 16, 108, 98, 16, 4, 78, 2, 1, 1, 15, 16, 57, 23, 8, 63, 3, 3, 4, 2, 17,
                8, 2
            ]
        );
    }

    /// A quick run has rows that the full report has, too, and they are compared.
    #[test]
    fn the_full_report_cannot_go_stale() {
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

//! Rows of a run against those that are committed in `docs`: `report.json` of a full run, which the
//! documents are held to, and `report-quick.json`, which a test computes again (`quick.rs`).

mod quick;

#[cfg(test)]
pub(crate) use quick::stale;

use crate::{Tell, figures, workspace_root};
use actin_draw::report::{self, Row};
use std::collections::{BTreeMap, BTreeSet};

/// The report of a full run, below the folder of the workspace.
pub const REFERENCE: &str = "docs/report.json";
/// Rows of two reports agree within this share: what another processor's rounding leaves.
const AGREES: f64 = 1e-6;
/// Most differences that are told one by one.
const MOST_TOLD: usize = 20;

/// Rows by artefact and quantity.
pub type Report = BTreeMap<(String, String), Row>;

/// Rows under their names.
pub fn by_name(rows: Vec<Row>) -> Report {
    let named = rows.into_iter();
    named
        .map(|row| ((row.artefact.to_owned(), row.quantity.clone()), row))
        .collect()
}

/// Tells how the rows of a full run differ from the committed ones, and misses without an explanation;
/// neither is an error.
///
/// # Errors
/// A committed report that cannot be read.
pub fn compare_full(rows: &[Row], tell: Tell<'_>) -> Result<(), String> {
    let reference = by_name(report::read(&workspace_root().join(REFERENCE))?);
    let differences = differences(rows, &reference);
    tell(format_args!(
        "{} of {} rows differ from {REFERENCE} by more than {AGREES:e} of their value",
        differences.len(),
        rows.len()
    ));
    list(&differences, tell);
    for line in figures::unexplained(rows) {
        tell(format_args!("  {line}"));
    }
    Ok(())
}

/// Tells how the rows of a quick run differ from the committed ones, which is no error.
///
/// # Errors
/// A committed report that cannot be read.
pub fn compare_quick(rows: &[Row], tell: Tell<'_>) -> Result<(), String> {
    quick::tell_stale(rows, tell)
}

/// Takes the rows of a quick run over into `docs/report-quick.json`.
///
/// # Errors
/// A file that cannot be read or written.
pub fn write_quick(rows: &[Row], tell: Tell<'_>) -> Result<(), String> {
    quick::write_quick(rows, tell)
}

/// Tells the first of some lines.
fn list(lines: &[String], tell: Tell<'_>) {
    for line in lines.iter().take(MOST_TOLD) {
        tell(format_args!("  {line}"));
    }
}

/// What differs, in words: new rows, rows that are gone from an artefact, other numbers, other
/// verdicts.
fn differences(rows: &[Row], reference: &Report) -> Vec<String> {
    let ours = by_name(rows.to_vec());
    let artefacts: BTreeSet<&str> = rows.iter().map(|row| row.artefact).collect();
    let mut all = Vec::new();
    for ((artefact, quantity), row) in &ours {
        let name = format!("{artefact}:{quantity}");
        match reference.get(&(artefact.clone(), quantity.clone())) {
            None => all.push(format!("{name} is new")),
            Some(old) if old.pass != row.pass => all.push(format!(
                "{name} has another verdict: {:?}, was {:?}",
                row.pass, old.pass
            )),
            Some(old) => {
                let scale = row.ours.abs().max(old.ours.abs());
                if (row.ours - old.ours).abs() > AGREES * scale {
                    all.push(format!("{name} is {}, was {}", row.ours, old.ours));
                }
            }
        }
    }
    let gone = reference.keys().filter(|name| !ours.contains_key(name));
    let gone = gone.filter(|name| artefacts.contains(name.0.as_str()));
    all.extend(gone.map(|(artefact, quantity)| format!("{artefact}:{quantity} is gone")));
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report() -> Report {
        let row = |quantity: &str, ours| Row::measured("fig8", quantity, "", ours, "");
        by_name(vec![
            row("height/rod", 36.7449).against(36.0, 1.0),
            row("height/ellipsoids", 34.53),
            row("spread", 0.029_16),
        ])
    }

    /// New and lost rows, other numbers and other verdicts are told; the last digits are not.
    #[test]
    fn differences_between_reports_are_told() {
        let rows = |f: &dyn Fn(&mut Row)| -> Vec<Row> {
            let mut rows: Vec<Row> = report().into_values().collect();
            rows.iter_mut().for_each(f);
            rows
        };
        let told = |rows: &[Row]| differences(rows, &report());
        assert_eq!(told(&rows(&|row| row.ours *= 1.0 + 1e-9)), [""; 0]);
        assert_eq!(told(&rows(&|row| row.ours *= 1.001)).len(), 3);
        assert_eq!(told(&rows(&|row| row.pass = Some(false))).len(), 3);
        assert_eq!(
            told(&rows(&|_| {})[1..]),
            ["fig8:height/ellipsoids is gone"]
        );
        let renamed = rows(&|row| row.quantity.push('s'));
        assert_eq!(told(&renamed).len(), 6);
    }
}

//! `docs/report-quick.json`: what `reproduce-figures --quick` computes, kept so that a test can compute it
//! again. Numbers that a full run computes from the same scenes and settings are held to `docs/report.json`
//! as well, so that neither file can go stale unnoticed.

use super::{Report, by_name, list};
use crate::{Tell, workspace_root};
use actin_draw::report::{self, Row, save};
use std::collections::BTreeSet;

/// The committed quick run.
const COMMITTED: &str = "docs/report-quick.json";
/// What brings it up to date, and what does so with the full report.
const REWRITES: &str = "cargo xtask reproduce-figures --quick --write";
const REWRITES_FULL: &str = "cargo xtask reproduce-figures && cargo xtask docs \
    target/figures/report.json --write";

/// Rows agree within this share: a residual of 1e-7 pN, the stop rule of all equilibria, determines tips, energies and
/// couples to 2e-8. With AVX2 instead of AVX-512 in all libraries no other row moves by more than 1e-7.
const AGREES: f64 = 1e-6;
/// Fitted parameters agree within this share of their standard error: such a step changes the sum of squares by
/// 1e-6 of its variance, so the fitted curve is the same.
const AGREES_IN_STANDARD_ERRORS: f64 = 1e-3;

/// Rows that rounding moves further: artefact, part of the quantity, the share within which they agree (`None`: they
/// are not compared), and the reason; the first entry that matches holds. Filaments of monomers have a zero-stiffness mode per monomer at rest, so that
/// several states lie close together and rounding selects one of them.
///
/// The shares are 5 to 10 times the differences between AVX-512 and scalar code, which differ in every sum.
const SENSITIVE: [(&str, &str, Option<f64>, &str); 24] = [
    ("fig10", "over/270", None, SEVERAL),
    ("fig10", "over/360", None, SEVERAL),
    (
        "fig10",
        "order_difference",
        None,
        "difference of two states",
    ),
    ("fig10", "under/180", None, UNDER_TWISTED),
    ("fig8", "under/180", None, UNDER_TWISTED),
    ("fig8", "_spread/over/180", Some(0.03), SPREAD),
    ("fig8", "_difference", Some(0.03), SPREAD),
    ("fig8", "over/180", Some(3e-3), BUCKLED),
    ("fig4", "_spread/full", Some(5e-3), SPREAD),
    ("fig4", "_close/full", Some(5e-3), SPREAD),
    ("fig4", "_overlap/full", Some(5e-3), SPREAD),
    ("fig4", "full", Some(5e-4), ZERO_STIFFNESS),
    ("fig5", "node_spread", Some(1e-3), SPREAD),
    ("fig5", "", Some(3e-4), ZERO_STIFFNESS),
    ("fig6", "node_spread", Some(1e-3), SPREAD),
    ("fig6", "mean-filament", Some(1e-3), ZERO_STIFFNESS),
    ("fig6", "", Some(3e-4), ZERO_STIFFNESS),
    ("law", "Figure-", Some(1e-3), ZERO_STIFFNESS),
    ("law", "S3-at--", None, COMPRESSED),
    ("table4", "s3/by-force/-", None, COMPRESSED),
    ("table4", "s3/by-shift/-", None, COMPRESSED),
    ("table4", "s1", Some(1e-3), ZERO_STIFFNESS),
    ("table4", "b1/couples", Some(1e-3), ZERO_STIFFNESS),
    ("table4", "at-rest", Some(1e-3), ZERO_STIFFNESS),
];
const SEVERAL: &str = "several equilibria beyond half a turn of over-twist";
const UNDER_TWISTED: &str =
    "monomers that are under-twisted and bent have several states at one strain";
const BUCKLED: &str = "buckled states that differ by 3e-4";
const SPREAD: &str = "difference of states that rounding moves";
const ZERO_STIFFNESS: &str = "monomers under small loads";
const COMPRESSED: &str = "compressed monomers buckle at once, into one of several states";

/// Smallest difference that counts, by unit: what a residual of 1e-7 pN leaves of a zero.
fn floor(unit: &str) -> f64 {
    match unit {
        "nm" | "pN" | "pN nm" | "deg" => 1e-6,
        _ => 1e-9,
    }
}

/// Index of the first entry of [`SENSITIVE`] that matches a row.
fn entry(row: &Row) -> Option<usize> {
    // Without monomers a state is unique, except beyond half a turn.
    let is_rod = row.quantity.ends_with("/rod");
    SENSITIVE.iter().position(|(artefact, part, _, reason)| {
        let is_exempt = is_rod && *reason != SEVERAL;
        *artefact == row.artefact && row.quantity.contains(part) && !is_exempt
    })
}

/// The share within which a row agrees on every machine; `None` if rounding selects the state.
fn agreement(row: &Row) -> Option<f64> {
    entry(row).map_or(Some(AGREES), |entry| SENSITIVE[entry].2)
}

/// Whether a full run computes the number from the same scene and settings: parameters, fits of the paper's
/// rows, pure rods, and filaments of the first sampling where they are rows of their own.
fn is_in_full(row: &Row) -> bool {
    let quantity = row.quantity.as_str();
    let is_rod = quantity.ends_with("/rod") && !quantity.starts_with("in_plane");
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

/// Writes the artefacts of a quick run into the committed file.
pub(super) fn write_quick(rows: &[Row], tell: Tell<'_>) -> Result<(), String> {
    let path = workspace_root().join(COMMITTED);
    let mut all = if path.exists() {
        by_name(report::read(&path)?)
    } else {
        Report::new()
    };
    let ours: BTreeSet<&str> = rows.iter().map(|row| row.artefact).collect();
    all.retain(|(artefact, _), _| !ours.contains(artefact.as_str()));
    // Notes are long and not compared.
    all.extend(by_name(
        rows.iter()
            .map(|row| Row {
                note: String::new(),
                ..row.clone()
            })
            .collect(),
    ));
    tell(format_args!("written: {COMMITTED}"));
    save(
        &workspace_root(),
        COMMITTED,
        &report::text(all.into_values().collect())?,
    )
}

/// Tells what a quick run has otherwise than the committed files, which is no error.
pub(super) fn tell_stale(rows: &[Row], tell: Tell<'_>) -> Result<(), String> {
    let stale = stale(rows)?;
    tell(format_args!(
        "{} rows differ from the committed ones",
        stale.len()
    ));
    list(&stale, tell);
    Ok(())
}

/// What a fresh quick run has otherwise than the committed files, a line each.
pub(crate) fn stale(rows: &[Row]) -> Result<Vec<String>, String> {
    let root = workspace_root();
    let quick = by_name(report::read(&root.join(COMMITTED))?);
    let full = by_name(report::read(&root.join(super::REFERENCE))?);
    let mut all = against_quick(rows, &quick);
    all.extend(against_full(rows, &full));
    Ok(all)
}

fn against_quick(rows: &[Row], quick: &Report) -> Vec<String> {
    let ours = by_name(rows.to_vec());
    let artefacts: BTreeSet<&str> = rows.iter().map(|row| row.artefact).collect();
    let compared = ours.iter().filter(|(_, row)| agreement(row).is_some());
    let changed = compared.filter_map(|(name, row)| {
        match quick.get(name) {
            None => Some(format!("is not in {COMMITTED}")),
            Some(old) => difference(row, old, COMMITTED),
        }
        .map(|what| told(row, &what, REWRITES))
    });
    let gone = quick.iter().filter(|(name, _)| !ours.contains_key(*name));
    let gone = gone.filter(|(name, _)| artefacts.contains(name.0.as_str()));
    let gone = gone.map(|(_, row)| told(row, &format!("is in {COMMITTED} only"), REWRITES));
    changed.chain(gone).collect()
}

fn against_full(rows: &[Row], full: &Report) -> Vec<String> {
    let shared = rows.iter().filter(|row| is_in_full(row));
    let changed = shared.filter_map(|row| {
        let name = (row.artefact.to_owned(), row.quantity.clone());
        let what = match full.get(&name) {
            None => Some(format!("is not in {}", super::REFERENCE)),
            Some(old) => difference(row, old, super::REFERENCE),
        };
        what.map(|what| told(row, &what, REWRITES_FULL))
    });
    changed.collect()
}

/// Number, expected number or verdict that differs, with both values.
fn difference(row: &Row, old: &Row, file: &str) -> Option<String> {
    let share = agreement(row)?;
    let flat = AGREES_IN_STANDARD_ERRORS * old.standard_error.unwrap_or(0.0);
    let floor = floor(row.unit).max(flat);
    let differs = |a: f64, b: f64| (a - b).abs() > f64::max(share * a.abs().max(b.abs()), floor);
    let expected = row
        .paper
        .zip(old.paper)
        .map_or(row.paper != old.paper, |(a, b)| differs(a, b));
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

fn told(row: &Row, what: &str, command: &str) -> String {
    format!(
        "{}:{} {what}; if that is meant: {command}",
        row.artefact, row.quantity
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(artefact: &'static str, quantity: &str, ours: f64) -> Row {
        Row::measured(artefact, quantity, "nm", ours, "")
    }

    /// The symptom to be found: a number that moves by more than rounding, a row that comes or goes, another
    /// verdict. The message names row, both values and command.
    #[test]
    fn what_moves_is_told() {
        let height = row("fig8", "height/rod", 39.4).against(39.0, 1.0);
        let committed = by_name(vec![height.clone(), row("fig8", "force", 16.0)]);
        let moved = |ours: f64, tolerance| {
            let height = row("fig8", "height/rod", ours).against(39.0, tolerance);
            against_quick(&[height, row("fig8", "force", 16.0)], &committed)
        };
        assert_eq!(moved(39.4 * (1.0 + 1e-8), 1.0), [""; 0]);
        let told = moved(39.401, 1.0);
        assert_eq!(
            told,
            [format!(
                "fig8:height/rod is 39.401, in {COMMITTED} 39.4; if that is meant: {REWRITES}"
            )]
        );
        assert_eq!(moved(39.4, 0.1).len(), 1);
        assert_eq!(
            against_quick(std::slice::from_ref(&height), &committed).len(),
            1
        );
        let more = [height, row("fig8", "force", 16.0), row("fig8", "new", 1.0)];
        assert_eq!(against_quick(&more, &committed).len(), 1);
    }

    /// Zeros differ by what a residual leaves; free filaments by more; what rounding decides is not compared.
    #[test]
    fn rounding_is_allowed_for() {
        let told = |artefact, quantity: &str, old, new| {
            let committed = by_name(vec![row(artefact, quantity, old)]);
            against_quick(&[row(artefact, quantity, new)], &committed).len()
        };
        assert_eq!(told("fig8", "order_difference", 1e-10, 3e-10), 0);
        assert_eq!(told("fig8", "height", 10.0, 10.0002), 1);
        assert_eq!(told("fig6", "node_spread", 10.0, 10.002), 0);
        assert_eq!(told("fig10", "height/over/270/rod-40", 28.8, 29.2), 0);
        assert_eq!(told("fig10", "height/over/270/rod", 28.8, 29.2), 0);
        assert_eq!(told("fig8", "height/under/180/rod-40", 28.8, 29.2), 0);
        assert_eq!(told("fig8", "height/under/180/rod", 28.8, 29.2), 1);
        assert_eq!(told("fig10", "height/under/270/rod-40", 28.8, 29.2), 1);
    }

    /// An entry without a row is outdated; one that matches more than before loosens rows without a reason.
    #[test]
    fn each_exception_is_needed() {
        let committed = report::read(&workspace_root().join(COMMITTED)).unwrap();
        let entries = SENSITIVE.iter().enumerate();
        let counts =
            entries.map(|(i, _)| committed.iter().filter(|row| entry(row) == Some(i)).count());
        let counts: Vec<usize> = counts.collect();
        assert_eq!(
            counts,
            [
                133, 142, 16, 108, 98, 16, 4, 78, 2, 1, 1, 15, 16, 58, 23, 8, 63, 3, 3, 4, 2, 17,
                8, 2
            ]
        );
    }

    /// A quick run has rows that the full report has, too, and they are compared.
    #[test]
    fn the_full_report_cannot_go_stale() {
        let full = by_name(vec![
            row("fig7", "turn/rod", 5.285),
            row("fig7", "turn/ellipsoid", 9.0),
        ]);
        let ours = [
            row("fig7", "turn/rod", 5.286),
            row("fig7", "turn/ellipsoid", 10.0),
        ];
        let told = against_full(&ours, &full);
        assert_eq!(told.len(), 1);
        assert!(told[0].contains("turn/rod is 5.286") && told[0].contains(REWRITES_FULL));
        let committed = report::read(&workspace_root().join(COMMITTED)).unwrap();
        for artefact in [
            "table1", "table3", "table4", "table5", "fig5", "fig6", "fig7", "fig8", "fig9", "fig10",
        ] {
            let shared = committed
                .iter()
                .filter(|row| row.artefact == artefact && is_in_full(row));
            assert!(shared.count() >= 4, "{artefact}");
        }
    }
}

//! Numbers of Figure 7 as rows of the report, and the table behind them.

use super::case::Halves;
use crate::figures::bounds::{CROSS_CHECK, ROUND_OFF};
use actin_draw::report::{Origin, Row, write_csv};
use std::path::Path;

/// Rod held in two nodes and a frame, by an earlier calculation: energy (pN nm), turn (deg), pull (pN).
const ROD: [(&str, &str); 3] = [
    ("energy/rod", "27.96"),
    ("turn/rod", "5.285"),
    ("pull/rod", "15.65"),
];
/// What the paper says of the over-twisted half: roughly 10 % more.
const PAPER_RATIO: &str = "1.10";

/// An observable: name, unit, value.
type Observable = (&'static str, &'static str, fn(&Halves) -> f64);

const OBSERVABLES: [Observable; 6] = [
    ("half_energy_ratio", "", Halves::ratio),
    ("half_energy_excess", "pN nm", |h| {
        h.over_pn_nm - h.under_pn_nm
    }),
    ("energy", "pN nm", Halves::energy_pn_nm),
    ("turn", "deg", |h| h.turn_deg),
    ("pull", "pN", |h| h.pull_pn),
    ("tension", "pN", |h| h.tension_pn),
];

/// All rows, kind by kind.
pub(super) fn rows(results: &[Halves]) -> Vec<Row> {
    let mut kinds: Vec<String> = results.iter().map(|r| r.case.kind()).collect();
    kinds.dedup();
    let of_kind = |kind: &String| results.iter().filter(|r| r.case.kind() == *kind).collect();
    let mut all: Vec<Row> = kinds
        .iter()
        .flat_map(|kind| {
            let halves: Vec<&Halves> = of_kind(kind);
            OBSERVABLES.map(|observable| row(kind, &halves, observable))
        })
        .collect();
    let doubtful = results.iter().filter(|r| r.doubtful > 0).count();
    let note = format!("of {} equilibria", results.len());
    all.push(Row::measured(
        "fig7",
        "not_certified_stable",
        "",
        doubtful as f64,
        note,
    ));
    all
}

fn row(kind: &str, halves: &[&Halves], (name, unit, of): Observable) -> Row {
    let values: Vec<f64> = halves.iter().map(|h| of(h)).collect();
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
    let sd = (squares / (n - 1.0).max(1.0)).sqrt();
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let note = if values.len() > 1 {
        let what = if halves[0].case.is_sampled() {
            "samplings, both directions"
        } else {
            "both directions"
        };
        format!(
            "mean over {n} ({what}), sd {sd:.4}, standard error {:.4}, range \
             {low:.4} to {high:.4}",
            sd / n.sqrt()
        )
    } else {
        "one equilibrium".into()
    };
    let quantity = format!("{name}/{kind}");
    let row = Row::measured("fig7", quantity, unit, mean, note);
    against(row, sd)
}

/// The row compared with what is known of the paper's own cases; variants are shown beside them. `sd` is that
/// of a single filament.
fn against(row: Row, sd: f64) -> Row {
    let noted = |row: Row, words: &str| Row {
        note: format!("{words}; {}", row.note),
        ..row
    };
    match row.quantity.as_str() {
        "half_energy_ratio/rod" => row.against(1.0, ROUND_OFF).of(Origin::Theory),
        "half_energy_ratio/ellipsoid" => {
            let words = "the paper: roughly 10 % more; tolerance: half a digit and twice the sd";
            noted(row, words).against_printed(PAPER_RATIO, sd)
        }
        "half_energy_ratio/coupling-energy/rod" => {
            let words = "the paper: roughly 10 % more in monomers, and an energy C3 sigma_3 kappa_3 would \
                         couple the twist and stretch of a rod as theirs are; tolerance: half a digit";
            noted(row, words).against_printed(PAPER_RATIO, 0.0)
        }
        quantity => match ROD.iter().find(|entry| entry.0 == quantity) {
            None => row,
            Some((_, value)) => noted(row, CROSS_CHECK)
                .against_printed(value, 0.0)
                .of(Origin::CrossCheck),
        },
    }
}

const COLUMNS: [&str; 12] = [
    "kind",
    "seed",
    "reversed",
    "over_twisted_half_pn_nm",
    "under_twisted_half_pn_nm",
    "ratio",
    "turn_deg",
    "pull_pn",
    "tension_pn",
    "not_positive_eigenvalues",
    "residual_pn",
    "residual_pn_nm",
];

/// Writes `fig7.csv` and `fig7_profile.csv`.
pub(super) fn write_tables(results: &[Halves], out: &Path) -> Result<(), String> {
    let rows = results.iter().map(|h| {
        let mut row = vec![
            h.case.kind(),
            h.case.seed.to_string(),
            h.case.reversed.to_string(),
        ];
        let numbers = [
            h.over_pn_nm,
            h.under_pn_nm,
            h.ratio(),
            h.turn_deg,
            h.pull_pn,
        ];
        row.extend(numbers.map(number));
        row.push(number(h.tension_pn));
        row.push(h.doubtful.to_string());
        row.extend([h.residual.0, h.residual.1].map(number));
        row
    });
    write_csv(out, "fig7.csv", &COLUMNS, rows)?;
    let points = results.iter().flat_map(|h| {
        let key = [
            h.case.kind(),
            h.case.seed.to_string(),
            h.case.reversed.to_string(),
        ];
        h.profile.iter().map(move |&(s, e)| {
            let mut row = key.to_vec();
            row.extend([number(s), number(e)]);
            row
        })
    });
    let header = [
        "kind",
        "seed",
        "reversed",
        "s_from_middle_nm",
        "energy_per_length_pn",
    ];
    write_csv(out, "fig7_profile.csv", &header, points)
}

fn number(x: f64) -> String {
    format!("{x:.12e}")
}

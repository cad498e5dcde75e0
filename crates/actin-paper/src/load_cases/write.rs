//! The table of load cases as CSV, Markdown and picture.

use super::case::Bound;
use super::row::Row;
use crate::charts::line;
use crate::measure::SampleStatistics;
use crate::palette;
use crate::statistics::distinct;
use actin_draw::report::write_csv;
use actin_draw::{Chart, Mark, Series};
use std::fmt::Write as _;
use std::path::Path;

type Column = (&'static str, fn(&Row) -> String);

const COLUMNS: [Column; 23] = [
    ("group", |r| r.group.name().to_owned()),
    ("case", |r| r.case.clone()),
    ("quantity", |r| r.quantity.clone()),
    ("law", |r| r.law.clone()),
    ("mean_filament", |r| number(r.mean.map(|s| s.mean))),
    ("mean_filament_sd", |r| number(r.mean.map(|s| s.deviation))),
    ("azimuths", |r| count(r.mean)),
    ("drawn", |r| number(r.drawn.map(|s| s.mean))),
    ("drawn_sd", |r| number(r.drawn.map(|s| s.deviation))),
    ("filaments", |r| count(r.drawn)),
    ("rod", |r| number(r.rod)),
    ("rod_fine", |r| number(r.fine)),
    ("rod_of_drawn", |r| number(r.rod_of_drawn)),
    ("error_mean", |r| number(r.error_mean)),
    ("error_drawn", |r| number(r.error_drawn)),
    ("error_fine", |r| number(r.error_fine)),
    ("scatter", |r| number(r.scatter)),
    ("bound", |r| r.bound.text()),
    ("share_of_bound_mean", |r| number(r.shares_of_bound()[0])),
    ("share_of_bound_drawn", |r| number(r.shares_of_bound()[1])),
    ("met_mean", |r| yes_or_no(r.is_met()[0])),
    ("met_drawn", |r| yes_or_no(r.is_met()[1])),
    ("note", |r| r.note.clone()),
];

pub(super) fn csv(out: &Path, rows: &[Row]) -> Result<(), String> {
    let cells = |row: &Row| COLUMNS.map(|(_, cell)| cell(row)).to_vec();
    let header = COLUMNS.map(|(name, _)| name);
    write_csv(out, "load-cases.csv", &header, rows.iter().map(cells))
}

fn number(value: Option<f64>) -> String {
    let finite = value.filter(|v| v.is_finite());
    finite.map_or(String::new(), |v| format!("{v:.6e}"))
}

fn count(sampled: Option<SampleStatistics>) -> String {
    sampled.map_or(0, |s| s.count).to_string()
}

fn yes_or_no(met: Option<bool>) -> String {
    met.map_or("", |met| if met { "yes" } else { "no" })
        .to_owned()
}

/// Number of errors within their bounds, and the largest ratio of error to bound.
fn score(rows: &[&Row], against: usize) -> [String; 2] {
    let verdicts = || rows.iter().filter_map(|row| row.is_met()[against]);
    let (judged, good) = (verdicts().count(), verdicts().filter(|met| *met).count());
    let shares = rows.iter().filter_map(|row| row.shares_of_bound()[against]);
    let worst = shares.reduce(f64::max);
    if judged == 0 {
        return [String::new(), String::new()];
    }
    [
        format!("{good} of {judged}"),
        worst.map_or(String::new(), |worst| format!("{worst:.2}")),
    ]
}

/// The page of the book.
pub(super) fn page(rows: &[Row]) -> String {
    let text = "# Load cases\n\n\
        Computed by `cargo xtask load-cases --write`, which writes all numbers to `load-cases.csv`. Each case compares a rod \
        with segments of 10 nm with filaments of monomers. The mean filament has weighted bonds; its errors are means over \
        azimuths. Filaments of 64 sampled bonds give means over samplings and azimuths. Errors are relative; for shapes the \
        largest distance counts, for mixed filaments the spread over resolutions. The columns count errors within their \
        bounds and give the largest ratio of error to bound.\n";
    text.to_owned() + &summary(rows)
}

/// Numbers of errors within their bounds, by case and law.
pub(super) fn summary(rows: &[Row]) -> String {
    let mut text = "\n| case | law | within bounds, mean filament | largest ratio | within bounds, sampled bonds | largest ratio |\n\
                    | --- | --- | ---: | ---: | ---: | ---: |\n"
        .to_owned();
    let judged = rows.iter().filter(|row| row.bound != Bound::Open);
    let pairs = distinct(judged.map(|row| (row.group, &*row.law)));
    for (group, law) in pairs {
        let own = rows
            .iter()
            .filter(|row| row.group == group && row.law == law);
        let own: Vec<&Row> = own.collect();
        let ([met, worst], [met_drawn, worst_drawn]) = (score(&own, 0), score(&own, 1));
        let name = group.name();
        _ = writeln!(
            text,
            "| {name} | {law} | {met} | {worst} | {met_drawn} | {worst_drawn} |"
        );
    }
    text
}

/// Smallest drawn ratio of error to bound.
const LEAST: f64 = 1e-2;

/// Draws `load-cases.svg`: logarithm of the ratio of error to bound against the mean filament, in
/// the order of the table.
pub(super) fn picture(out: &Path, rows: &[Row]) -> Result<(), String> {
    let judged: Vec<&Row> = rows.iter().filter(|r| r.bound != Bound::Open).collect();
    let places = distinct(judged.iter().map(|row| (&*row.case, &*row.quantity)));
    let laws = distinct(judged.iter().map(|row| &*row.law));
    let bound = vec![(0.0, 0.0), (places.len() as f64 + 1.0, 0.0)];
    let mut series = vec![line("bound", palette::GREY, bound)];
    for (k, law) in laws.iter().enumerate() {
        let own = judged.iter().filter(|row| row.law == *law);
        let points = own.filter_map(|row| point(row, &places)).collect();
        series.push(Series {
            mark: Mark::Dots,
            ..line(*law, palette::line(k), points)
        });
    }
    let chart = Chart {
        title: "Errors of rods against the mean filament, over their bounds",
        x_label: "quantity, in the order of the table",
        y_label: "log10 of error over bound",
        series,
        equal_axes: false,
    };
    chart.draw(&out.join("load-cases.svg"))
}

/// Position in the table and logarithm; `None` without an error.
fn point(row: &Row, places: &[(&str, &str)]) -> Option<(f64, f64)> {
    let own = (&*row.case, &*row.quantity);
    let place = places.iter().position(|place| *place == own)?;
    let share = row.shares_of_bound()[0].filter(|share| share.is_finite())?;
    Some((place as f64 + 1.0, share.max(LEAST).log10()))
}

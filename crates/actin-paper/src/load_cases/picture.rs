//! Ratios of errors to bounds for all laws and cases.

use super::case::Bound;
use super::row::Row;
use crate::charts::line;
use crate::palette;
use actin_draw::{Chart, Mark, Series};
use std::path::Path;

/// Smallest drawn ratio of error to bound.
const LEAST: f64 = 1e-2;

/// Draws `load-cases.svg`: logarithm of the ratio of error to bound against the mean filament, in
/// the order of the table.
pub(super) fn draw(out: &Path, rows: &[Row]) -> Result<(), String> {
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

/// Distinct values in order of occurrence.
pub(super) fn distinct<T: PartialEq>(all: impl Iterator<Item = T>) -> Vec<T> {
    let mut cached = Vec::new();
    for one in all {
        if !cached.contains(&one) {
            cached.push(one);
        }
    }
    cached
}

/// Position in the table and logarithm; `None` without an error.
fn point(row: &Row, places: &[(&str, &str)]) -> Option<(f64, f64)> {
    let own = (&*row.case, &*row.quantity);
    let place = places.iter().position(|place| *place == own)?;
    let share = row.shares_of_bound()[0].filter(|share| share.is_finite())?;
    Some((place as f64 + 1.0, share.max(LEAST).log10()))
}

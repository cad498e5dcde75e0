//! Tables 3 and 5 as pictures: paper's entries, our mean with its scatter, other kinds.

use super::ensemble::{Ensemble, Kind};
use super::paper::{Entry, Table};
use crate::figures::plot::{Chart, Series, draw as draw_chart, resolution_colour};
use crate::figures::report::Picture;
use actin_sim::Anchors;
use plotters::style::RGBColor;
use std::path::Path;

/// Half the width of the cap of an error bar (rad/nm).
const CAP: f64 = 3.5e-4;
const PAPER: RGBColor = RGBColor(20, 20, 20);

/// Draws the default kind with error bars, and all kinds if there are more.
pub(super) fn draw(
    table: Table,
    ensemble: &Ensemble,
    entries: &[Entry],
    out: &Path,
) -> Result<Vec<Picture>, String> {
    let (symbol, unit) = match table {
        Table::Rigidity => ("B3", "pN nm^2"),
        Table::LengthChange => ("dL/L", ""),
    };
    let y_label = match table {
        Table::Rigidity => "secant twisting rigidity B3 (pN nm^2)",
        Table::LengthChange => "relative change of length dL/L",
    };
    let mut pictures = Vec::new();
    let mut save = |file: String, title: &str, series, caption: String| {
        let chart = Chart {
            title,
            x_label: "curvature phi/L (rad/nm); over-twist is positive",
            y_label,
            series,
            equal_axes: false,
        };
        draw_chart(&chart, &out.join(&file))?;
        pictures.push(Picture { file, caption });
        Ok::<_, String>(())
    };
    save(
        format!("{}.svg", table.id()),
        &format!("{symbol} at held twist, {} bond samplings", ensemble.seeds),
        of_default(table, ensemble, entries),
        format!(
            "{symbol} {unit} of 64 independent bonds per interface: mean and 2 sd over {} \
             samplings, and the default filament (seed 0). Dots: the paper; its entries above 200 \
             deg, which it calls unreliable, are grey.",
            ensemble.seeds
        ),
    )?;
    if ensemble.kinds().len() > 1 {
        save(
            format!("{}_bonds.svg", table.id()),
            &format!("{symbol} for other numbers and patterns of bonds"),
            of_kinds(table, ensemble, entries),
            "Means for 12 (red) to 160 (blue) independent bonds, and mean with 2 sd for one \
             pattern of 40 bonds on all interfaces (grey)."
                .into(),
        )?;
    }
    Ok(pictures)
}

fn of_default(table: Table, ensemble: &Ensemble, entries: &[Entry]) -> Vec<Series> {
    let blue = resolution_colour(1.0);
    let mut series = bars(table, ensemble, Kind::DEFAULT, entries, blue);
    let mean = means(table, ensemble, Kind::DEFAULT, entries);
    series.push(line("mean, 2 sd", blue, mean));
    let seed_0 = entries.iter().filter_map(|entry| {
        let points = ensemble.points(Kind::DEFAULT, entry);
        let (_, point) = points.into_iter().find(|(seed, _)| *seed == 0)?;
        Some((entry.curvature, super::ensemble::value(&point, table)))
    });
    series.push(line("seed 0", resolution_colour(0.25), seed_0.collect()));
    series.extend(paper(entries));
    series
}

fn of_kinds(table: Table, ensemble: &Ensemble, entries: &[Entry]) -> Vec<Series> {
    let pattern = Kind {
        anchors: Anchors::Identical,
        bonds: 40,
    };
    let grey = RGBColor(130, 130, 130);
    let mut series = bars(table, ensemble, pattern, entries, grey);
    let mean = means(table, ensemble, pattern, entries);
    series.push(line("one pattern of 40", grey, mean));
    let independent: Vec<Kind> = ensemble.kinds();
    let independent: Vec<Kind> = independent
        .into_iter()
        .filter(|kind| kind.anchors == Anchors::Independent)
        .collect();
    for (i, kind) in independent.iter().enumerate() {
        let colour = resolution_colour(i as f64 / (independent.len() - 1).max(1) as f64);
        let label = format!("{} independent", kind.bonds);
        series.push(line(&label, colour, means(table, ensemble, *kind, entries)));
    }
    series.extend(paper(entries));
    series
}

fn means(table: Table, ensemble: &Ensemble, kind: Kind, entries: &[Entry]) -> Vec<(f64, f64)> {
    let mean = |entry: &Entry| ensemble.sample(kind, entry, table).mean;
    entries.iter().map(|e| (e.curvature, mean(e))).collect()
}

/// Two standard deviations up and down, with caps.
fn bars(
    table: Table,
    ensemble: &Ensemble,
    kind: Kind,
    entries: &[Entry],
    colour: RGBColor,
) -> Vec<Series> {
    let bar = |entry: &Entry| {
        let s = ensemble.sample(kind, entry, table);
        let (low, high) = (s.mean - 2.0 * s.sd, s.mean + 2.0 * s.sd);
        let (x, left, right) = (
            entry.curvature,
            entry.curvature - CAP,
            entry.curvature + CAP,
        );
        Series {
            label: None,
            colour,
            points: vec![
                (left, low),
                (right, low),
                (x, low),
                (x, high),
                (left, high),
                (right, high),
            ],
            dots: false,
        }
    };
    entries.iter().map(bar).collect()
}

fn line(label: &str, colour: RGBColor, points: Vec<(f64, f64)>) -> Series {
    Series {
        label: Some(label.to_owned()),
        colour,
        points,
        dots: false,
    }
}

/// The paper's entries as dots.
fn paper(entries: &[Entry]) -> [Series; 2] {
    [
        (true, "paper", PAPER),
        (false, "paper, unreliable", RGBColor(165, 165, 165)),
    ]
    .map(|(reliable, label, colour)| Series {
        label: Some(label.to_owned()),
        colour,
        points: entries
            .iter()
            .filter(|entry| entry.is_reliable() == reliable)
            .map(|entry| (entry.curvature, entry.value))
            .collect(),
        dots: true,
    })
}

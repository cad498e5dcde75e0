//! Tables 3 and 5 as pictures: paper's entries, our mean with its scatter, other kinds.

use super::ensemble::{Ensemble, Kind};
use crate::palette;
use crate::published::{Entry, Table};
use actin_draw::report::Picture;
use actin_draw::{Chart, Colour, Series};
use actin_sim::Anchors;
use std::path::Path;

/// Half the width of the cap of an error bar (rad/nm).
const CAP: f64 = 3.5e-4;

/// Draws the default kind with error bars, and all kinds if there are more.
pub(super) fn draw(
    table: Table,
    ensemble: &Ensemble,
    entries: &[Entry],
    out: &Path,
) -> Result<Vec<Picture>, String> {
    let symbol = match table {
        Table::Rigidity => "B3",
        Table::LengthChange => "dL/L",
    };
    let seeds = ensemble.seeds;
    let mut pictures = vec![save(
        table,
        &out.join(format!("{}.svg", table.id())),
        &format!("{symbol} at held twist, {seeds} bond samplings"),
        of_default(table, ensemble, entries),
        format!(
            "{symbol} of 64 independent bonds per interface: mean and 2 sd over {seeds} samplings, \
             the mean on the way back from the largest angle, and one sampling (seed 0). Mean \
             filament: 12 weighted bonds per interface that stand for all. Dots: the paper; its entries above 200 deg, which it calls unreliable, are grey."
        ),
    )?];
    if ensemble.kinds().len() > Kind::CORE.len() {
        let [few, many] = palette::chosen().end_names();
        pictures.push(save(
            table,
            &out.join(format!("{}_bonds.svg", table.id())),
            &format!("{symbol} for other numbers and patterns of bonds"),
            of_kinds(table, ensemble, entries),
            format!(
                "Means for 12 ({few}) to 160 ({many}) independent bonds, and mean with 2 sd for one \
                 pattern of 40 bonds on all interfaces (grey). The mean filament is the limit of many."
            ),
        )?);
    }
    Ok(pictures)
}

fn save(
    table: Table,
    path: &Path,
    title: &str,
    series: Vec<Series>,
    caption: String,
) -> Result<Picture, String> {
    let y_label = match table {
        Table::Rigidity => "secant twisting rigidity B3 (1000 pN nm^2)",
        Table::LengthChange => "relative change of length dL/L",
    };
    let chart = Chart {
        title,
        x_label: "curvature phi/L (rad/nm); over-twist is positive",
        y_label,
        series: series.into_iter().map(|s| scaled(s, table)).collect(),
        equal_axes: false,
    };
    chart.draw(path)?;
    let name = path.file_name().unwrap_or_default();
    Ok(Picture {
        file: name.to_string_lossy().into_owned(),
        caption,
    })
}

fn of_default(table: Table, ensemble: &Ensemble, entries: &[Entry]) -> Vec<Series> {
    let blue = palette::resolution(1.0);
    let mut series = bars(table, ensemble, Kind::DEFAULT, entries, blue);
    let mean = means(table, ensemble, Kind::DEFAULT, entries);
    series.push(line("drawn, mean and 2 sd", blue, mean));
    let back = means(table, ensemble, Kind::RETURNING, entries);
    series.push(line(
        "drawn, mean on the way back",
        palette::resolution(0.75),
        back,
    ));
    let seed_0 = entries.iter().filter_map(|entry| {
        let points = ensemble.points(Kind::DEFAULT, entry);
        let (_, point) = points.into_iter().find(|(seed, _)| *seed == 0)?;
        Some((entry.curvature, super::ensemble::value(&point, table)))
    });
    series.push(line(
        "drawn, seed 0",
        palette::resolution(0.25),
        seed_0.collect(),
    ));
    let mean = means(table, ensemble, Kind::MEAN, entries);
    series.push(line("mean filament", palette::line(4), mean));
    series.extend(paper(entries));
    series
}

fn of_kinds(table: Table, ensemble: &Ensemble, entries: &[Entry]) -> Vec<Series> {
    let pattern = Kind {
        anchors: Anchors::Identical,
        bonds: 40,
        returning: false,
    };
    let grey = palette::GREY;
    let mut series = bars(table, ensemble, pattern, entries, grey);
    let mean = means(table, ensemble, pattern, entries);
    series.push(line("one pattern of 40", grey, mean));
    let mut independent: Vec<Kind> = ensemble.kinds();
    independent.retain(|kind| kind.anchors == Anchors::Independent && !kind.returning);
    independent.sort_by_key(|kind| kind.bonds);
    for (i, kind) in independent.iter().enumerate() {
        let colour = palette::resolution(i as f64 / (independent.len() - 1).max(1) as f64);
        let label = format!("{} independent", kind.bonds);
        series.push(line(&label, colour, means(table, ensemble, *kind, entries)));
    }
    let mean = means(table, ensemble, Kind::MEAN, entries);
    series.push(line("mean filament", palette::line(4), mean));
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
    colour: Colour,
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

fn line(label: &str, colour: Colour, points: Vec<(f64, f64)>) -> Series {
    Series {
        label: Some(label.to_owned()),
        colour,
        points,
        dots: false,
    }
}

/// Rigidities in thousands, so that the labels of the axis are short.
fn scaled(series: Series, table: Table) -> Series {
    let factor = match table {
        Table::Rigidity => 1e-3,
        Table::LengthChange => 1.0,
    };
    let points = series.points.into_iter().map(|(x, y)| (x, factor * y));
    Series {
        points: points.collect(),
        ..series
    }
}

/// The paper's entries as dots.
fn paper(entries: &[Entry]) -> [Series; 2] {
    [
        (true, "paper", palette::DATA),
        (false, "paper, unreliable", palette::LIGHT_GREY),
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

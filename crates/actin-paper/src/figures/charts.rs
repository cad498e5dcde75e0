//! Charts of several figures: projected centre lines, and curves against the length of rod.

pub(super) use crate::charts::{dots, line};

use super::draft::Draft;
use crate::palette;
use crate::run::Shape;
use actin_draw::{Chart, Colour, Mark, Series};

/// Invisible dot that extends the axes for the legend.
pub(super) fn room(at: (f64, f64)) -> Series {
    dots(Colour([255; 3]), vec![at])
}

#[derive(Clone, Debug)]
pub(super) struct Filament {
    pub name: String,
    pub colour: Colour,
    pub is_dashed: bool,
    /// Centre line (nm).
    pub line: Vec<[f64; 3]>,
    /// Centres of monomers, drawn as dots (nm).
    pub monomers: Vec<[f64; 3]>,
}

impl Filament {
    pub(super) fn new(name: String, share: f64, shape: &Shape) -> Self {
        Self {
            name,
            colour: palette::resolution(share),
            is_dashed: false,
            line: shape.line.clone(),
            monomers: shape.monomers.clone(),
        }
    }

    /// Mean filament, drawn as a dashed centre line.
    pub(super) fn mean(name: &str, shape: &Shape) -> Self {
        Self {
            colour: palette::DATA,
            is_dashed: true,
            monomers: Vec::new(),
            ..Self::new(name.into(), 0.0, shape)
        }
    }

    pub(super) fn curve(&self, points: Vec<(f64, f64)>) -> Series {
        Series {
            mark: mark(self.is_dashed),
            ..line(self.name.clone(), self.colour, points)
        }
    }
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Side {
    /// Suffix of the file name.
    pub panel: &'static str,
    pub title: &'static str,
    pub labels: [&'static str; 2],
    pub project: fn(&[f64; 3]) -> (f64, f64),
    pub equal_axes: bool,
}

/// Series of monomers, of centre lines above them, and of `others`.
pub(super) fn seen_from(side: &Side, filaments: &[Filament], others: Vec<Series>) -> Vec<Series> {
    let project = |places: &[[f64; 3]]| places.iter().map(side.project).collect();
    let with_monomers = filaments.iter().filter(|f| !f.monomers.is_empty());
    let monomers = with_monomers.map(|f| dots(f.colour, project(&f.monomers)));
    let lines = filaments.iter().map(|f| f.curve(project(&f.line)));
    monomers.chain(lines).chain(others).collect()
}

pub(super) fn draw_from(
    draft: &mut Draft<'_>,
    file: &str,
    (side, title): (&Side, &str),
    filaments: &[Filament],
    others: Vec<Series>,
    caption: String,
) -> Result<(), String> {
    let chart = Chart {
        title,
        x_label: side.labels[0],
        y_label: side.labels[1],
        series: seen_from(side, filaments, others),
        equal_axes: side.equal_axes,
    };
    draft.chart(format!("{file}_{}.svg", side.panel), &chart, caption)
}

#[derive(Clone, Debug)]
pub(super) struct Curve {
    pub name: String,
    pub colour: Colour,
    pub is_dashed: bool,
    /// Length of rod (nm) and value, in any order.
    pub points: Vec<(f64, f64)>,
}

fn mark(is_dashed: bool) -> Mark {
    if is_dashed { Mark::Dashes } else { Mark::Line }
}

pub(super) fn against_rod(curves: Vec<Curve>) -> Vec<Series> {
    let curves = curves.into_iter().filter(|curve| !curve.points.is_empty());
    let series = curves.flat_map(|mut curve| {
        curve.points.sort_by(|a, b| a.0.total_cmp(&b.0));
        let line = Series {
            mark: mark(curve.is_dashed),
            ..line(curve.name, curve.colour, curve.points.clone())
        };
        [line, dots(curve.colour, curve.points)]
    });
    series.collect()
}

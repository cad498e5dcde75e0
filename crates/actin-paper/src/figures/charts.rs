//! Charts of several figures: projected centre lines, and curves against the length of rod.

pub(super) use crate::charts::{dots, line};

use super::draft::Draft;
use super::texts::ChartText;
use crate::palette;
use crate::run::Shape;
use actin_draw::{Colour, Mark, Series};

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
        let mark = if self.is_dashed {
            Mark::Dashes
        } else {
            Mark::Line
        };
        Series {
            mark,
            ..line(self.name.clone(), self.colour, points)
        }
    }
}

/// Half the size of the cross at an anchor (nm).
const CROSS_NM: f64 = 0.8;
const ANCHOR: Colour = Colour([70, 70, 70]);

/// Draws monomers, centre lines above them, and crosses at `anchors` (nm) in the projection of a chart.
pub(super) fn project(
    draft: &mut Draft<'_>,
    file: String,
    texts: &ChartText,
    filaments: &[Filament],
    anchors: &[[f64; 3]],
) -> Result<(), String> {
    let view = texts.view.ok_or("the chart is not a projection")?;
    let project = |places: &[[f64; 3]]| places.iter().map(|p| view.of(p)).collect();
    let with_monomers = filaments.iter().filter(|f| !f.monomers.is_empty());
    let monomers = with_monomers.map(|f| dots(f.colour, project(&f.monomers)));
    let lines = filaments.iter().map(|f| f.curve(project(&f.line)));
    let series = monomers.chain(lines).chain(crosses(project(anchors)));
    draft.plot(file, texts, series.collect())
}

/// Crosses at places. The first one has the legend.
fn crosses(places: Vec<(f64, f64)>) -> Vec<Series> {
    let strokes = places.into_iter().flat_map(|(x, y)| {
        [(CROSS_NM, CROSS_NM), (CROSS_NM, -CROSS_NM)]
            .map(|(a, b)| vec![(x - a, y - b), (x + a, y + b)])
    });
    let mut series: Vec<Series> = strokes
        .map(|points| line("anchors", ANCHOR, points))
        .collect();
    series.iter_mut().skip(1).for_each(|s| s.label = None);
    series
}

/// Curves of models against the length of rod, with points in any order, and dots at the points.
pub(super) fn against_rod(curves: impl IntoIterator<Item = Series>) -> Vec<Series> {
    let curves = curves.into_iter().filter(|curve| !curve.points.is_empty());
    let series = curves.flat_map(|mut curve| {
        curve.points.sort_by(|a, b| a.0.total_cmp(&b.0));
        let dots = dots(curve.colour, curve.points.clone());
        [curve, dots]
    });
    series.collect()
}

//! Line charts as SVG.

use crate::Colour;
use plotters::prelude::*;
use std::path::Path;

/// One line of a chart.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Name in the legend, if any.
    pub label: Option<String>,
    /// Colour.
    pub colour: Colour,
    /// Points in data coordinates.
    pub points: Vec<(f64, f64)>,
    /// Line, dashes or dots.
    pub mark: Mark,
}

/// Style of a series.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// A line.
    Line,
    /// A dashed line, which leaves lines below it visible.
    Dashes,
    /// A dot at each point.
    Dots,
}

/// A chart of lines and dots on linear axes. The legend is placed in the emptiest corner.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart<'a> {
    /// Text above the chart.
    pub title: &'a str,
    /// Quantity and unit of the horizontal axis.
    pub x_label: &'a str,
    /// Quantity and unit of the vertical axis.
    pub y_label: &'a str,
    /// Lines and dots, in drawing order.
    pub series: Vec<Series>,
    /// True for equal scales on both axes.
    pub equal_axes: bool,
}

/// Length of dashes and gaps in pixels.
const DASH: u32 = 8;
const SIZE: (u32, u32) = (900, 560);
/// Size of the plot area in pixels, for equal scales.
const PLANE: (f64, f64) = (800.0, 450.0);

impl Chart<'_> {
    /// Writes the chart to an SVG file.
    ///
    /// # Errors
    /// If the chart has no points, or the file cannot be written.
    pub fn draw(&self, path: &Path) -> Result<(), String> {
        let (x, y) = ranges(self).ok_or_else(|| format!("{}: nothing to draw", self.title))?;
        let root = SVGBackend::new(path, SIZE).into_drawing_area();
        render(self, &root, x, y).map_err(|e| format!("{}: {e}", path.display()))
    }
}

type Drawing<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;
type Outcome = Result<(), Box<dyn std::error::Error>>;

fn render(
    chart: &Chart<'_>,
    root: &Drawing<'_>,
    x: std::ops::Range<f64>,
    y: std::ops::Range<f64>,
) -> Outcome {
    root.fill(&WHITE)?;
    let mut plane = ChartBuilder::on(root)
        .caption(chart.title, ("sans-serif", 20))
        .margin(14)
        .x_label_area_size(46)
        .y_label_area_size(78)
        .build_cartesian_2d(x, y)?;
    plane
        .configure_mesh()
        .x_desc(chart.x_label)
        .y_desc(chart.y_label)
        .label_style(("sans-serif", 15))
        .axis_desc_style(("sans-serif", 16))
        .light_line_style(TRANSPARENT)
        .draw()?;
    for series in &chart.series {
        let colour = RGBColor::from(series.colour);
        let points = series.points.iter().copied();
        let drawn = match series.mark {
            Mark::Line => plane.draw_series(LineSeries::new(points, colour.stroke_width(2)))?,
            Mark::Dashes => {
                let style = colour.stroke_width(2);
                plane.draw_series(DashedLineSeries::new(points, DASH, DASH, style))?
            }
            Mark::Dots => plane.draw_series(points.map(|p| Circle::new(p, 2, colour.filled())))?,
        };
        if let Some(label) = &series.label {
            let mark = series.mark;
            drawn.label(label).legend(move |at| key(mark, colour, at));
        }
    }
    plane
        .configure_series_labels()
        .position(emptiest_corner(chart))
        .background_style(WHITE.mix(0.85))
        .border_style(BLACK.mix(0.3))
        .label_font(("sans-serif", 14))
        .draw()?;
    Ok(root.present()?)
}

fn key<'a>(
    mark: Mark,
    colour: RGBColor,
    (x, y): (i32, i32),
) -> DynElement<'static, SVGBackend<'a>, (i32, i32)> {
    if mark == Mark::Dots {
        Circle::new((x + 11, y), 2, colour.filled()).into_dyn()
    } else {
        PathElement::new([(x, y), (x + 22, y)], colour.stroke_width(3)).into_dyn()
    }
}

fn along(series: &Series) -> Vec<(f64, f64)> {
    if series.mark == Mark::Dots {
        return series.points.clone();
    }
    let stretches = series.points.windows(2);
    let steps = stretches.flat_map(|pair| {
        (0..STEPS).map(move |k| {
            let t = f64::from(k) / f64::from(STEPS);
            let between = |from: f64, to: f64| from + t * (to - from);
            (between(pair[0].0, pair[1].0), between(pair[0].1, pair[1].1))
        })
    });
    steps.collect()
}

const STEPS: u8 = 8;

fn emptiest_corner(chart: &Chart<'_>) -> SeriesLabelPosition {
    let Some((x, y)) = ranges(chart) else {
        return SeriesLabelPosition::UpperRight;
    };
    let share = |value: f64, range: &std::ops::Range<f64>| {
        (value - range.start) / (range.end - range.start)
    };
    let points = chart.series.iter().flat_map(along);
    let places: Vec<(f64, f64)> = points.map(|p| (share(p.0, &x), share(p.1, &y))).collect();
    let hidden = |right: bool, upper: bool| {
        let is_hidden = |p: &&(f64, f64)| {
            let horizontal = if right { 1.0 - p.0 } else { p.0 };
            let vertical = if upper { 1.0 - p.1 } else { p.1 };
            horizontal < LEGEND.0 && vertical < LEGEND.1
        };
        places.iter().filter(is_hidden).count()
    };
    let corners = [
        (hidden(true, true), SeriesLabelPosition::UpperRight),
        (hidden(true, false), SeriesLabelPosition::LowerRight),
        (hidden(false, true), SeriesLabelPosition::UpperLeft),
        (hidden(false, false), SeriesLabelPosition::LowerLeft),
    ];
    let emptiest = corners.into_iter().min_by_key(|(count, _)| *count);
    emptiest.map_or(SeriesLabelPosition::UpperRight, |(_, corner)| corner)
}

/// Size of the legend relative to the plot area.
const LEGEND: (f64, f64) = (0.25, 0.45);

/// Returns data ranges with a margin, with equal scales if requested.
fn ranges(chart: &Chart<'_>) -> Option<(std::ops::Range<f64>, std::ops::Range<f64>)> {
    let points = || chart.series.iter().flat_map(|s| &s.points);
    points().next()?;
    let span = |pick: fn(&(f64, f64)) -> f64| {
        let low = points().map(pick).fold(f64::INFINITY, f64::min);
        let high = points().map(pick).fold(f64::NEG_INFINITY, f64::max);
        let margin = (0.05 * (high - low)).max(1e-9 * high.abs()).max(1e-12);
        (low - margin, high + margin)
    };
    let (mut x, mut y) = (span(|p| p.0), span(|p| p.1));
    if chart.equal_axes {
        let scale = ((x.1 - x.0) / PLANE.0).max((y.1 - y.0) / PLANE.1);
        x = widen(x, scale * PLANE.0);
        y = widen(y, scale * PLANE.1);
    }
    Some((x.0..x.1, y.0..y.1))
}

fn widen((low, high): (f64, f64), width: f64) -> (f64, f64) {
    let middle = 0.5 * (low + high);
    (middle - 0.5 * width, middle + 0.5 * width)
}

//! Cost against error of one scene on logarithmic axes, as SVG: points by factor, numbered, with a
//! list of what the numbers are, and the Pareto front as a line.

use super::pareto;
use super::row::Row;
use super::study::Factor;
use plotters::coord::Shift;
use plotters::prelude::*;
use std::path::Path;

/// An error of a row, and the scatter that stands beside it.
pub(super) type Pick = fn(&Row) -> Option<f64>;

/// A picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Picture<'a> {
    pub title: &'a str,
    pub y_label: &'a str,
    pub rows: &'a [Row],
    pub error: Pick,
    pub scatter: Pick,
}

/// Pixels of the picture, and of the plot in it.
const SIZE: (u32, u32) = (1240, 720);
const PLOT_WIDTH: u32 = 840;
/// Font of labels.
const FONT: (&str, i32) = ("sans-serif", 13);
/// Height of a line of the list, in pixels.
const LINE: i32 = 16;

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Outcome = Result<(), Box<dyn std::error::Error>>;

/// One point: its place, its colour and what it is.
struct Point {
    place: (f64, f64),
    colour: RGBColor,
    name: String,
    on_front: bool,
}

/// Draws `picture` into the SVG file `path`; nothing if no row has such an error.
///
/// # Errors
/// A file that cannot be written.
pub(super) fn draw(picture: &Picture<'_>, path: &Path) -> Result<(), String> {
    let points = points(picture);
    if points.is_empty() {
        return Ok(());
    }
    let root = SVGBackend::new(path, SIZE).into_drawing_area();
    render(picture, &points, &root).map_err(|e| format!("{}: {e}", path.display()))
}

/// The points of a picture, cheapest first. What has no error at all, the reference, has no place
/// on a logarithmic axis.
fn points(picture: &Picture<'_>) -> Vec<Point> {
    let place = |row: &Row| row.cost_motion.zip((picture.error)(row));
    let rows: Vec<(&Row, (f64, f64))> = picture
        .rows
        .iter()
        .filter_map(|row| Some((row, place(row)?)))
        .collect();
    let front = pareto::front(&rows.iter().map(|r| r.1).collect::<Vec<_>>());
    let mut points: Vec<Point> = rows
        .iter()
        .zip(front)
        .filter(|((_, (_, error)), _)| *error > 0.0)
        .map(|((row, place), on_front)| Point {
            place: *place,
            colour: colour(&row.factor),
            name: row.setting.clone(),
            on_front,
        })
        .collect();
    points.sort_by(|a, b| a.place.0.total_cmp(&b.place.0));
    points
}

/// The colour of a factor; integrators follow the same order.
fn colour(factor: &str) -> RGBColor {
    const COLOURS: [RGBColor; 9] = [
        RGBColor(60, 60, 60),
        RGBColor(30, 90, 180),
        RGBColor(200, 40, 40),
        RGBColor(20, 140, 70),
        RGBColor(150, 60, 170),
        RGBColor(220, 130, 0),
        RGBColor(120, 80, 40),
        RGBColor(0, 150, 170),
        RGBColor(110, 110, 110),
    ];
    const INTEGRATORS: [&str; 5] = ["PositionVerlet", "Pefrl", "Vefrl", "ForestRuth", "Suzuki"];
    let known = Factor::ALL.iter().position(|f| f.name() == factor);
    let method = INTEGRATORS.iter().position(|name| *name == factor);
    COLOURS[known.or(method.map(|i| i + 1)).unwrap_or(0)]
}

fn render(picture: &Picture<'_>, points: &[Point], root: &Area<'_>) -> Outcome {
    root.fill(&WHITE)?;
    let (left, right) = root.split_horizontally(PLOT_WIDTH);
    let ((x0, x1), (y0, y1)) = (
        decades(points.iter().map(|p| p.place.0)),
        decades(points.iter().map(|p| p.place.1)),
    );
    let mut plane = ChartBuilder::on(&left)
        .caption(picture.title, ("sans-serif", 20))
        .margin(14)
        .x_label_area_size(46)
        .y_label_area_size(78)
        .build_cartesian_2d((x0..x1).log_scale(), (y0..y1).log_scale())?;
    plane
        .configure_mesh()
        .x_desc("cost of a motion: bonds and elements evaluated, of the reference as 1")
        .y_desc(picture.y_label)
        .x_label_formatter(&|v| format!("{v:.0e}"))
        .y_label_formatter(&|v| format!("{v:.0e}"))
        .label_style(("sans-serif", 14))
        .axis_desc_style(("sans-serif", 16))
        .light_line_style(BLACK.mix(0.06))
        .draw()?;
    let scatter = picture.rows.first().and_then(picture.scatter);
    if let Some(level) = scatter.filter(|level| (y0..y1).contains(level)) {
        let line = [(x0, level), (x1, level)];
        plane.draw_series([PathElement::new(line, BLACK.mix(0.35).stroke_width(1))])?;
        let text = Text::new("sd over filaments of 64 drawn bonds", (6, -16), FONT);
        plane.draw_series([EmptyElement::at((x0, level)) + text])?;
    }
    let front = points.iter().filter(|p| p.on_front).map(|p| p.place);
    plane.draw_series(LineSeries::new(front, BLACK.stroke_width(2)))?;
    for (i, point) in points.iter().enumerate() {
        let style = FONT.into_font().color(&point.colour);
        let dot = EmptyElement::at(point.place)
            + Circle::new((0, 0), 4, point.colour.filled())
            + Text::new((i + 1).to_string(), (6, -14), style);
        plane.draw_series([dot])?;
    }
    list(points, &right)?;
    Ok(root.present()?)
}

/// What the numbers are, cheapest first; those of the front are marked.
fn list(points: &[Point], area: &Area<'_>) -> Outcome {
    let black = FONT.into_font().color(&BLACK);
    area.draw(&Text::new(
        "line: Pareto front, its points marked *",
        (0, 20),
        black,
    ))?;
    for (y, (i, point)) in (0..).map(|k| 44 + k * LINE).zip(points.iter().enumerate()) {
        let mark = if point.on_front { "*" } else { "" };
        let text = format!("{:2}{mark} {}", i + 1, point.name);
        let style = FONT.into_font().color(&point.colour);
        area.draw(&Text::new(text, (0, y), style))?;
    }
    Ok(())
}

/// The range of values on a logarithmic axis, a little wider than they are.
fn decades(values: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
    let low = values.clone().fold(f64::INFINITY, f64::min);
    let high = values.fold(0.0, f64::max);
    (low / 1.6, high * 1.6)
}

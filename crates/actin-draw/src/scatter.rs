//! Points on logarithmic axes as SVG: numbered, with a list of what the numbers are, and a line
//! through those that stand out.

use crate::Colour;
use plotters::coord::Shift;
use plotters::prelude::*;
use std::path::Path;

/// A picture of points on two logarithmic axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Scatter<'a> {
    /// Text above the picture.
    pub title: &'a str,
    /// Quantity and unit of the horizontal axis.
    pub x_label: &'a str,
    /// Quantity and unit of the vertical axis.
    pub y_label: &'a str,
    /// Points, numbered in this order.
    pub points: Vec<ScatterPoint>,
    /// A height above zero at which a line across is drawn, and what it is.
    pub level: Option<(f64, &'a str)>,
    /// Text above the list of points.
    pub list_title: &'a str,
}

/// One point of a [`Scatter`].
#[derive(Clone, Debug, PartialEq)]
pub struct ScatterPoint {
    /// Its place in data coordinates, both above zero.
    pub place: (f64, f64),
    /// Its colour, in the plot and in the list.
    pub colour: Colour,
    /// What it is.
    pub name: String,
    /// Whether the line goes through it, in the order of the points; such points are marked `*`.
    pub on_front: bool,
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

impl Scatter<'_> {
    /// Draws the picture into the SVG file `path`; nothing if there is no point.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn draw(&self, path: &Path) -> Result<(), String> {
        if self.points.is_empty() {
            return Ok(());
        }
        let root = SVGBackend::new(path, SIZE).into_drawing_area();
        render(self, &root).map_err(|e| format!("{}: {e}", path.display()))
    }
}

impl Scatter<'_> {
    /// The ranges of both axes, with the level in the vertical one.
    fn ranges(&self) -> ((f64, f64), (f64, f64)) {
        let places = || self.points.iter().map(|point| point.place);
        let level = self.level.map(|(level, _)| level);
        let heights = places().map(|(_, y)| y).chain(level);
        (decades(places().map(|(x, _)| x)), decades(heights))
    }
}

fn render(picture: &Scatter<'_>, root: &Area<'_>) -> Outcome {
    let points = &picture.points;
    root.fill(&WHITE)?;
    let (left, right) = root.split_horizontally(PLOT_WIDTH);
    let ((x0, x1), (y0, y1)) = picture.ranges();
    let mut plane = ChartBuilder::on(&left)
        .caption(picture.title, ("sans-serif", 20))
        .margin(14)
        .x_label_area_size(46)
        .y_label_area_size(78)
        .build_cartesian_2d((x0..x1).log_scale(), (y0..y1).log_scale())?;
    plane
        .configure_mesh()
        .x_desc(picture.x_label)
        .y_desc(picture.y_label)
        .x_label_formatter(&|v| format!("{v:.0e}"))
        .y_label_formatter(&|v| format!("{v:.0e}"))
        .label_style(("sans-serif", 14))
        .axis_desc_style(("sans-serif", 16))
        .light_line_style(BLACK.mix(0.06))
        .draw()?;
    if let Some((level, what)) = picture.level {
        let line = [(x0, level), (x1, level)];
        plane.draw_series([PathElement::new(line, BLACK.mix(0.35).stroke_width(1))])?;
        let text = Text::new(what.to_owned(), (6, -16), FONT);
        plane.draw_series([EmptyElement::at((x0, level)) + text])?;
    }
    let front = points.iter().filter(|p| p.on_front).map(|p| p.place);
    plane.draw_series(LineSeries::new(front, BLACK.stroke_width(2)))?;
    for (i, point) in points.iter().enumerate() {
        let (colour, style) = painted(point);
        let dot = EmptyElement::at(point.place)
            + Circle::new((0, 0), 4, colour.filled())
            + Text::new((i + 1).to_string(), (6, -14), style);
        plane.draw_series([dot])?;
    }
    list(picture, &right)?;
    Ok(root.present()?)
}

/// The colour of a point, and its text in that colour.
fn painted(point: &ScatterPoint) -> (RGBColor, TextStyle<'static>) {
    let colour = RGBColor::from(point.colour);
    (colour, FONT.into_font().color(&colour))
}

/// What the numbers are; those of the front are marked.
fn list(picture: &Scatter<'_>, area: &Area<'_>) -> Outcome {
    let black = FONT.into_font().color(&BLACK);
    area.draw(&Text::new(picture.list_title, (0, 20), black))?;
    let points = picture.points.iter().enumerate();
    for (y, (i, point)) in (0..).map(|k| 44 + k * LINE).zip(points) {
        let mark = if point.on_front { "*" } else { "" };
        let text = format!("{:2}{mark} {}", i + 1, point.name);
        let (_, style) = painted(point);
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

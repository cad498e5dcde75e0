//! Scatter plots on logarithmic axes as SVG, with numbered points, a list of their names, and a line through the
//! front.

use crate::Colour;
use plotters::coord::Shift;
use plotters::prelude::*;
use std::path::Path;

/// A scatter plot on two logarithmic axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Scatter<'a> {
    /// Title.
    pub title: &'a str,
    /// Quantity and unit of the horizontal axis.
    pub x_label: &'a str,
    /// Quantity and unit of the vertical axis.
    pub y_label: &'a str,
    /// Points, numbered in this order.
    pub points: Vec<ScatterPoint>,
    /// Position and label of a horizontal line, if any; must be positive.
    pub level: Option<(f64, &'a str)>,
    /// Heading of the list of points.
    pub list_title: &'a str,
}

/// A point of a [`Scatter`].
#[derive(Clone, Debug, PartialEq)]
pub struct ScatterPoint {
    /// Position in data coordinates, both positive.
    pub place: (f64, f64),
    /// Colour in the plot and in the list.
    pub colour: Colour,
    /// Name.
    pub name: String,
    /// True for points on the line, which connects them in order. They are marked `*`.
    pub on_front: bool,
}

/// Size of the picture and width of the plot in pixels.
const SIZE: (u32, u32) = (1240, 720);
const PLOT_WIDTH: u32 = 840;
const FONT: (&str, i32) = ("sans-serif", 13);
const LINE: i32 = 16;

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Outcome = Result<(), Box<dyn std::error::Error>>;

impl Scatter<'_> {
    /// Writes the plot to an SVG file. Without points, no file is written.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn draw(&self, path: &Path) -> Result<(), String> {
        if self.points.is_empty() {
            return Ok(());
        }
        let root = SVGBackend::new(path, SIZE).into_drawing_area();
        render(self, &root).map_err(|e| format!("{}: {e}", path.display()))
    }
}

impl Scatter<'_> {
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

fn painted(point: &ScatterPoint) -> (RGBColor, TextStyle<'static>) {
    let colour = RGBColor::from(point.colour);
    (colour, FONT.into_font().color(&colour))
}

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

fn decades(values: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
    let low = values.clone().fold(f64::INFINITY, f64::min);
    let high = values.fold(0.0, f64::max);
    (low / 1.6, high * 1.6)
}

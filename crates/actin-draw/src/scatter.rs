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
const FONT: (&str, i32) = ("sans-serif", 14);
const LINE: i32 = 18;
/// Offsets of the number of a point (pixels), in order of preference, and the size of a number.
const OFFSETS: [(i32, i32); 6] = [(6, -15), (6, 3), (-22, -15), (-22, 3), (6, -31), (-22, -31)];
const NUMBER: (i32, i32) = (18, 14);

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
        .x_label_formatter(&|value| tick(*value))
        .y_label_formatter(&|value| tick(*value))
        .label_style(("sans-serif", 14))
        .axis_desc_style(("sans-serif", 16))
        .bold_line_style(BLACK.mix(0.12))
        .light_line_style(TRANSPARENT)
        .draw()?;
    if let Some((level, what)) = picture.level {
        let line = [(x0, level), (x1, level)];
        plane.draw_series([PathElement::new(line, BLACK.mix(0.35))])?;
        let text = Text::new(what.to_owned(), (6, -16), FONT);
        plane.draw_series([EmptyElement::at(line[0]) + text])?;
    }
    let front = points.iter().filter(|p| p.on_front).map(|p| p.place);
    plane.draw_series(LineSeries::new(front, BLACK.stroke_width(2)))?;
    let places = points.iter().map(|p| plane.backend_coord(&p.place));
    let offsets = offsets(&places.collect::<Vec<_>>());
    for (i, (point, offset)) in points.iter().zip(offsets).enumerate() {
        let dot = EmptyElement::at(point.place)
            + Circle::new((0, 0), 4, RGBColor::from(point.colour).filled())
            + Text::new((i + 1).to_string(), offset, FONT);
        plane.draw_series([dot])?;
    }
    list(picture, &right)?;
    Ok(root.present()?)
}

/// Label of a tick: 1, 2 and 5 times a power of ten only, so that labels do not overlap.
fn tick(value: f64) -> String {
    let power = value.log10().floor();
    let digit = (value / 10_f64.powf(power)).round();
    if ![1.0, 2.0, 5.0, 10.0].contains(&digit) {
        String::new()
    } else if (-3.0..5.0).contains(&power) {
        crate::page::significant(value)
    } else {
        format!("{value:.0e}")
    }
}

/// Returns the offset of the number of each point (pixels), such that numbers cover neither numbers nor points if there
/// is space.
fn offsets(places: &[(i32, i32)]) -> Vec<(i32, i32)> {
    let mut taken: Vec<(i32, i32)> = Vec::new();
    let apart = |a: (i32, i32), b: (i32, i32), (width, height): (i32, i32)| {
        (a.0 - b.0).abs() >= width || (a.1 - b.1).abs() >= height
    };
    let mut all = Vec::new();
    for place in places {
        let corner = |offset: (i32, i32)| (place.0 + offset.0, place.1 + offset.1);
        let is_free = |offset: &&(i32, i32)| {
            let (x, y) = corner(**offset);
            let middle = (x + NUMBER.0 / 2, y + NUMBER.1 / 2);
            taken.iter().all(|other| apart((x, y), *other, NUMBER))
                && places.iter().all(|other| apart(middle, *other, (9, 9)))
        };
        let offset = *OFFSETS.iter().find(is_free).unwrap_or(&OFFSETS[0]);
        taken.push(corner(offset));
        all.push(offset);
    }
    all
}

fn list(picture: &Scatter<'_>, area: &Area<'_>) -> Outcome {
    let black = FONT.into_font().color(&BLACK);
    area.draw(&Text::new(picture.list_title, (0, 20), black))?;
    let points = picture.points.iter().enumerate();
    for (y, (i, point)) in (0..).map(|k| 44 + k * LINE).zip(points) {
        let mark = if point.on_front { "*" } else { "" };
        let text = format!("{:2}{mark} {}", i + 1, point.name);
        area.draw(&Circle::new(
            (5, y + 7),
            4,
            RGBColor::from(point.colour).filled(),
        ))?;
        area.draw(&Text::new(text, (16, y), FONT))?;
    }
    Ok(())
}

fn decades(values: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
    let low = values.clone().fold(f64::INFINITY, f64::min);
    let high = values.fold(0.0, f64::max);
    (low / 1.6, high * 1.6)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_have_digits_1_2_and_5() {
        let labels = [0.01, 0.02, 0.03, 0.05, 0.09, 0.1, 1e-6].map(tick);
        assert_eq!(labels, ["0.01", "0.02", "", "0.05", "", "0.1", "1e-6"]);
    }

    #[test]
    fn numbers_of_close_points_are_apart() {
        let places = [(100, 100), (103, 101), (99, 104)];
        let found: Vec<(i32, i32)> = offsets(&places)
            .iter()
            .zip(places)
            .map(|(o, p)| (o.0 + p.0, o.1 + p.1))
            .collect();
        for (i, a) in found.iter().enumerate() {
            for b in &found[..i] {
                let gap = ((a.0 - b.0).abs(), (a.1 - b.1).abs());
                assert!(gap.0 >= NUMBER.0 || gap.1 >= NUMBER.1, "{found:?}");
            }
        }
        assert_eq!(offsets(&[(100, 100), (300, 100)]), [OFFSETS[0]; 2]);
    }
}

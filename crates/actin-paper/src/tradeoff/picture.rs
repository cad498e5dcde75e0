//! Cost against error of one scene: points by factor and the Pareto front as a line.

use super::pareto;
use super::row::Row;
use super::study::Factor;
use actin_draw::{Colour, Scatter, ScatterPoint};
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

/// Draws `picture` into the SVG file `path`; nothing if no row has such an error.
///
/// # Errors
/// A file that cannot be written.
pub(super) fn draw(picture: &Picture<'_>, path: &Path) -> Result<(), String> {
    let scatter = picture.rows.first().and_then(picture.scatter);
    let picture = Scatter {
        title: picture.title,
        x_label: "time of a motion, or its evaluations, of the reference as 1",
        y_label: picture.y_label,
        points: points(picture),
        level: scatter.map(|level| (level, "sd over filaments of 64 drawn bonds")),
        list_title: "line: Pareto front, its points marked *",
    };
    picture.draw(path)
}

/// The points of a picture, cheapest first. What has no error at all, the reference, has no place
/// on a logarithmic axis.
fn points(picture: &Picture<'_>) -> Vec<ScatterPoint> {
    let is_timed = picture.rows.iter().any(|row| row.time_motion.is_some());
    let cost = |row: &Row| {
        if is_timed {
            row.time_motion
        } else {
            row.cost_motion
        }
    };
    let place = |row: &Row| cost(row).zip((picture.error)(row));
    let rows: Vec<(&Row, (f64, f64))> = picture
        .rows
        .iter()
        .filter_map(|row| Some((row, place(row)?)))
        .collect();
    let front = pareto::front(&rows.iter().map(|r| r.1).collect::<Vec<_>>());
    let mut points: Vec<ScatterPoint> = rows
        .iter()
        .zip(front)
        .filter(|((_, (_, error)), _)| *error > 0.0)
        .map(|((row, place), on_front)| ScatterPoint {
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
fn colour(factor: &str) -> Colour {
    const COLOURS: [Colour; Factor::ALL.len()] = [
        Colour([60, 60, 60]),
        Colour([0, 60, 100]),
        Colour([30, 90, 180]),
        Colour([200, 40, 40]),
        Colour([20, 140, 70]),
        Colour([150, 60, 170]),
        Colour([220, 130, 0]),
        Colour([120, 80, 40]),
        Colour([0, 150, 170]),
        Colour([110, 110, 110]),
    ];
    const INTEGRATORS: [&str; 5] = ["PositionVerlet", "Pefrl", "Vefrl", "ForestRuth", "Suzuki"];
    let known = Factor::ALL.iter().position(|f| f.name() == factor);
    let method = INTEGRATORS.iter().position(|name| *name == factor);
    COLOURS[known.or(method.map(|i| i + 1)).unwrap_or(0)]
}

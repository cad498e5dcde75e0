//! Pictures of the grid.

use super::rows::Row;
use actin_draw::{Chart, Ramp, Series};
use std::path::Path;

/// What is drawn over the strain of place `x`, one line per value of the strain of place `by` (5 is the
/// extension), all others fixed.
struct Picture<'a> {
    file: &'a str,
    title: &'a str,
    x: (usize, &'a str),
    by: (usize, &'a str),
    y_label: &'a str,
    y: fn(&Row) -> f64,
    /// Places and values of what is fixed.
    fixed: &'a [(usize, f64)],
    least: f64,
}

const PICTURES: [Picture<'_>; 6] = [
    Picture {
        file: "energy-twist.svg",
        title: "Energy of the straight filament",
        x: (1, "twist (rad/nm)"),
        by: (5, "extension"),
        y_label: "energy per length (pN)",
        y: |row| row.energy,
        fixed: &[(0, 0.0), (2, 0.0)],
        least: -1.0,
    },
    Picture {
        file: "energy-shear.svg",
        title: "Energy of the sheared filament without twist",
        x: (2, "shear strain"),
        by: (5, "extension"),
        y_label: "energy per length (pN)",
        y: |row| row.energy,
        fixed: &[(0, 0.0), (1, 0.0)],
        least: -1.0,
    },
    Picture {
        file: "tension-shear.svg",
        title: "Tension of the sheared filament without twist",
        x: (2, "shear strain"),
        by: (5, "extension"),
        y_label: "tension (pN)",
        y: |row| row.loads[5],
        fixed: &[(0, 0.0), (1, 0.0)],
        least: -1.0,
    },
    Picture {
        file: "shear-force.svg",
        title: "Shear force, length of the free filament",
        x: (2, "shear strain"),
        by: (1, "twist (rad/nm)"),
        y_label: "shear force (pN)",
        y: |row| row.loads[3],
        fixed: &[(0, 0.0), (5, 0.0)],
        least: -1.0,
    },
    Picture {
        file: "bending-rigidity.svg",
        title: "Secant bending rigidity, length of the free filament",
        x: (0, "curvature (rad/nm)"),
        by: (1, "twist (rad/nm)"),
        y_label: "couple over curvature (pN nm^2)",
        y: |row| row.loads[0] / row.strain[0],
        fixed: &[(2, 0.0), (5, 0.0)],
        least: 1e-9,
    },
    Picture {
        file: "coupling.svg",
        title: "Derivative of the couple by shear along it, straight filament",
        x: (1, "twist (rad/nm)"),
        by: (5, "extension"),
        y_label: "bend-shear coupling (pN nm)",
        y: |row| row.tangent[(0, 3)],
        fixed: &[(0, 0.0), (2, 0.0)],
        least: -1.0,
    },
];

/// Draws all.
pub(super) fn draw(out: &Path, rows: &[Row]) -> Result<(), String> {
    PICTURES
        .iter()
        .try_for_each(|picture| picture.draw(out, rows))
}

/// Most lines of a picture.
const LINES: usize = 9;

/// Every how many of so many lines are drawn, so that the first, the middle and the last are among them.
fn stride(lines: usize) -> usize {
    let is_even = |s: &usize| (lines - 1).is_multiple_of(2 * s) && (lines - 1) / s < LINES;
    let found = (2..lines).find(is_even).filter(|_| lines > LINES);
    found.unwrap_or(1)
}

/// A strain of a row, or its extension.
fn strain(row: &Row, place: usize) -> f64 {
    row.strain.get(place).copied().unwrap_or(row.extension)
}

impl Picture<'_> {
    fn draw(&self, out: &Path, rows: &[Row]) -> Result<(), String> {
        let is_fixed = |row: &&Row| {
            let same = |&(place, value): &(usize, f64)| (strain(row, place) - value).abs() < 1e-12;
            self.fixed.iter().all(same) && strain(row, self.x.0).abs() > self.least
        };
        let mut chosen: Vec<&Row> = rows.iter().filter(is_fixed).collect();
        chosen.sort_by(|a, b| strain(a, self.x.0).total_cmp(&strain(b, self.x.0)));
        let mut values: Vec<f64> = chosen.iter().map(|row| strain(row, self.by.0)).collect();
        values.sort_by(f64::total_cmp);
        values.dedup();
        let values: Vec<f64> = values
            .iter()
            .step_by(stride(values.len()))
            .copied()
            .collect();
        let last = (values.len().max(2) - 1) as f64;
        let series = values.iter().enumerate().map(|(k, &value)| {
            let of_value = chosen.iter().filter(|row| {
                let differs = strain(row, self.by.0).total_cmp(&value);
                differs.is_eq()
            });
            Series {
                label: Some(format!("{} {value}", self.by.1)),
                colour: Ramp::RED_YELLOW_BLUE.at(k as f64 / last),
                points: of_value
                    .map(|row| (strain(row, self.x.0), (self.y)(row)))
                    .collect(),
                dots: false,
            }
        });
        let chart = Chart {
            title: self.title,
            x_label: self.x.1,
            y_label: self.y_label,
            series: series.collect(),
            equal_axes: false,
        };
        chart.draw(&out.join(self.file))
    }
}

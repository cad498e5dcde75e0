//! Sections of the energy surface: the law `Homogenised` as lines, relaxed cells as dots.

use super::charts::{dots, line};
use super::draft::Draft;
use super::texts::{ChartText, Values};
use crate::cells::{mean, strain, twisted};
use actin_cosserat::Homogenised;
use actin_draw::Ramp;
use actin_sim::ellipsoid::{Cell, SixVector};
use actin_sim::read_ron;
use rayon::prelude::*;
use serde::Deserialize;

/// Curvature (rad/nm), twist (rad/nm), shear, extension.
type Point = [f64; 4];

/// Section of the energy surface: energy against one strain, with a curve for each value of another.
#[derive(Debug, Deserialize)]
struct Cut {
    file: String,
    title: String,
    /// Index in [`Point`] and name of the strain on the axis.
    over: (usize, String),
    range: [f64; 2],
    by: (usize, String),
    values: [f64; 4],
}

#[derive(Debug, Deserialize)]
struct Surface {
    cuts: Vec<Cut>,
}

/// Intervals of a line, and of the computed cells.
const POINTS: u32 = 60;
const CELLS: u32 = 12;

pub(super) fn draw(draft: &mut Draft<'_>) -> Result<(), String> {
    let cell = mean()?;
    let law = Homogenised::mean_filament();
    let surface: Surface = read_ron(include_str!("../../data/surface.ron"), "Surface")
        .map_err(|e| format!("data/surface.ron: {e}"))?;
    let mut cuts = surface.cuts.iter();
    cuts.try_for_each(|cut| cut.draw(&cell, law, draft))
}

impl Cut {
    fn draw(&self, cell: &Cell, law: &Homogenised, draft: &mut Draft<'_>) -> Result<(), String> {
        let mut series = Vec::new();
        for (k, value) in self.values.into_iter().enumerate() {
            let colour = Ramp::RED_YELLOW_BLUE.at(k as f64 / (self.values.len() - 1) as f64);
            let places = self.places(value, POINTS);
            let of_law = places.map(|(x, point)| (x, law.energy_density(&six(law, point))));
            let label = format!("{} {value}", self.by.1);
            series.push(line(label, colour, of_law.collect()));
            let cells: Vec<_> = self.places(value, CELLS).collect();
            let energy = |&(x, point): &(f64, Point)| -> Result<(f64, f64), String> {
                let start = twisted(cell, point[1])?;
                let relaxed = cell.relax(&six(law, point), Some(&start.displacements));
                Ok((x, relaxed.map_err(|e| e.to_string())?.energy))
            };
            let points: Result<_, String> = cells.par_iter().map(energy).collect();
            series.push(dots(colour, points?));
        }
        let values: Values<'_> = &[("title", &self.title), ("strain", &self.over.1)];
        draft.plot(&*self.file, &ChartText::new("surface", values)?, series)
    }

    /// Strains along the curve of a value, with their abscissae.
    fn places(&self, value: f64, count: u32) -> impl Iterator<Item = (f64, Point)> {
        let ([from, to], by, over) = (self.range, self.by.0, self.over.0);
        (0..=count).map(move |n| {
            let x = from + (to - from) * f64::from(n) / f64::from(count);
            let mut point = [0.0; 4];
            point[by] = value;
            point[over] = x;
            (x, point)
        })
    }
}

fn six(law: &Homogenised, [curvature, twist, shear, extension]: Point) -> SixVector {
    let stretch = law.form().natural_stretch(twist) + extension;
    strain([curvature, twist, shear, stretch, 0.0])
}

//! Cells at strains all over a region, and others to test the law on.

use super::super::axes::Axes;
use super::super::region::{self, Region, evenly};
use super::super::rows::Row;
use super::RANGE;
use actin_cosserat::HomogenisedForm;
use actin_paper::cells::{mean, shortening, strain, twisted};
use actin_sim::ellipsoid::{Cell, SixVector};
use rayon::prelude::*;

/// Strains within the range, stretched by up to 3e-3, that are no points of the grid, others for each `seed`.
pub(super) fn other_rows(
    cell: &Cell,
    axes: &Axes,
    seed: u64,
    count: u64,
) -> Result<Vec<Row>, String> {
    let last = |values: &[f64]| values[values.len() - 1];
    let (twist, stretch) = (last(&axes.twist), last(&axes.extension).min(3e-3));
    let draw = |k: u64| {
        let [a, b, c, d, e] = evenly(k);
        // Small twists and extensions are more common than large ones.
        let side: f64 = 2.0 * b - 1.0;
        let point = [
            RANGE.curvature * a,
            twist * side * side * side,
            RANGE.shear * c,
            0.0,
            360.0 * d,
        ];
        (point, stretch * e * e)
    };
    let first = seed * count + 1;
    let points: Vec<([f64; 5], f64)> = (first..first + count).map(draw).collect();
    let mean = mean()?;
    let row = |&(mut point, extension): &([f64; 5], f64)| {
        let natural = twisted(&mean, point[1])?;
        point[3] = natural.strain[5] + extension - shortening(point[0], point[2]);
        let own = twisted(cell, point[1])?;
        let [k, twist, shear, stretch, angle] = point;
        let strain = strain([k, twist, shear, stretch, angle.to_radians()]);
        let response = cell
            .relax(&strain, Some(&own.displacements))
            .map_err(|e| e.to_string())?;
        Ok(Row::new(point, extension, &response))
    };
    points.par_iter().map(row).collect()
}

/// Cells at `count` strains of each region, but for those without an equilibrium.
pub(super) fn strained(
    cells: &[Cell],
    form: &HomogenisedForm,
    regions: &[(Region, u64)],
) -> Result<Vec<Row>, String> {
    let strains = region::strains(form, regions);
    let row = |(k, strain): (usize, &SixVector)| {
        let [k1, k2, twist, shear, _, stretch]: [f64; 6] = (*strain).into();
        let cell = &cells[k % cells.len()];
        let natural = twisted(cell, twist)?;
        let curvature = k1.hypot(k2);
        let point = [curvature, twist, shear, stretch, k2.atan2(k1).to_degrees()];
        let extension = stretch - natural.strain[5] + shortening(curvature, shear);
        let response = cell.relax(strain, Some(&natural.displacements));
        Ok(response
            .ok()
            .map(|found| Row::new(point, extension, &found)))
    };
    of_all(strains.par_iter().enumerate().map(row))
}

/// The strains and extensions of some rows, each on the next of some cells, but for those without an equilibrium.
pub(super) fn again(cells: &[Cell], rows: &[&Row]) -> Result<Vec<Row>, String> {
    let row = |(k, row): (usize, &&Row)| {
        let [curvature, twist, shear, _, angle] = row.strain;
        let cell = &cells[k % cells.len()];
        let natural = twisted(cell, twist)?;
        let stretch = natural.strain[5] + row.extension - shortening(curvature, shear);
        let point = [curvature, twist, shear, stretch, angle];
        let strain = strain([curvature, twist, shear, stretch, angle.to_radians()]);
        let response = cell.relax(&strain, Some(&natural.displacements));
        Ok((response.ok()).map(|found| Row::new(point, row.extension, &found)))
    };
    of_all(rows.par_iter().enumerate().map(row))
}

/// Those that there are.
fn of_all(
    rows: impl ParallelIterator<Item = Result<Option<Row>, String>>,
) -> Result<Vec<Row>, String> {
    let rows: Vec<Option<Row>> = rows.collect::<Result<_, String>>()?;
    Ok(rows.into_iter().flatten().collect())
}

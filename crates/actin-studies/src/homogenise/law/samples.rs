//! Cells at strains that fill a region.

use super::super::region::{self, Region};
use super::super::rows::Row;
use actin_cosserat::HomogenisedForm;
use actin_paper::cells::{shortening, strain, twisted};
use actin_sim::ellipsoid::{Cell, SixVector};
use rayon::prelude::*;

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

fn of_all(
    rows: impl ParallelIterator<Item = Result<Option<Row>, String>>,
) -> Result<Vec<Row>, String> {
    let rows: Vec<Option<Row>> = rows.collect::<Result<_, String>>()?;
    Ok(rows.into_iter().flatten().collect())
}

//! The law of filaments with sampled bonds, fitted to cells with different bonds.
//!
//! Under a given load, the mean strain of a filament is the mean over its sections. The fit therefore uses the mean
//! strain of several cells under the same load. Averaging stiffnesses instead would overestimate the rigidity.

use super::super::axes::Axes;
use super::super::fit::coefficients;
use super::super::rows::{self, Row};
use super::tables::{stability, under_loads};
use super::{
    BENT, LOADED, OTHER_LOADED, POSITIVITY, STRAINED, fitted_form, loaded, normal, samples,
};
use actin_cosserat::HomogenisedForm;
use actin_draw::report::save;
use actin_paper::cells::{self, PERIOD, twisted};
use actin_sim::ellipsoid::Cell;
use rayon::prelude::*;
use std::path::Path;

/// Number of cells, and first seeds of fitted and of validation cells. Load cases use other seeds.
const CELLS: u64 = 32;
const FITTED: u64 = 10_001;
const OTHERS: u64 = 20_001;
/// Number of cells under each load. With a single cell, its own bonds would bias the stiffness under small loads by
/// the squared scatter.
const EACH: usize = 4;
/// Version of stored rows; changed with the loads.
const VERSION: u32 = 1;

pub(super) fn run(out: &Path, axes: &Axes, pure: &[&Row]) -> Result<(), String> {
    let cells = cells(FITTED)?;
    let form = form(&cells, axes)?;
    println!("natural lengths of {CELLS} drawn cells");
    let key = format!(
        "version {VERSION}, {CELLS} cells, {EACH} a load, {:?}",
        form.natural()
    );
    let cached = |name: &str, compute: &dyn Fn() -> Result<Vec<Row>, String>| {
        rows::cached(&out.join(format!("drawn-{name}.csv")), &key, None, || {
            let rows = compute()?;
            println!("{name}: {} drawn cells", rows.len());
            Ok(rows)
        })
    };
    let loaded = cached("loaded", &|| {
        Ok(loaded::rows((&cells, EACH), &form, 0, LOADED))
    })?;
    let pure = cached("pure", &|| samples::again(&cells, pure))?;
    let strained = cached("strained", &|| samples::strained(&cells, &form, &STRAINED))?;
    let bent = cached("bent", &|| samples::strained(&cells, &form, &[BENT]))?;
    let others = cached("others", &|| {
        Ok(loaded::rows(
            (&self::cells(OTHERS)?, EACH),
            &form,
            LOADED,
            OTHER_LOADED,
        ))
    })?;
    let fitted: Vec<&Row> = strained.iter().chain(&bent).chain(&pure).collect();
    let law = normal(&form, &fitted, &loaded)?.positive(&super::firm(&strained), &POSITIVITY)?;
    let table = stability(&law, &strained) + &under_loads(&law, &others);
    println!("{table}");
    save(out, "law-drawn.md", &table)?;
    save(out, "drawn_filament.csv", &coefficients(&law))
}

fn cells(first: u64) -> Result<Vec<Cell>, String> {
    let seeds = (first..first + CELLS).into_par_iter();
    seeds
        .map(|seed| cells::with_sampled_bonds(seed, 2 * PERIOD))
        .collect()
}

fn form(cells: &[Cell], axes: &Axes) -> Result<HomogenisedForm, String> {
    let natural = |&twist: &f64| {
        let all = cells
            .par_iter()
            .map(|cell| Ok(twisted(cell, twist)?.strain[5]));
        let all: Vec<f64> = all.collect::<Result<_, String>>()?;
        Ok(all.iter().sum::<f64>() / all.len() as f64)
    };
    let lengths: Vec<f64> = axes
        .twist
        .iter()
        .map(natural)
        .collect::<Result<_, String>>()?;
    fitted_form(axes, &lengths)
}

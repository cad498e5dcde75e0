//! Fit of the law `Homogenised` to cells at random strains, cells under random loads, and grid points with at most
//! one of bending and shear. Errors include validation under loads that are not fitted.

mod drawn;
mod loaded;
mod samples;
mod tables;
mod weights;

use super::axes::Axes;
use super::fit::{Normal, Positivity, coefficients};
use super::region::Region;
use super::rows::Row;
use actin_cosserat::{HomogenisedForm, Term};
use actin_draw::report::save;
use actin_fit::{Mat, Observations, fit_linear};
use actin_paper::cells::mean;
use actin_sim::ellipsoid::SixVector;
use std::path::Path;
use tables::{stability, under_loads};
use weights::weighted;

/// Range of the law. The strains of fitted cells extend slightly beyond it.
const RANGE: Region = Region::new([0.01, 0.048, 0.02], [-2e-3, 6e-3]);
const LOADED: u64 = 8000;
const OTHER_LOADED: u64 = 2500;

/// Regions and numbers of strained cells: slightly beyond the range, and under compression.
const STRAINED: [(Region, u64); 2] = [
    (Region::new([0.0125, 0.055, 0.018], [-2.2e-3, 7e-3]), 6000),
    (Region::new([0.011, 0.015, 0.016], [-2.2e-3, 0.0]), 6000),
];

/// The same for strong bending, without the positivity condition.
const BENT: (Region, u64) = (Region::new([0.022, 0.05, 0.016], [-2.2e-3, 5e-3]), 3000);

/// Positivity condition, applied where the smallest eigenvalue of the cell exceeds [`FIRM`] (pN) in these units.
/// Closer to instability of the cell, it would reduce the accuracy elsewhere.
const POSITIVITY: Positivity = Positivity {
    units: [20.0, 20.0, 5.0, 1.0, 1.0, 20.0],
    strength: 0.2,
};
const FIRM: f64 = 30.0;

/// Terms that only laws at a temperature have.
const HEATED: [Term; 4] = [
    Term::Turn,
    Term::Pull,
    Term::StretchTwiceShear,
    Term::StretchShearTwice,
];

pub(super) fn run(out: &Path, axes: &Axes, grid: &[Row]) -> Result<(), String> {
    let cell = [mean()?];
    let form = form(axes, grid)?;
    let within: Vec<&Row> = grid.iter().filter(|row| is_in_range(row)).collect();
    let strained = samples::strained(&cell, &form, &STRAINED)?;
    let bent = samples::strained(&cell, &form, &[BENT])?;
    let fitted: Vec<&Row> = strained.iter().chain(&bent).chain(pure(&within)).collect();
    let loaded = loaded::rows((&cell, 1), &form, 0, LOADED);
    println!(
        "{} strained cells, {} loaded ones of {LOADED}",
        fitted.len(),
        loaded.len()
    );
    let law = normal(&form, &fitted, &loaded)?.positive(&firm(&strained), &POSITIVITY)?;
    let not_fitted = loaded::rows((&cell, 1), &form, LOADED, OTHER_LOADED);
    let table = stability(&law, &strained) + &under_loads(&law, &not_fitted);
    println!("{table}");
    save(out, "law.md", &table)?;
    save(out, "mean_filament.csv", &coefficients(&law))
}

pub(super) fn run_drawn(out: &Path, axes: &Axes, grid: &[Row]) -> Result<(), String> {
    let within: Vec<&Row> = grid.iter().filter(|row| is_in_range(row)).collect();
    drawn::run(out, axes, &pure(&within).collect::<Vec<_>>())
}

/// Selects grid points with at most one of bending and shear, which random strains do not contain.
fn pure<'a>(within: &[&'a Row]) -> impl Iterator<Item = &'a Row> {
    let is_pure = |row: &&Row| row.strain[0] == 0.0 || row.strain[2] == 0.0;
    within.iter().copied().filter(is_pure)
}

/// Returns the equations of all terms. Loaded cells are weighted by their agreement with a first fit.
fn normal<'a>(
    form: &'a HomogenisedForm,
    strained: &[&Row],
    loaded: &[Row],
) -> Result<Normal<'a>, String> {
    let terms = Term::ALL.into_iter().filter(|term| !HEATED.contains(term));
    let terms: Vec<Term> = terms.collect();
    let first = Normal::new(form, &terms, &weighted(strained, loaded, None)).best()?;
    let weighted = weighted(strained, loaded, Some(&first));
    Ok(Normal::new(form, &terms, &weighted))
}

fn firm(strained: &[Row]) -> Vec<SixVector> {
    let firm = strained.iter().filter(|row| POSITIVITY.least(row) > FIRM);
    firm.map(Row::six).collect()
}

fn is_in_range(row: &Row) -> bool {
    let close = 1.0 + 1e-9;
    let [least, _] = RANGE.extension;
    row.strain[0] <= close * RANGE.curvature
        && row.strain[2] <= close * RANGE.shear
        && row.extension >= close * least
}

fn form(axes: &Axes, grid: &[Row]) -> Result<HomogenisedForm, String> {
    let natural = |twist: &f64| {
        let found = grid
            .iter()
            .find(|row| row.strain[1].total_cmp(twist).is_eq());
        found.map(|row| row.strain[3] - row.extension)
    };
    let lengths: Option<Vec<f64>> = axes.twist.iter().map(natural).collect();
    let lengths = lengths.ok_or("a twist that the grid does not have")?;
    fitted_form(axes, &lengths)
}

fn fitted_form(axes: &Axes, lengths: &[f64]) -> Result<HomogenisedForm, String> {
    // Relative errors, with a floor of 1e-5.
    let sizes: Vec<f64> = lengths.iter().map(|n| 1e-5 + 0.01 * n.abs()).collect();
    let units: Vec<_> = axes
        .twist
        .iter()
        .map(|&k| HomogenisedForm::natural_units(k))
        .collect();
    let powers = units[0].len().min(axes.twist.len());
    let design = Mat::from_fn(units.len(), powers, |i, j| units[i][j]);
    let observations = Observations::new(lengths)
        .and_then(|o| o.with_deviations(&sizes))
        .map_err(|e| e.to_string())?;
    let found = fit_linear(design.as_ref(), &observations).map_err(|e| e.to_string())?;
    HomogenisedForm::new(&found.parameters).map_err(|e| e.to_string())
}

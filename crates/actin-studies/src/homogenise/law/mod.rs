//! The law `Homogenised` of rods, fitted to cells at random strains, to cells under random loads, and to the grid's
//! straight, only bent and only sheared ones: what each term brings, and how it does on strains, loads and bonds that
//! entered nothing.

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
use actin_fit::{Mat, Observations, fit_linear};
use actin_paper::cells::{self, PERIOD, mean};
use actin_sim::ellipsoid::SixVector;
use samples::other_rows;
use std::fmt::Write as _;
use std::path::Path;
use tables::{Residuals, by_twist, stability, under_loads};
use weights::weighted;

/// The range of the law: cells are strained a little beyond it.
const RANGE: Region = Region {
    curvature: 0.01,
    twist: 0.048,
    shear: 0.015,
    extension: [-2e-3, 6e-3],
    is_shortened: true,
};
/// Other strains of the mean filament, and of each drawn one.
const OTHERS: u64 = 400;
const OF_DRAWN: u64 = 60;
/// Loaded cells that are fitted, and that are not.
const LOADED: u64 = 8000;
const OTHER_LOADED: u64 = 2500;

/// Terms in the order in which they are tried.
const STEPS: [(&str, &[Term]); 9] = [
    (
        "twist, stretch, bending, shear",
        &[
            Term::Twist,
            Term::Stretch,
            Term::AnyStretch,
            Term::Bend,
            Term::AnyBend,
            Term::Shear,
            Term::AnyShear,
        ],
    ),
    ("shear under tension", &[Term::StretchShear]),
    ("bend-shear coupling", &[Term::Coupling]),
    (
        "bending shifts the axis",
        &[Term::BendRoot, Term::StretchRoot, Term::StretchBend],
    ),
    ("bending resists shear", &[Term::RootShear]),
    ("compression", &[Term::Compression, Term::StretchThrice]),
    (
        "coupling with stretch, bending, shear",
        &[
            Term::StretchCoupling,
            Term::RootCoupling,
            Term::ShearCoupling,
        ],
    ),
    ("shear twice", &[Term::ShearTwice]),
    (
        "stretch, bending and shear again",
        &[
            Term::RootTwiceShear,
            Term::ShearThrice,
            Term::StretchTwiceRoot,
        ],
    ),
];

/// Where cells are strained at random, how many: a little beyond the range, and under compression.
const STRAINED: [(Region, u64); 2] = [
    (
        Region {
            curvature: 0.0125,
            twist: 0.055,
            shear: 0.018,
            extension: [-2.2e-3, 7e-3],
            is_shortened: true,
        },
        6000,
    ),
    (
        Region {
            curvature: 0.011,
            twist: 0.015,
            shear: 0.016,
            extension: [-2.2e-3, 0.0],
            is_shortened: true,
        },
        6000,
    ),
];

/// The same for strong bending, at which the tangent is not held positive.
const BENT: (Region, u64) = (
    Region {
        curvature: 0.022,
        twist: 0.05,
        shear: 0.016,
        extension: [-2.2e-3, 5e-3],
        is_shortened: true,
    },
    3000,
);

/// How the tangent is held positive where cells have a least eigenvalue above [`FIRM`] (pN) in these units: closer
/// to where they lose their stiffness themselves, that would cost accuracy elsewhere.
const POSITIVITY: Positivity = Positivity {
    units: [20.0, 20.0, 5.0, 1.0, 1.0, 20.0],
    strength: 0.2,
};
const FIRM: f64 = 30.0;

/// The terms that are fitted.
fn terms() -> Vec<Term> {
    let steps = STEPS.iter().flat_map(|(_, more)| more.iter().copied());
    in_order(&steps.collect::<Vec<_>>())
}

/// Terms in the order of the equations.
fn in_order(terms: &[Term]) -> Vec<Term> {
    let chosen = Term::ALL.into_iter();
    chosen.filter(|term| terms.contains(term)).collect()
}

/// Fits, prints and writes.
pub(super) fn run(out: &Path, axes: &Axes, grid: &[Row], samplings: u64) -> Result<(), String> {
    let cell = [mean()?];
    let form = form(axes, grid)?;
    let (within, outside): (Vec<&Row>, Vec<&Row>) = grid.iter().partition(|row| is_in_range(row));
    let strained = samples::strained(&cell, &form, &STRAINED)?;
    let bent = samples::strained(&cell, &form, &[BENT])?;
    let fitted: Vec<&Row> = strained.iter().chain(&bent).chain(pure(&within)).collect();
    let loaded = loaded::rows((&cell, 1), &form, 0, LOADED);
    println!(
        "{} strained cells, {} loaded ones of {LOADED}",
        fitted.len(),
        loaded.len()
    );
    let normal = normal(&form, &fitted, &loaded)?;
    let law = normal.positive(&firm(&strained), &POSITIVITY)?;
    let mut table = stepwise(&normal, &fitted)?;
    let others = other_rows(&cell[0], axes, 1, OTHERS)?;
    let drawn = of_drawn(axes, samplings)?;
    let cases = [
        ("with a positive tangent", fitted.clone()),
        ("other strains", others.iter().collect()),
        ("drawn bonds", drawn.iter().collect()),
        ("beyond the range", outside),
    ];
    for (name, rows) in cases {
        let _ = writeln!(table, "| {name} | {}", Residuals::of(&law, rows).printed());
    }
    let not_fitted = loaded::rows((&cell, 1), &form, LOADED, OTHER_LOADED);
    table += &(stability(&law, &strained) + &by_twist(&law, axes, &within));
    table += &under_loads(&law, &not_fitted);
    println!("{table}");
    write(out, "law.md", table)?;
    write(out, "mean_filament.csv", coefficients(&law))
}

/// The same for filaments of drawn bonds.
pub(super) fn run_drawn(out: &Path, axes: &Axes, grid: &[Row]) -> Result<(), String> {
    let within: Vec<&Row> = grid.iter().filter(|row| is_in_range(row)).collect();
    drawn::run(out, axes, &pure(&within).collect::<Vec<_>>())
}

/// Of the grid what no random strain meets: straight cells, only bent and only sheared ones.
fn pure<'a>(within: &[&'a Row]) -> impl Iterator<Item = &'a Row> {
    let is_pure = |row: &&Row| row.strain[0] == 0.0 || row.strain[2] == 0.0;
    within.iter().copied().filter(is_pure)
}

fn write(out: &Path, file: &str, text: String) -> Result<(), String> {
    let path = out.join(file);
    std::fs::write(&path, text).map_err(|e| format!("{}: {e}", path.display()))
}

/// The equations of all terms; loaded cells count as far as a first fit follows them.
fn normal<'a>(
    form: &'a HomogenisedForm,
    strained: &[&Row],
    loaded: &[Row],
) -> Result<Normal<'a>, String> {
    let terms = terms();
    let first = Normal::new(form, &terms, &weighted(strained, loaded, None)).best(&terms)?;
    Ok(Normal::new(
        form,
        &terms,
        &weighted(strained, loaded, Some(&first)),
    ))
}

/// Where the tangent is held positive.
fn firm(strained: &[Row]) -> Vec<SixVector> {
    let firm = strained.iter().filter(|row| POSITIVITY.least(row) > FIRM);
    firm.map(Row::six).collect()
}

/// Strained cells with drawn bonds.
fn of_drawn(axes: &Axes, samplings: u64) -> Result<Vec<Row>, String> {
    let rows = (1..=samplings).map(|seed| {
        let cell = cells::drawn(seed, 2 * PERIOD)?;
        other_rows(&cell, axes, seed, OF_DRAWN)
    });
    let rows: Vec<Vec<Row>> = rows.collect::<Result<_, String>>()?;
    Ok(rows.into_iter().flatten().collect())
}

/// A table of what each step brings.
fn stepwise(normal: &Normal<'_>, rows: &[&Row]) -> Result<String, String> {
    let mut table = String::from(
        "| terms | energy | couple | twisting couple | shear force | tension | tangent | positive |\n",
    );
    let _ = writeln!(table, "| --- |{}", " ---: |".repeat(7));
    let mut terms: Vec<Term> = Vec::new();
    for (name, more) in STEPS {
        terms.extend(more);
        let found = normal.best(&in_order(&terms))?;
        let residuals = Residuals::of(&found, rows.iter().copied());
        let _ = writeln!(table, "| + {name} | {}", residuals.printed());
    }
    Ok(table)
}

/// Whether a point of the grid is within the range.
fn is_in_range(row: &Row) -> bool {
    let close = 1.0 + 1e-9;
    let [least, _] = RANGE.extension;
    row.strain[0] <= close * RANGE.curvature
        && row.strain[2] <= close * RANGE.shear
        && row.extension >= close * least
}

/// The form with the natural lengths of the grid.
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

/// The form whose natural lengths are nearest to these, one for each twist.
fn fitted_form(axes: &Axes, lengths: &[f64]) -> Result<HomogenisedForm, String> {
    // Relative differences count, but for 1e-5.
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

//! The law `Homogenised` of rods fitted to the grid: what each term brings, and how it does on strains and
//! bonds that entered nothing.

mod samples;
mod weights;

use super::axes::Axes;
use super::filament::{self, PERIOD, mean};
use super::fit::{Normal, coefficients, numbers};
use super::paths;
use super::region::Region;
use super::rows::Row;
use crate::Tell;
use actin_cosserat::{Homogenised, HomogenisedForm, Term};
use actin_fit::{Mat, Observations, fit_linear};
use actin_sim::ellipsoid::SixVector;
use samples::other_rows;
use std::fmt::Write as _;
use std::path::Path;
use weights::{deviations, weighted};

/// What is fitted, and where the tangent is held positive.
const RANGE: Region = Region {
    curvature: 0.01,
    twist: 0.048,
    shear: 0.015,
    extension: [-2e-3, 6e-3],
};
/// Points at which the tangent is looked at that were not used to hold it positive.
const LOOKS: u64 = 20_000;
/// Other strains of the mean filament, and of each drawn one.
const OTHERS: u64 = 400;
const OF_DRAWN: u64 = 60;

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
    ("compression", &[Term::Compression]),
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
        "stretch, bending and shear",
        &[Term::StretchRootShear, Term::StretchTwiceRoot],
    ),
];

/// Where the tangent is held positive, at how many strains: a little beyond the range, under compression, as short
/// as bending makes rods, and beyond the range in twist and bending, in shear and tension.
const POSITIVE: [(Region, u64); 5] = [
    (
        Region {
            curvature: 0.0125,
            twist: 0.055,
            shear: 0.018,
            extension: [-2.2e-3, 7e-3],
        },
        6000,
    ),
    (
        Region {
            curvature: 0.011,
            twist: 0.015,
            shear: 0.016,
            extension: [-2.2e-3, 0.0],
        },
        6000,
    ),
    (
        Region {
            curvature: 0.011,
            twist: 0.04,
            shear: 4e-3,
            extension: [-6e-3, 0.0],
        },
        1500,
    ),
    (
        Region {
            curvature: 0.02,
            twist: 0.08,
            shear: 0.016,
            extension: [-2.2e-3, 7e-3],
        },
        1500,
    ),
    (
        Region {
            curvature: 0.02,
            twist: 0.05,
            shear: 0.03,
            extension: [-2.2e-3, 0.01],
        },
        1500,
    ),
];

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
pub(super) fn run(
    out: &Path,
    axes: &Axes,
    grid: &[Row],
    samplings: u64,
    tell: Tell<'_>,
) -> Result<(), String> {
    let cell = mean()?;
    let form = form(axes, grid)?;
    let (fitted, outside): (Vec<&Row>, Vec<&Row>) = grid.iter().partition(|row| is_in_range(row));
    let paths = paths::compute(out, |twist| form.natural_stretch(twist), tell)?;
    let normal = Normal::new(&form, &terms(), &weighted(&fitted, &paths));
    let mut table = stepwise(&normal, &fitted)?;
    let law = normal.positive(&POSITIVE)?;
    let others = other_rows(&cell, axes, 1, OTHERS)?;
    let mut drawn = Vec::new();
    for seed in 1..=samplings {
        let cell = filament::drawn(seed, 2 * PERIOD)?;
        drawn.extend(other_rows(&cell, axes, seed, OF_DRAWN)?);
    }
    let cases = [
        ("with a positive tangent", fitted.clone()),
        ("free to shear", paths.iter().collect()),
        ("other strains", others.iter().collect()),
        ("drawn bonds", drawn.iter().collect()),
        ("beyond the range", outside),
    ];
    for (name, rows) in cases {
        let residuals = Residuals::of(&law, rows);
        let _ = writeln!(table, "| {name} | {}", residuals.printed());
    }
    table.push_str(&stability(&law));
    table.push_str(&by_twist(&law, axes, &fitted));
    table.push_str(&by_curvature(&law, &paths));
    tell(format_args!("{table}"));
    let write = |file: &str, text: String| {
        let path = out.join(file);
        std::fs::write(&path, text).map_err(|e| format!("{}: {e}", path.display()))
    };
    write("law.md", table)?;
    write("mean_filament.csv", coefficients(&law))
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

/// At how many strains, which were not used to hold it positive, the tangent is positive: within the range, and up
/// to twice the range.
fn stability(law: &Homogenised) -> String {
    let mut text = String::new();
    let twice = |x: f64| 2.0 * x;
    let beyond = Region {
        curvature: twice(RANGE.curvature),
        twist: twice(RANGE.twist),
        shear: twice(RANGE.shear),
        extension: RANGE.extension.map(twice),
    };
    for (name, region) in [("the range", RANGE), ("twice the range", beyond)] {
        let strains = region.strains(law.form(), LOOKS, LOOKS);
        let least = |strain: &SixVector| law.tangent(strain).symmetric_eigenvalues().min();
        let least: Vec<f64> = strains.iter().map(least).collect();
        let positive = least.iter().filter(|x| **x > 0.0).count();
        let _ = writeln!(
            text,
            "\nwithin {name}: tangent positive at {positive} of {LOOKS} strains, least eigenvalue {:.1} pN",
            least.iter().copied().fold(f64::INFINITY, f64::min)
        );
    }
    text
}

/// Whether a point is fitted.
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
    // Relative differences count, but for 1e-5.
    let sizes: Vec<f64> = lengths.iter().map(|n| 1e-5 + 0.01 * n.abs()).collect();
    let units: Vec<_> = axes
        .twist
        .iter()
        .map(|&k| HomogenisedForm::natural_units(k))
        .collect();
    let powers = units[0].len().min(axes.twist.len());
    let design = Mat::from_fn(units.len(), powers, |i, j| units[i][j]);
    let observations = Observations::new(&lengths)
        .and_then(|o| o.with_deviations(&sizes))
        .map_err(|e| e.to_string())?;
    let found = fit_linear(design.as_ref(), &observations).map_err(|e| e.to_string())?;
    HomogenisedForm::new(&found.parameters).map_err(|e| e.to_string())
}

/// Root mean squares of the differences between a law and rows, in units of what counts as 1.
struct Residuals {
    numbers: [f64; 7],
    /// Of entries of the tangent over the roots of the rows' diagonal ones.
    tangent: f64,
    /// Share of the points where the tangent of the law is positive.
    positive: f64,
}

impl Residuals {
    fn of<'a>(law: &Homogenised, rows: impl IntoIterator<Item = &'a Row>) -> Self {
        let mut sums = [0.0; 7];
        let (mut tangents, mut entries, mut positive, mut count) = (0.0, 0.0, 0.0, 0.0);
        for row in rows {
            let strain = row.six();
            let jet = law.jet(&strain);
            let law_numbers = numbers(&jet);
            let ours = row_numbers(row);
            for (q, size) in deviations(row).into_iter().enumerate() {
                sums[q] += ((law_numbers[q] - ours[q]) / size).powi(2);
            }
            let tangent = jet.tangent;
            let is_firm = (0..6).all(|k| row.tangent[(k, k)] > COMPARED[k]);
            for (i, j) in (0..6)
                .flat_map(|i| (0..6).map(move |j| (i, j)))
                .filter(|_| is_firm)
            {
                let size = (row.tangent[(i, i)] * row.tangent[(j, j)]).sqrt();
                tangents += ((tangent[(i, j)] - row.tangent[(i, j)]) / size).powi(2);
                entries += 1.0;
            }
            positive += f64::from(u8::from(tangent.symmetric_eigenvalues().min() > 0.0));
            count += 1.0;
        }
        Self {
            numbers: sums.map(|sum: f64| (sum / count).sqrt()),
            tangent: (tangents / f64::max(entries, 1.0)).sqrt(),
            positive: positive / count,
        }
    }

    fn printed(&self) -> String {
        let [w, m1, m2, m3, n1, n2, n3] = self.numbers;
        let both = |a: f64, b: f64| (0.5 * (a * a + b * b)).sqrt();
        format!(
            "{w:.2} | {:.2} | {m3:.2} | {:.2} | {n3:.2} | {:.3} | {:.1} % |",
            both(m1, m2),
            both(n1, n2),
            self.tangent,
            100.0 * self.positive
        )
    }
}

/// Diagonal entries of the tangent (pN nm^2, pN) below which a state counts as one of no stiffness, where
/// relative differences say nothing.
const COMPARED: [f64; 6] = [1e3, 1e3, 500.0, 30.0, 30.0, 1e3];

/// Energy, couple and force of a cell.
fn row_numbers(row: &Row) -> [f64; 7] {
    let [a, b, c, d, e, f] = row.loads.into();
    [row.energy, a, b, c, d, e, f]
}

/// Residuals at each twist, and where the tangents of cell and law are not positive.
fn by_twist(law: &Homogenised, axes: &Axes, rows: &[&Row]) -> String {
    let mut table = String::from(
        "\n| twist (rad/nm) | energy | couple | twisting couple | shear force | tension | tangent | positive \
         | cell positive |\n",
    );
    let _ = writeln!(table, "| ---: |{}", " ---: |".repeat(8));
    for twist in &axes.twist {
        let here = rows
            .iter()
            .filter(|row| row.strain[1].total_cmp(twist).is_eq());
        let here: Vec<&Row> = here.copied().collect();
        let firm = here
            .iter()
            .filter(|row| row.least_stiffness() > 0.0)
            .count();
        let _ = writeln!(
            table,
            "| {twist} | {} {:.1} % |",
            Residuals::of(law, here.iter().copied()).printed(),
            100.0 * firm as f64 / here.len() as f64
        );
    }
    table
}

/// Differences of the couple of bent cells that are free to shear and not compressed, at each curvature.
fn by_curvature(law: &Homogenised, paths: &[Row]) -> String {
    let mut table = String::from(
        "\n| curvature (rad/nm), free to shear | couple, root mean square | at rest otherwise |\n| ---: | ---: | ---: |\n",
    );
    let off = |row: &Row| law.loads(&row.six())[0] / row.loads[0] - 1.0;
    for curvature in paths::CURVATURES {
        let here = paths
            .iter()
            .filter(|row| (row.strain[0] / curvature - 1.0).abs() < 1e-6);
        let here: Vec<&Row> = here.filter(|row| row.loads[5] > -0.01).collect();
        let squares: f64 = here.iter().map(|row| off(row).powi(2)).sum();
        let free = here
            .iter()
            .filter(|row| row.loads[2].abs() < 1e-6 && row.loads[5] < 0.01);
        let free: Vec<String> = free
            .map(|row| format!("{:+.1} %", 100.0 * off(row)))
            .collect();
        let _ = writeln!(
            table,
            "| {curvature} | {:.1} % | {} |",
            100.0 * (squares / here.len() as f64).sqrt(),
            free.join(", ")
        );
    }
    table
}

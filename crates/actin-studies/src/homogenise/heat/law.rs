//! Fit of the law `Homogenised` at a temperature to mean loads and tangents.

use super::super::fit::{Normal, Positivity, Weighted, coefficients};
use super::super::region::{Region, strains};
use super::super::rows::{Row, upper};
use actin_cosserat::{Homogenised, HomogenisedForm, Term};
use actin_draw::report::save;
use actin_fit::{Mat, Observations, fit_linear};
use actin_sim::ellipsoid::SixVector;
use std::fmt::Write as _;
use std::path::Path;

/// Unit residual, in addition to the standard error: a fraction of the value, and bending torque, twisting torque (pN
/// nm), shear force and tension (pN).
const SHARE: f64 = 0.03;
const FLOORS: [f64; 4] = [1.0, 0.5, 0.3, 1.0];
/// Unit residual of the tangent: a fraction of the square roots of diagonal entries.
const TANGENT: f64 = 0.33;

/// Strains (curvature, twist, shear, extension) of long filaments in thermal motion, and the weight of samples with
/// smaller strains, which determine the rigidities at rest.
const REST: [f64; 4] = [5e-3, 0.013, 7.5e-3, 3e-3];
const AT_REST: f64 = 3.0;

/// Terms that are omitted: thermal motion smooths the response at rest and the onset of compression, and the last three
/// are for rods whose segments differ in length from the cells.
const LEFT_OUT: [Term; 9] = [
    Term::Compression,
    Term::BendRoot,
    Term::StretchRoot,
    Term::ShearThrice,
    Term::RootTwiceShear,
    Term::StretchTwiceRoot,
    Term::Pull,
    Term::StretchTwiceShear,
    Term::StretchShearTwice,
];

/// Regions in which the tangent must be positive, with numbers of strains: the range of the samples, and twice that.
const POSITIVE: [(Region, u64); 2] = [
    (
        Region::new([0.01, 0.048, 0.05], [-8e-3, 8e-3]).without_shortening(),
        4000,
    ),
    (
        Region::new([0.02, 0.096, 0.1], [-0.016, 0.016]).without_shortening(),
        4000,
    ),
];

const POSITIVITY: Positivity = Positivity {
    units: [20.0, 20.0, 0.5, 1.0, 1.0, 1.0],
    strength: 10.0,
};

/// Number of independent strains at which the tangent is checked.
const LOOKS: u64 = 20_000;

pub(super) fn run(out: &Path, temperature_k: f64, rows: &[Row]) -> Result<(), String> {
    let law = fit(rows)?;
    let mut table = residuals(&law, rows);
    for ((region, _), name) in POSITIVE.into_iter().zip(["the range", "twice the range"]) {
        let strains = region.strains(law.form(), LOOKS, LOOKS);
        let is_positive = |s: &&SixVector| law.tangent(s).symmetric_eigenvalues().min() > 0.0;
        let positive = strains.iter().filter(is_positive).count();
        let _ = writeln!(
            table,
            "\nwithin {name}: tangent positive at {positive} of {LOOKS} strains"
        );
    }
    println!("{table}");
    save(out, "heat-law.md", &table)?;
    let file = format!("mean_filament_{temperature_k}_k.csv");
    save(out, &file, &coefficients(&law))
}

pub(super) fn fit(rows: &[Row]) -> Result<Homogenised, String> {
    let form = form(rows)?;
    let weighted: Vec<Weighted<'_>> = rows.iter().map(weighted).collect();
    let terms = Term::ALL
        .into_iter()
        .filter(|term| !LEFT_OUT.contains(term));
    let normal = Normal::new(&form, &terms.collect::<Vec<_>>(), &weighted);
    normal.positive(&strains(&form, &POSITIVE), &POSITIVITY)
}

fn deviations(row: &Row) -> [f64; 6] {
    let loads = &row.loads;
    let [couple, twisting, force, tension] = FLOORS;
    let m = couple + SHARE * loads.fixed_rows::<2>(0).norm();
    let n = force + SHARE * loads.fixed_rows::<2>(3).norm();
    let m3 = twisting + SHARE * loads[2].abs();
    let n3 = tension + SHARE * loads[5].abs();
    let mut sizes = [m, m, m3, n, n, n3];
    for (size, error) in sizes.iter_mut().zip(row.errors.iter()) {
        *size = size.hypot(*error);
    }
    sizes
}

fn is_at_rest(row: &Row) -> bool {
    let [curvature, twist, shear, ..] = row.strain;
    let strains = [curvature, twist.abs(), shear, row.extension.abs()];
    strains.iter().zip(REST).all(|(x, size)| *x < 1.01 * size)
}

fn weighted(row: &Row) -> Weighted<'_> {
    let weight = if is_at_rest(row) { AT_REST } else { 1.0 };
    let [a, b, c, d, e, f] = deviations(row).map(|size| weight / size);
    let diagonal = row.tangent.diagonal();
    let size = |(i, j): (usize, usize)| (diagonal[i] * diagonal[j]).abs().sqrt();
    Weighted {
        row,
        // The free energy is unknown.
        numbers: [0.0, a, b, c, d, e, f],
        tangent: upper()
            .map(|at| (at, weight / (TANGENT * size(at))))
            .collect(),
        sums: Vec::new(),
    }
}

fn form(rows: &[Row]) -> Result<HomogenisedForm, String> {
    let mut lengths: Vec<(f64, f64)> = Vec::new();
    for row in rows {
        let (twist, natural) = (row.strain[1], row.strain[3] - row.extension);
        if !lengths.contains(&(twist, natural)) {
            lengths.push((twist, natural));
        }
    }
    let at_rest: Vec<f64> = lengths
        .iter()
        .filter(|(twist, _)| *twist == 0.0)
        .map(|(_, natural)| *natural)
        .collect();
    let rest = at_rest.iter().sum::<f64>() / at_rest.len() as f64;
    lengths.retain(|(twist, _)| *twist != 0.0);
    let beyond: Vec<f64> = lengths.iter().map(|(_, natural)| natural - rest).collect();
    let units: Vec<_> = lengths
        .iter()
        .map(|&(twist, _)| HomogenisedForm::natural_units(twist))
        .collect();
    let design = Mat::from_fn(units.len(), NATURAL, |i, j| units[i][j]);
    let observations = Observations::new(&beyond).map_err(|e| e.to_string())?;
    let found = fit_linear(design.as_ref(), &observations).map_err(|e| e.to_string())?;
    HomogenisedForm::new(&found.parameters)
        .and_then(|form| form.with_rest(rest))
        .map_err(|e| e.to_string())
}

const NATURAL: usize = 5;

fn residuals(law: &Homogenised, rows: &[Row]) -> String {
    let mut table = String::from(
        "| curvature (rad/nm) | shear | points | couple | twisting couple | shear force | tension | tangent |\n",
    );
    let _ = writeln!(table, "| ---: | ---: |{}", " ---: |".repeat(6));
    let group = |row: &Row| [row.strain[0], row.strain[2]];
    let mut groups: Vec<[f64; 2]> = rows.iter().map(group).collect();
    groups.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    groups.dedup();
    for own in groups {
        let [curvature, shear] = own;
        let is_here = |row: &&Row| group(row).map(f64::to_bits) == own.map(f64::to_bits);
        let here: Vec<&Row> = rows.iter().filter(is_here).collect();
        let _ = writeln!(table, "| {curvature} | {shear} | {}", printed(law, &here));
    }
    let all: Vec<&Row> = rows.iter().collect();
    let _ = writeln!(table, "| all | | {}", printed(law, &all));
    table
}

fn printed(law: &Homogenised, rows: &[&Row]) -> String {
    let (mut sums, mut tangents) = ([0.0; 6], 0.0);
    for row in rows {
        let Row { loads, tangent, .. } = row;
        let ours = law.jet(&row.six());
        for (k, size) in deviations(row).into_iter().enumerate() {
            sums[k] += ((ours.loads[k] - loads[k]) / size).powi(2);
        }
        let difference = ours.tangent - tangent;
        let diagonal = tangent.diagonal();
        for (i, j) in upper() {
            tangents += difference[(i, j)].powi(2) / (diagonal[i] * diagonal[j]).abs();
        }
    }
    let count = rows.len() as f64;
    let [m1, m2, m3, n1, n2, n3] = sums.map(|sum: f64| sum / count);
    let both = |a: f64, b: f64| (0.5 * (a + b)).sqrt();
    format!(
        "{count} | {:.2} | {:.2} | {:.2} | {:.2} | {:.3} |",
        both(m1, m2),
        m3.sqrt(),
        both(n1, n2),
        n3.sqrt(),
        (tangents / (21.0 * count)).sqrt()
    )
}

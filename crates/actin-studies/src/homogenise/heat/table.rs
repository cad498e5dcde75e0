//! Rigidities and natural lengths of the free filament at a temperature, from cells of two sizes.

use super::heat;
use super::natural::{Natural, natural, straight};
use actin_draw::report::save;
use actin_paper::cells::{self, PERIOD, ZERO_LOAD, ZERO_STRAIN, relax};
use actin_sim::ellipsoid::{Cell, Control, EllipsoidParameters, HeatResponse, Hold, SixMatrix};
use rayon::prelude::*;
use std::fmt::Write as _;
use std::path::Path;

const STREAMS: u64 = 1000;

type Number = (f64, f64);

const NAMES: [&str; 15] = [
    "natural twist (rad/nm)",
    "natural stretch",
    "B, strains held (pN nm^2)",
    "B, other loads zero",
    "C, strains held (pN nm^2)",
    "C, other loads zero",
    "S1, strains held (pN)",
    "S1, other loads zero",
    "S3, strains held (pN)",
    "S3, other loads zero",
    "twist-stretch (pN nm)",
    "bend-shear (pN nm)",
    "kT/(L var kappa_1) (pN nm^2)",
    "kT/(L var kappa_3) (pN nm^2)",
    "kT/(L var sigma_3) (pN)",
];

pub(super) fn run(out: &Path, kt: f64, quick: bool) -> Result<(), String> {
    let sizes = if quick { vec![1] } else { vec![1, 2] };
    let samples = if quick { 4000 } else { 16_000 };
    let cells = sizes.par_iter().map(|&periods: &usize| {
        let cell = cells::with_parameters(
            EllipsoidParameters::default(),
            periods * PERIOD,
            Hold::Means,
        )?;
        numbers(&cell, kt, samples, STREAMS * periods as u64)
    });
    let cells: Vec<Vec<Number>> = cells.collect::<Result<_, String>>()?;
    let table = printed(&sizes, &relaxed()?, &cells);
    println!("{table}");
    save(out, "heat-table.md", &table)
}

fn printed(sizes: &[usize], relaxed: &[Option<f64>], cells: &[Vec<Number>]) -> String {
    let mut table = String::from("| quantity | relaxed |");
    for periods in sizes {
        let _ = write!(table, " cell of {} |", periods * PERIOD);
    }
    let _ = writeln!(table, "\n| --- | ---: |{}", " ---: |".repeat(sizes.len()));
    for (k, name) in NAMES.iter().enumerate() {
        let relaxed = relaxed[k].map_or(String::new(), |value| format!("{value:.4e} "));
        let _ = write!(table, "| {name} | {relaxed}|");
        for (value, error) in cells.iter().map(|cell| cell[k]) {
            let _ = write!(table, " {value:.4e} +- {error:.0e} |");
        }
        table.push('\n');
    }
    table
}

fn numbers(cell: &Cell, kt: f64, samples: usize, stream: u64) -> Result<Vec<Number>, String> {
    let free = natural(cell, kt, None, stream)?;
    let held = || straight(cell, kt, &free, samples, stream + 100);
    let moving = || cell.sample(&[ZERO_LOAD; 6], &heat(kt, samples, stream + 200), None);
    let (held, moving) = rayon::join(held, moving);
    let (held, moving) = (held?, moving.map_err(|e| e.to_string())?);
    let mut all = of_tangent(&free, &held);
    let per_length = kt / cell.length();
    for k in [0, 2, 5] {
        // The two components of curvature are equivalent.
        let variance = if k == 0 {
            0.5 * (moving.covariance[(0, 0)] + moving.covariance[(1, 1)])
        } else {
            moving.covariance[(k, k)]
        };
        let relative = moving.covariance_error[(k, k)] / moving.covariance[(k, k)];
        let relative = if k == 0 {
            relative / 2_f64.sqrt()
        } else {
            relative
        };
        let value = per_length / variance;
        all.push((value, value * relative));
    }
    Ok(all)
}

/// Returns the natural state and its rigidities, with errors propagated to first order.
fn of_tangent(free: &Natural, held: &HeatResponse) -> Vec<Number> {
    let (tangent, errors) = (&held.tangent, &held.tangent_error);
    let inverse = |t: &SixMatrix| {
        t.try_inverse()
            .unwrap_or_else(|| SixMatrix::repeat(f64::NAN))
    };
    let compliance = inverse(tangent);
    let mean = |of: &SixMatrix, i: usize, j: usize| {
        let other = |k: usize| if k == 0 || k == 3 { k + 1 } else { k };
        0.5 * (of[(i, j)] + of[(other(i), other(j))])
    };
    let share = |k: usize| {
        if k == 0 || k == 3 {
            0.5_f64.sqrt()
        } else {
            1.0
        }
    };
    let stiffness = |i: usize, j: usize| (mean(tangent, i, j), mean(errors, i, j) * share(i));
    let effective = |k: usize| {
        let value = 1.0 / mean(&compliance, k, k);
        // d(1/c_kk) = (c_k t' c_k)/c_kk^2
        let column = compliance.column(k);
        let squares = SixMatrix::from_fn(|i, j| (column[i] * column[j] * errors[(i, j)]).powi(2));
        let square = 2.0 * squares.sum() - squares.diagonal().sum();
        (value, value * value * square.sqrt() * share(k))
    };
    let strain = |k: usize, value: f64| {
        let squares = (0..6).map(|j| (compliance[(k, j)] * held.loads_error[j]).powi(2));
        let shift: f64 = (0..6).map(|j| compliance[(k, j)] * held.loads[j]).sum();
        (value - shift, squares.sum::<f64>().sqrt())
    };
    let mut all = vec![strain(2, free.twist), strain(5, free.stretch)];
    for k in [0, 2, 3, 5] {
        all.extend([stiffness(k, k), effective(k)]);
    }
    all.extend([stiffness(2, 5), stiffness(0, 3)]);
    all
}

/// Returns values of the relaxed cell: secants for bending of 1e-3 per nm and twist of 3e-3 rad/nm, shear at rest,
/// and stretch of 1e-3.
fn relaxed() -> Result<[Option<f64>; NAMES.len()], String> {
    let cell = cells::mean()?;
    let load = |k: usize, value: f64, others: Control| -> Result<f64, String> {
        let mut controls = [others; 6];
        controls[k] = Control::Strain(value);
        Ok(relax(&cell, controls, None)?.loads[k] / value)
    };
    let mut all = [None; NAMES.len()];
    (all[0], all[1]) = (Some(0.0), Some(0.0));
    for (row, k, value) in [(2, 0, 1e-3), (4, 2, 3e-3), (6, 3, 1e-3), (8, 5, 1e-3)] {
        all[row] = Some(load(k, value, ZERO_STRAIN)?);
        all[row + 1] = Some(load(k, value, ZERO_LOAD)?);
    }
    Ok(all)
}

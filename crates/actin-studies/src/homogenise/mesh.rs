//! Coefficients of the free energy as polynomials in the inverse segment length and in temperature:
//! `Homogenised::heated_rod`, whose documentation has the formula.

use super::heat;
use super::region::{Region, evenly};
use actin_cosserat::{Homogenised, Term};
use actin_draw::report::save;
use actin_paper::cells::PERIOD;
use actin_sim::BOLTZMANN_PN_NM_PER_K;
use actin_sim::ellipsoid::{SixMatrix, SixVector, constants};
use nalgebra::{DMatrix, DVector, Matrix3};
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, TAU};
use std::fmt::Write as _;
use std::path::Path;

/// Number of wave numbers in the mean.
const WAVES: usize = 8;
/// Segment lengths (nm) and tensions (pN) of the thermal strains of the fit.
const SEGMENTS_NM: [f64; 4] = [4.0, 7.0, 12.0, 25.0];
const TENSIONS: [f64; 5] = [-30.0, 0.0, 60.0, 130.0, 220.0];
/// Strains of each segment length and tension, and strains that fill the range of the data.
const THERMAL: u64 = 250;
const FILLING: u64 = 1500;
const RANGE: Region = Region::new([0.01, 0.05, 0.06], [-0.01, 0.01]).without_shortening();
/// Smallest eigenvalue (pN) of the tangent at strains of the fits of `D`, and of `X`.
const LEAST: [f64; 2] = [100.0, 400.0];
/// Share of the smallest and of the largest values of `X` that are replaced by the next ones.
const CLIPPED: f64 = 0.05;
/// Regularisation of the scaled normal equations.
const RIDGE: f64 = 1e-10;
/// Thousandths of a unit.
const PER_MILLI: f64 = 1e3;
/// Strains per load at a free end: number of Newton steps.
const NEWTON_STEPS: usize = 30;

/// Largest power of the bounded twist in the fit, or `None` for terms that are omitted: the unbounded
/// ones, and those without a share in the law at 298 K.
fn degree(term: Term) -> Option<usize> {
    let most = match term {
        Term::AnyStretch
        | Term::AnyBend
        | Term::AnyShear
        | Term::Compression
        | Term::BendRoot
        | Term::StretchRoot
        | Term::RootTwiceShear
        | Term::StretchTwiceRoot => return None,
        Term::Twist => 6,
        Term::Shear
        | Term::Stretch
        | Term::Bend
        | Term::Pull
        | Term::Coupling
        | Term::StretchShear => 4,
        _ => 3,
    };
    Some(most.min(term.degree()))
}

fn columns() -> impl Iterator<Item = (Term, usize)> {
    let powers = |term: Term| degree(term).map(|most| (0..=most).map(move |k| (term, k)));
    Term::ALL.into_iter().filter_map(powers).flatten()
}

/// Tangents of a potential and of its joints.
struct Tangents {
    all: SixMatrix,
    joint: Matrix3<f64>,
}

impl Tangents {
    fn new(law: &Homogenised, strain: &SixVector) -> Self {
        Self {
            all: law.tangent(strain),
            joint: law.joint_tangent(strain.fixed_rows::<3>(0).into()),
        }
    }

    /// Matrix `M` for each wave number.
    fn waves(&self) -> impl Iterator<Item = SixMatrix> {
        (0..WAVES).map(|k| {
            let cosine = (FRAC_PI_2 * (k as f64 + 0.5) / WAVES as f64).cos();
            let mut matrix = self.all;
            let bent: Matrix3<f64> = self.all.fixed_view::<3, 3>(0, 0).into();
            let joint = self.joint + cosine * cosine * (bent - self.joint);
            matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(&joint);
            matrix.fixed_view_mut::<3, 3>(0, 3).scale_mut(cosine);
            matrix.fixed_view_mut::<3, 3>(3, 0).scale_mut(cosine);
            matrix
        })
    }

    /// `D_s`.
    fn staggered(&self) -> f64 {
        self.waves().map(|m| log_det(&m)).sum::<f64>() / WAVES as f64
    }

    /// Mean of `tr(M^-1 M[F])`, given the tangents of `F`.
    fn trace(&self, other: &Self) -> f64 {
        let both = self.waves().zip(other.waves());
        let traces = both.map(|(m, f)| inverse(&m).component_mul(&f).sum());
        traces.sum::<f64>() / WAVES as f64
    }
}

fn log_det(matrix: &SixMatrix) -> f64 {
    let factor = matrix.cholesky();
    factor.map_or(f64::NAN, |factor| {
        2.0 * factor.l_dirty().diagonal().map(f64::ln).sum()
    })
}

fn inverse(matrix: &SixMatrix) -> SixMatrix {
    matrix
        .try_inverse()
        .unwrap_or_else(|| SixMatrix::repeat(f64::NAN))
}

/// Strain without loads but a tension (pN).
fn pulled(law: &Homogenised, tension: f64) -> SixVector {
    let mut strain = SixVector::ith(5, law.form().rest());
    for _ in 0..NEWTON_STEPS {
        let jet = law.jet(&strain);
        strain -= inverse(&jet.tangent) * (jet.loads - SixVector::ith(5, tension));
    }
    strain
}

/// Normal strains with the covariance `kT/(h A)` about those under tensions, and strains that fill the range.
fn strains(law: &Homogenised, kt: f64) -> Vec<SixVector> {
    let mut all = RANGE.strains(law.form(), 0, FILLING);
    for (k, segment_nm) in (0..).zip(SEGMENTS_NM) {
        for (i, tension) in (0..).zip(TENSIONS) {
            let centre = pulled(law, tension);
            let covariance = inverse(&law.tangent(&centre)) * (kt / segment_nm);
            let Some(factor) = covariance.cholesky() else {
                continue;
            };
            let first = (k * TENSIONS.len() as u64 + i) * THERMAL;
            let normal = (first..first + THERMAL).map(|n| centre + factor.l() * normals(n));
            all.extend(normal);
        }
    }
    all.retain(|strain| strain[2].abs() <= RANGE.twist && least(law, strain) > LEAST[0]);
    all
}

fn least(law: &Homogenised, strain: &SixVector) -> f64 {
    law.tangent(strain).symmetric_eigenvalues().min()
}

/// Six normal numbers by the method of Box and Muller, from point `n` of a low-discrepancy sequence.
fn normals(n: u64) -> SixVector {
    let uniform = evenly::<6>(n);
    SixVector::from_fn(|i, _| {
        let pair = 2 * (i / 2);
        let radius = (-2.0 * uniform[pair].max(1e-12).ln()).sqrt();
        let (sin, cos) = (TAU * uniform[pair + 1]).sin_cos();
        radius * if i == pair { cos } else { sin }
    })
}

/// Fit of values at strains by the terms and a constant, and its root mean square residual.
fn fit(
    cell: &Homogenised,
    strains: &[SixVector],
    values: &[f64],
) -> Result<(Homogenised, f64), String> {
    let row = |strain: &SixVector| {
        let own = |term: Term| {
            let count = degree(term).map_or(0, |most| most + 1);
            let units = cell.form().units(term, strain).into_iter().take(count);
            units.map(|unit| unit.energy).collect::<Vec<_>>()
        };
        let mut row: Vec<f64> = Term::ALL.into_iter().flat_map(own).collect();
        row.push(1.0);
        row
    };
    let rows: Vec<f64> = strains.par_iter().flat_map_iter(row).collect();
    let count = rows.len() / strains.len();
    let mut matrix = DMatrix::from_row_iterator(strains.len(), count, rows);
    let sizes: Vec<f64> = matrix.column_iter().map(|c| c.norm()).collect();
    for (mut column, size) in matrix.column_iter_mut().zip(&sizes) {
        column.unscale_mut(*size);
    }
    let right = DVector::from_column_slice(values);
    let normal = matrix.tr_mul(&matrix) + DMatrix::identity(count, count) * RIDGE;
    let factor = normal
        .cholesky()
        .ok_or("the equations of the fit are not independent")?;
    let found = factor.solve(&matrix.tr_mul(&right));
    let rms = (right - &matrix * &found).norm() / (strains.len() as f64).sqrt();
    let known: Vec<_> = columns().zip(found.iter().zip(&sizes)).collect();
    let of_term = |term: Term| {
        let own = known.iter().filter(|((other, _), _)| *other == term);
        own.map(|(_, (value, size))| *value / *size).collect()
    };
    let law = Homogenised::new(cell.form().clone(), of_term).map_err(|e| e.to_string())?;
    Ok((law, rms))
}

fn clipped(values: &[f64]) -> Vec<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "some hundreds"
    )]
    let place = (CLIPPED * sorted.len() as f64) as usize;
    let (least, most) = (sorted[place], sorted[sorted.len() - 1 - place]);
    values
        .iter()
        .map(|value| value.clamp(least, most))
        .collect()
}

/// Derivative (pN/K) of the free energy of cells with respect to temperature.
fn by_temperature(out: &Path, strains: &[SixVector]) -> Result<Vec<f64>, String> {
    let [cold_k, hot_k] = Homogenised::HEATED_RANGE_K;
    let (cold, hot) = (heat::law(out, cold_k)?, heat::law(out, hot_k)?);
    let difference = |s: &SixVector| hot.energy_density(s) - cold.energy_density(s);
    Ok(strains
        .iter()
        .map(|s| PER_MILLI * difference(s) / (hot_k - cold_k))
        .collect())
}

/// Computes the functions that are added to the law of the cells.
pub(super) fn run(out: &Path) -> Result<(), String> {
    let cell = Homogenised::mean_filament_at_298_k();
    let mut table =
        String::from("| function | standard deviation | residual |\n| --- | ---: | ---: |\n");
    let mut fitted = |name: &str, strains: &[SixVector], values: &[f64]| {
        let (law, rms) = fit(cell, strains, values)?;
        let _ = writeln!(table, "| {name} | {:.3} | {rms:.3} |", deviation(values));
        Ok::<_, String>(law)
    };
    let all = strains(cell, thermal_energy());
    let here: Vec<Tangents> = all.par_iter().map(|s| Tangents::new(cell, s)).collect();
    let plain: Vec<f64> = here.iter().map(|t| log_det(&t.all)).collect();
    let staggered: Vec<f64> = here.par_iter().map(Tangents::staggered).collect();
    let d = fitted("D", &all, &plain)?;
    let d_s = fitted("D_s", &all, &staggered)?;
    let per_kelvin = fitted("dW/dT (0.001 pN/K)", &all, &by_temperature(out, &all)?)?;
    let stiff: Vec<SixVector> = all
        .into_iter()
        .filter(|s| least(cell, s) > LEAST[1])
        .collect();
    let curved = |of: &(dyn Fn(&Tangents, &SixVector) -> f64 + Sync)| -> Vec<f64> {
        let values = stiff.par_iter().map(|s| of(&Tangents::new(cell, s), s));
        clipped(&values.collect::<Vec<_>>())
    };
    let of_d = |t: &Tangents, s: &SixVector| inverse(&t.all).component_mul(&d.tangent(s)).sum();
    let x_cc = fitted("X_cc", &stiff, &curved(&of_d))?;
    let x_sc = fitted(
        "X_sc",
        &stiff,
        &curved(&|t, s| t.trace(&Tangents::new(&d, s))),
    )?;
    let x_ss = fitted(
        "X_ss",
        &stiff,
        &curved(&|t, s| t.trace(&Tangents::new(&d_s, s))),
    )?;
    println!("{table}");
    save(out, "mesh.md", &table)?;
    let added = added(per_kelvin, [d, d_s], [x_cc, x_sc, x_ss]);
    save(out, "heated_rods.csv", &lines(&added))
}

fn thermal_energy() -> f64 {
    BOLTZMANN_PN_NM_PER_K * Homogenised::HEATED_K
}

/// A function that is added to the law of the cells, at 298 K.
struct Added {
    /// Power of `kT`, or 0 for the derivative with respect to temperature.
    order: u32,
    /// Inverse power of the segment length.
    power: u32,
    factor: f64,
    function: Homogenised,
}

fn added(
    per_kelvin: Homogenised,
    [d, d_s]: [Homogenised; 2],
    [x_cc, x_sc, x_ss]: [Homogenised; 3],
) -> Vec<Added> {
    let kt = thermal_energy();
    let (per_cell, second) = ((PERIOD as f64 * constants::RISE).recip(), kt * kt / 8.0);
    vec![
        (0, 0, PER_MILLI.recip(), per_kelvin),
        (1, 0, 0.5 * kt * per_cell, d),
        (1, 1, -0.5 * kt, d_s),
        (2, 0, second * per_cell * per_cell, x_cc),
        (2, 1, -2.0 * second * per_cell, x_sc),
        (2, 2, second, x_ss),
    ]
    .into_iter()
    .map(|(order, power, factor, function)| Added {
        order,
        power,
        factor,
        function,
    })
    .collect()
}

fn deviation(values: &[f64]) -> f64 {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    (values
        .iter()
        .map(|value| (value - mean).powi(2))
        .sum::<f64>()
        / count)
        .sqrt()
}

fn lines(added: &[Added]) -> String {
    let mut text = String::new();
    for one in added {
        for term in Term::ALL {
            let numbers = one.function.coefficients(term).iter();
            let numbers: Vec<String> = numbers
                .map(|number| format!("{:.10e}", one.factor * number))
                .collect();
            let Added { order, power, .. } = one;
            let _ = writeln!(text, "{order} {power} {term:?},{}", numbers.join(","));
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Without bending-shear coupling and with joints as stiff as segments, waves do not matter.
    #[test]
    fn uniform_rods_have_the_determinant_of_the_cell() {
        let all = SixMatrix::from_diagonal(&[4.0, 4.0, 3.0, 2.0, 2.0, 5.0].into());
        let joint = Matrix3::from_diagonal(&[4.0, 4.0, 3.0].into());
        let tangents = Tangents { all, joint };
        assert!((tangents.staggered() - 960.0_f64.ln()).abs() < 1e-12);
        assert!((tangents.trace(&tangents) - 6.0).abs() < 1e-12);
    }
}

//! Coefficients of a law from cells: least squares on energy, loads and tangent, with a penalty where the law's own
//! tangent is not positive.

use super::super::rows::Row;
use super::samples::Region;
use actin_cosserat::{Homogenised, HomogenisedForm, PotentialJet, Term};
use actin_sim::ellipsoid::{SixMatrix, SixVector};
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

/// What counts as a difference of 1: a share of the value, and energy (pN), bending couple, twisting couple
/// (pN nm), shear force and tension (pN).
const SHARE: f64 = 0.05;
const FLOORS: [f64; 5] = [0.01, 0.5, 0.5, 0.1, 1.0];
/// Floor of the twisting couple (pN nm) of the straight filament, which twists easily at rest.
const STRAIGHT: f64 = 0.1;
/// Of the tangent: a share of the roots of diagonal entries, and these at least (pN nm^2, pN). Entries beside the
/// diagonal count more.
const TANGENT: f64 = 0.33;
const BESIDE: f64 = 1.4;
const SOFTEST: [f64; 6] = [5e3, 5e3, 300.0, 12.0, 12.0, 5e3];
/// Cells with a diagonal entry below this, or an eigenvalue below that, are about to change their branch: their
/// tangent says nothing of the others.
const FIRM: [f64; 6] = [1e3, 1e3, -1.0, -1.0, -1.0, 1e3];
const BRANCH: f64 = -50.0;
/// Rows that make up an equation of weight 1 against the conditions.
const ROWS: f64 = 1000.0;
/// Added to the scaled matrix: powers of a bounded variable are nearly dependent.
const RIDGE: f64 = 1e-9;
/// Eigenvalues of the law's tangent are held above this, with curvatures times these lengths (nm): 3 pN of shear,
/// 0.75 pN nm^2 of twist, 1200 of bending.
const LEAST: f64 = 3.0;
const UNITS: [f64; 6] = [20.0, 20.0, 0.5, 1.0, 1.0, 1.0];
/// Least coefficients (pN, pN nm^2) of the terms that are not bounded.
const UNBOUNDED: [(Term, f64); 3] = [
    (Term::AnyStretch, 5e3),
    (Term::AnyBend, 5e3),
    (Term::AnyShear, 500.0),
];
/// Rounds in which new directions without stiffness are looked for, and steps to meet those that are known.
const ROUNDS: usize = 20;
const NEWTON_STEPS: usize = 30;
/// A step is halved so often until it leads down.
const HALVINGS: i32 = 12;

/// Weight of a row and of its tangent on paths of cells that are free to shear; of the grid: [`weights`].
const ON_PATHS: (f64, f64) = (3.0, 3.0);

/// The coefficients of some terms, one after the other.
pub(super) fn columns(terms: &[Term]) -> Vec<(Term, usize)> {
    let powers = |&term: &Term| (0..=term.degree()).map(move |power| (term, power));
    terms.iter().flat_map(powers).collect()
}

/// Energy, couple and force in one list.
pub(super) fn numbers(jet: &PotentialJet) -> [f64; 7] {
    let [a, b, c, d, e, f] = jet.loads.into();
    [jet.energy, a, b, c, d, e, f]
}

/// What counts as a difference of 1 in each of the numbers of a row.
pub(super) fn deviations(row: &Row) -> [f64; 7] {
    let [energy, couple, twisting, force, tension] = FLOORS;
    let is_straight = row.strain[0] == 0.0 && row.strain[2] == 0.0 && row.extension >= 0.0;
    let twisting = if is_straight { STRAIGHT } else { twisting };
    let m = couple + SHARE * row.loads.fixed_rows::<2>(0).norm();
    let m3 = twisting + SHARE * row.loads[2].abs();
    let n = force + SHARE * row.loads.fixed_rows::<2>(3).norm();
    let n3 = tension + SHARE * row.loads[5].abs();
    [energy + SHARE * row.energy, m, m, m3, n, n, n3]
}

/// Weight of a row and of its tangent: twist and tension alone and stiffness at rest count most, compression least,
/// where the cell changes its branch and no smooth law follows it.
fn weights(row: &Row) -> (f64, f64) {
    let [curvature, twist, shear, ..] = row.strain;
    let weight = match (curvature == 0.0, shear == 0.0) {
        _ if row.extension < -1e-3 => 0.15,
        _ if row.extension < -1e-4 => 0.4,
        (true, true) => 12.0,
        (false, false) => 1.0,
        _ => 1.5,
    };
    let is_small = curvature <= 1e-3 && shear <= 1e-3;
    let is_rest = is_small && twist.abs() < 4e-3 && (-1e-4..1e-3).contains(&row.extension);
    let of_tangent = match (is_small, is_rest) {
        (_, true) => 8.0,
        (true, _) => 3.0,
        _ => 1.0,
    };
    (weight, of_tangent * weight)
}

/// Normal equations of all coefficients.
pub(super) struct Normal {
    matrix: DMatrix<f64>,
    right: DVector<f64>,
}

impl Normal {
    /// Of all terms, in their order.
    pub(super) fn new(form: &HomogenisedForm, grid: &[&Row], paths: &[Row]) -> Self {
        let n = columns(&Term::ALL).len();
        let zero = || (DMatrix::zeros(n, n), DVector::zeros(n));
        // Chunks are added in their order, so that the result does not depend on the number of cores.
        let of_grid = grid.iter().map(|row| (*row, weights(row)));
        let of_paths = paths.iter().map(|row| (row, ON_PATHS));
        let rows: Vec<(&Row, (f64, f64))> = of_grid.chain(of_paths).collect();
        let chunk = |rows: &[(&Row, (f64, f64))]| {
            let (mut matrix, mut right) = zero();
            for (row, weights) in rows {
                let (left, values) = equations(form, row, *weights, n);
                matrix.gemm_tr(1.0, &left, &left, 1.0);
                right.gemv_tr(1.0, &left, &values, 1.0);
            }
            (matrix, right)
        };
        let chunks: Vec<_> = rows.par_chunks(256).map(chunk).collect();
        let add = |(a, b), (c, d): &(_, _)| (a + c, b + d);
        let (matrix, right) = chunks.iter().fold(zero(), add);
        let scale = ROWS / rows.len() as f64;
        Self {
            matrix: matrix * scale,
            right: right * scale,
        }
    }

    /// The equations of some terms alone.
    fn of(&self, terms: &[Term]) -> Self {
        let all = columns(&Term::ALL);
        let kept = all
            .iter()
            .enumerate()
            .filter(|(_, (t, _))| terms.contains(t));
        let kept: Vec<usize> = kept.map(|(k, _)| k).collect();
        Self {
            matrix: self.matrix.select_columns(&kept).select_rows(&kept),
            right: self.right.select_rows(&kept),
        }
    }
}

/// The weighted equations of a row: seven numbers, and the upper triangle of the tangent.
fn equations(
    form: &HomogenisedForm,
    row: &Row,
    (weight, of_tangent): (f64, f64),
    n: usize,
) -> (DMatrix<f64>, DVector<f64>) {
    let units: Vec<PotentialJet> = all_units(form, &row.six());
    let measured = PotentialJet {
        energy: row.energy,
        loads: row.loads,
        tangent: row.tangent,
    };
    let sizes = deviations(row).map(|size| weight / size);
    let entries = entries(row);
    let count = 7 + entries.len();
    let numbers_of = |jet: &PotentialJet| -> Vec<f64> {
        let first = numbers(jet).into_iter().zip(sizes);
        let second = entries
            .iter()
            .map(|(at, w)| jet.tangent[*at] * w * of_tangent);
        first.map(|(x, w)| x * w).chain(second).collect()
    };
    let left = units.iter().flat_map(numbers_of);
    (
        DMatrix::from_iterator(count, n, left),
        DVector::from_vec(numbers_of(&measured)),
    )
}

/// Units of all coefficients.
fn all_units(form: &HomogenisedForm, strain: &SixVector) -> Vec<PotentialJet> {
    let units = |term| form.units(term, strain);
    Term::ALL.into_iter().flat_map(units).collect()
}

/// Entries of the tangent that count, with their weights.
fn entries(row: &Row) -> Vec<((usize, usize), f64)> {
    let diagonal = row.tangent.diagonal();
    let is_firm = (0..6).all(|k| diagonal[k] > FIRM[k]) && row.least_stiffness() > BRANCH;
    let size = |k: usize| diagonal[k].max(SOFTEST[k]);
    let weight = |(i, j): (usize, usize)| {
        let beside = if i == j { 1.0 } else { BESIDE };
        beside / (TANGENT * (size(i) * size(j)).sqrt())
    };
    let upper = (0..6).flat_map(|i| (i..6).map(move |j| (i, j)));
    let kept = upper.filter(|_| is_firm);
    kept.map(|place| (place, weight(place))).collect()
}

/// The law of these terms that fits best, whatever its tangent.
pub(super) fn best(
    form: &HomogenisedForm,
    normal: &Normal,
    terms: &[Term],
) -> Result<Homogenised, String> {
    let none = Conditions::default();
    let found = none.solve(&normal.of(terms), None)?;
    law(form, terms, &found)
}

/// The law with these coefficients.
fn law(
    form: &HomogenisedForm,
    terms: &[Term],
    found: &DVector<f64>,
) -> Result<Homogenised, String> {
    let columns = columns(terms);
    let of_term = |term| {
        let all = columns.iter().zip(found.iter());
        let own = all.filter(|((other, _), _)| *other == term);
        own.map(|(_, value)| *value).collect()
    };
    Homogenised::new(form.clone(), of_term).map_err(|e| e.to_string())
}

/// The law of all terms that fits best among those with a positive tangent in the regions.
pub(super) fn positive(
    form: &HomogenisedForm,
    normal: &Normal,
    regions: &[(Region, u64)],
) -> Result<Homogenised, String> {
    let places = regions.iter();
    let places = places.flat_map(|(region, count)| region.strains(form, 0, *count));
    let places: Vec<SixVector> = places.collect();
    let mut conditions = Conditions {
        rows: unbounded().collect(),
    };
    let mut found = conditions.solve(normal, None)?;
    for _ in 0..ROUNDS {
        let law = law(form, &Term::ALL, &found)?;
        let soft = |strain: &SixVector| soft_directions(&law, strain);
        let new: Vec<_> = places.par_iter().flat_map_iter(soft).collect();
        if new.is_empty() {
            break;
        }
        conditions.rows.extend(new);
        found = conditions.solve(normal, Some(found))?;
    }
    law(form, &Term::ALL, &found)
}

/// Conditions that the terms which are not bounded stay positive at any strain.
fn unbounded() -> impl Iterator<Item = DVector<f64>> {
    let columns = columns(&Term::ALL);
    let row = move |(term, least): (Term, f64)| {
        let is_own = |(other, _): &(Term, usize)| f64::from(u8::from(*other == term)) / least;
        DVector::from_iterator(columns.len(), columns.iter().map(is_own))
    };
    UNBOUNDED.into_iter().map(row)
}

/// The two softest directions at a strain, if they are too soft: what each coefficient brings there, over the least
/// stiffness that there should be.
fn soft_directions(law: &Homogenised, strain: &SixVector) -> Vec<DVector<f64>> {
    let unit = SixMatrix::from_diagonal(&UNITS.map(f64::recip).into());
    let eigen = (unit * law.tangent(strain) * unit).symmetric_eigen();
    let mut order: Vec<usize> = (0..6).collect();
    order.sort_by(|&a, &b| eigen.eigenvalues[a].total_cmp(&eigen.eigenvalues[b]));
    order.truncate(2);
    order.retain(|&k| eigen.eigenvalues[k] < LEAST);
    if order.is_empty() {
        return Vec::new();
    }
    let units = all_units(law.form(), strain);
    let row = |k: usize| {
        let direction = unit * eigen.eigenvectors.column(k);
        let stiffness = |jet: &PotentialJet| direction.dot(&(jet.tangent * direction)) / LEAST;
        DVector::from_iterator(units.len(), units.iter().map(stiffness))
    };
    order.into_iter().map(row).collect()
}

/// Stiffness in some directions that should be at least a margin above 1.
#[derive(Default)]
struct Conditions {
    rows: Vec<DVector<f64>>,
}

/// Weight of a direction without stiffness, where an equation of the fit has 1; and what is aimed at in a direction that
/// was too soft.
const STRENGTH: f64 = 10.0;
const MARGIN: f64 = 1.3;

impl Conditions {
    /// Least squares, with the squares of what lacks in each direction added.
    fn solve(&self, normal: &Normal, start: Option<DVector<f64>>) -> Result<DVector<f64>, String> {
        let scale = normal.matrix.diagonal().map(|x| x.sqrt().max(1e-300));
        let mut found = start.unwrap_or_else(|| DVector::zeros(scale.len()));
        for _ in 0..NEWTON_STEPS {
            let lacking = |row: &&DVector<f64>| row.dot(&found) < MARGIN;
            let (mut matrix, mut right) = (normal.matrix.clone(), normal.right.clone());
            for row in self.rows.iter().filter(lacking) {
                matrix.ger(STRENGTH, row, row, 1.0);
                right.axpy(STRENGTH * MARGIN, row, 1.0);
            }
            let scaled = |i: usize, j: usize| {
                matrix[(i, j)] / (scale[i] * scale[j]) + if i == j { RIDGE } else { 0.0 }
            };
            let n = scale.len();
            let factor = DMatrix::from_fn(n, n, scaled).cholesky();
            let factor = factor.ok_or("the equations of the law are not independent")?;
            let best = factor
                .solve(&right.component_div(&scale))
                .component_div(&scale);
            let step = best - &found;
            let now = self.objective(normal, &found);
            let shares = (0..HALVINGS).map(|k| 0.5_f64.powi(k));
            let Some(next) = shares
                .map(|share| &found + &step * share)
                .find(|next| self.objective(normal, next) < now)
            else {
                break;
            };
            found = next;
            let size = |x: &DVector<f64>| x.component_mul(&scale).amax();
            if size(&step) <= 1e-8 * size(&found) {
                break;
            }
        }
        Ok(found)
    }

    /// What is made least, but for a constant.
    fn objective(&self, normal: &Normal, found: &DVector<f64>) -> f64 {
        let fit = found.dot(&(0.5 * (&normal.matrix * found) - &normal.right));
        let lack = |row: &DVector<f64>| (MARGIN - row.dot(found)).max(0.0).powi(2);
        let lacks: f64 = self.rows.iter().map(lack).sum();
        fit + 0.5 * STRENGTH * lacks
    }
}

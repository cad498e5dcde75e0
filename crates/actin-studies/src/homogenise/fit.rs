//! Least-squares fit of the coefficients of a law to energies, loads, tangents and strains of cells, with a penalty
//! on directions in which the tangent of the law is not positive.

use super::rows::Row;
use actin_cosserat::{Homogenised, HomogenisedForm, PotentialJet, Term};
use actin_sim::ellipsoid::{SixMatrix, SixVector};
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

/// Number of rows with the total weight of one unit condition.
const ROWS: f64 = 1000.0;
/// Regularisation of the scaled matrix, since powers of a bounded variable are nearly dependent.
const RIDGE: f64 = 1e-9;
/// Eigenvalues of the tangent below this are penalised (pN, in the units of [`Positivity`]).
const LEAST: f64 = 3.0;
/// Smallest coefficients (pN, pN nm^2) of the unbounded terms.
const UNBOUNDED: [(Term, f64); 3] = [
    (Term::AnyStretch, 5e3),
    (Term::AnyBend, 5e3),
    (Term::AnyShear, 500.0),
];
/// Largest number of searches for soft directions, and of Newton steps in each.
const ROUNDS: usize = 20;
const NEWTON_STEPS: usize = 30;
const HALVINGS: i32 = 12;

fn columns(terms: &[Term]) -> Vec<(Term, usize)> {
    let powers = |&term: &Term| (0..=term.degree()).map(move |power| (term, power));
    terms.iter().flat_map(powers).collect()
}

fn numbers(jet: &PotentialJet) -> [f64; 7] {
    let [a, b, c, d, e, f] = jet.loads.into();
    [jet.energy, a, b, c, d, e, f]
}

type Place = (usize, usize);

pub(super) struct Weighted<'a> {
    pub(super) row: &'a Row,
    /// Weights of energy, torque and force; 0 for unknown values.
    pub(super) numbers: [f64; 7],
    /// Weights of entries in the upper triangle of the tangent.
    pub(super) tangent: Vec<(Place, f64)>,
    /// Weighted linear combinations of torque and force that are fitted in addition.
    pub(super) sums: Vec<SixVector>,
}

impl Weighted<'_> {
    fn of(&self, jet: &PotentialJet) -> Vec<f64> {
        let known = numbers(jet).into_iter().zip(self.numbers);
        let known = known.filter(|(_, weight)| *weight > 0.0);
        let entries = self.tangent.iter().map(|(at, w)| jet.tangent[*at] * w);
        let sums = self.sums.iter().map(|sum| sum.dot(&jet.loads));
        known
            .map(|(x, w)| x * w)
            .chain(entries)
            .chain(sums)
            .collect()
    }

    fn equations(&self, form: &HomogenisedForm, terms: &[Term]) -> (DMatrix<f64>, DVector<f64>) {
        let right = self.of(&self.row.jet());
        let units = units(form, terms, &self.row.six());
        let left = units.iter().flat_map(|unit| self.of(unit));
        (
            DMatrix::from_iterator(right.len(), units.len(), left),
            DVector::from_vec(right),
        )
    }
}

pub(super) struct Normal<'a> {
    form: &'a HomogenisedForm,
    terms: Vec<Term>,
    matrix: DMatrix<f64>,
    right: DVector<f64>,
}

impl<'a> Normal<'a> {
    pub(super) fn new(form: &'a HomogenisedForm, terms: &[Term], rows: &[Weighted<'_>]) -> Self {
        let n = columns(terms).len();
        let zero = || (DMatrix::zeros(n, n), DVector::zeros(n));
        // Chunks are added in order: the result is independent of the number of cores.
        let chunk = |rows: &[Weighted<'_>]| {
            let (mut matrix, mut right) = zero();
            for row in rows {
                let (left, values) = row.equations(form, terms);
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
            form,
            terms: terms.to_vec(),
            matrix: matrix * scale,
            right: right * scale,
        }
    }

    pub(super) fn best(&self) -> Result<Homogenised, String> {
        self.law(&Conditions::default().solve(self, None)?)
    }

    /// Returns the best fit, with a penalty if the tangent is not positive at the strains `places`.
    pub(super) fn positive(
        &self,
        places: &[SixVector],
        positivity: &Positivity,
    ) -> Result<Homogenised, String> {
        let rows: Vec<_> = self.unbounded().collect();
        let mut conditions = Conditions {
            hard: rows.len(),
            rows,
            strength: positivity.strength,
        };
        let mut found = conditions.solve(self, None)?;
        for _ in 0..ROUNDS {
            let law = self.law(&found)?;
            let soft = |strain: &SixVector| self.soft_directions(&law, strain, &positivity.units);
            let new: Vec<_> = places.par_iter().flat_map_iter(soft).collect();
            if new.is_empty() {
                break;
            }
            conditions.rows.extend(new);
            found = conditions.solve(self, Some(found))?;
        }
        self.law(&found)
    }

    fn law(&self, found: &DVector<f64>) -> Result<Homogenised, String> {
        let columns = columns(&self.terms);
        let of_term = |term| {
            let all = columns.iter().zip(found.iter());
            let own = all.filter(|((other, _), _)| *other == term);
            own.map(|(_, value)| *value).collect()
        };
        Homogenised::new(self.form.clone(), of_term).map_err(|e| e.to_string())
    }

    /// Returns the conditions that unbounded terms are positive at any strain; under compression, both of them.
    fn unbounded(&self) -> impl Iterator<Item = DVector<f64>> {
        let columns = columns(&self.terms);
        let compressed = |t: f64| {
            let (_, least) = UNBOUNDED[0];
            (Term::AnyStretch, least, Some(t))
        };
        let alone = UNBOUNDED
            .into_iter()
            .map(|(term, least)| (term, least, None));
        let sides = (-4..=4).map(move |k| compressed(0.25 * f64::from(k)));
        alone.chain(sides).map(move |(own, least, compressed)| {
            let part = |&(term, power): &(Term, usize)| match compressed {
                _ if term == own => 1.0 / least,
                Some(t) if term == Term::Compression => {
                    (0..power).fold(1.0, |product, _| product * t) / least
                }
                _ => 0.0,
            };
            DVector::from_iterator(columns.len(), columns.iter().map(part))
        })
    }

    /// Returns the two softest directions at a strain, if too soft: the contribution of each coefficient, divided by
    /// the smallest allowed stiffness.
    fn soft_directions(
        &self,
        law: &Homogenised,
        strain: &SixVector,
        units: &[f64; 6],
    ) -> Vec<DVector<f64>> {
        let unit = SixMatrix::from_diagonal(&units.map(f64::recip).into());
        let eigen = (unit * law.tangent(strain) * unit).symmetric_eigen();
        let mut order: Vec<usize> = (0..6).collect();
        order.sort_by(|&a, &b| eigen.eigenvalues[a].total_cmp(&eigen.eigenvalues[b]));
        order.truncate(2);
        order.retain(|&k| eigen.eigenvalues[k] < LEAST);
        if order.is_empty() {
            return Vec::new();
        }
        let units = self::units(self.form, &self.terms, strain);
        let row = |k: usize| {
            let direction = unit * eigen.eigenvectors.column(k);
            let stiffness = |jet: &PotentialJet| direction.dot(&(jet.tangent * direction)) / LEAST;
            DVector::from_iterator(units.len(), units.iter().map(stiffness))
        };
        order.into_iter().map(row).collect()
    }
}

pub(super) struct Positivity {
    /// Units of the strains (nm, 1), in which the stiffness in all directions should be at least [`LEAST`].
    pub(super) units: [f64; 6],
    /// Weight of a zero-stiffness direction, relative to an equation of the fit.
    pub(super) strength: f64,
}

impl Positivity {
    /// Returns the smallest eigenvalue (pN) of the tangent of a cell in these units.
    pub(super) fn least(&self, row: &Row) -> f64 {
        let unit = SixMatrix::from_diagonal(&self.units.map(f64::recip).into());
        (unit * row.tangent * unit).symmetric_eigenvalues().min()
    }
}

fn units(form: &HomogenisedForm, terms: &[Term], strain: &SixVector) -> Vec<PotentialJet> {
    let units = |&term: &Term| form.units(term, strain);
    terms.iter().flat_map(units).collect()
}

#[derive(Default)]
struct Conditions {
    rows: Vec<DVector<f64>>,
    hard: usize,
    strength: f64,
}

/// Target stiffness of soft directions.
const MARGIN: f64 = 1.3;
/// Weight of conditions that must hold.
const HARD: f64 = 1e5;

impl Conditions {
    fn strength(&self, k: usize) -> f64 {
        if k < self.hard { HARD } else { self.strength }
    }

    fn solve(
        &self,
        normal: &Normal<'_>,
        start: Option<DVector<f64>>,
    ) -> Result<DVector<f64>, String> {
        let scale = normal.matrix.diagonal().map(|x| x.sqrt().max(1e-300));
        let mut found = start.unwrap_or_else(|| DVector::zeros(scale.len()));
        for _ in 0..NEWTON_STEPS {
            let curvature_difference = |(_, row): &(usize, &DVector<f64>)| row.dot(&found) < MARGIN;
            let (mut matrix, mut right) = (normal.matrix.clone(), normal.right.clone());
            for (k, row) in self.rows.iter().enumerate().filter(curvature_difference) {
                let strength = self.strength(k);
                matrix.ger(strength, row, row, 1.0);
                right.axpy(strength * MARGIN, row, 1.0);
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

    fn objective(&self, normal: &Normal<'_>, found: &DVector<f64>) -> f64 {
        let fit = found.dot(&(0.5 * (&normal.matrix * found) - &normal.right));
        let lack = |(k, row): (usize, &DVector<f64>)| {
            self.strength(k) * (MARGIN - row.dot(found)).max(0.0).powi(2)
        };
        let lacks: f64 = self.rows.iter().enumerate().map(lack).sum();
        fit + 0.5 * lacks
    }
}

/// Formats the law as a table: stretch at rest, natural length, and one line of coefficients in ascending order for
/// each term.
pub(super) fn coefficients(law: &Homogenised) -> String {
    let line = |name: String, numbers: &[f64]| {
        let numbers: Vec<String> = numbers.iter().map(|x| format!("{x:.10e}")).collect();
        format!("{name},{}\n", numbers.join(","))
    };
    let terms = Term::ALL.map(|term| line(format!("{term:?}"), law.coefficients(term)));
    let form = law.form();
    let first = [("rest", &[form.rest()][..]), ("natural", form.natural())];
    let first = first.map(|(name, numbers)| line(name.to_owned(), numbers));
    first.concat() + &terms.concat()
}

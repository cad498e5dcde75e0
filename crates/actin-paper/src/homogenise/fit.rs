//! Coefficients of a law from cells: least squares on energy, loads and tangent, with a penalty where the law's own
//! tangent is not positive.

use super::region::Region;
use super::rows::Row;
use actin_cosserat::{Homogenised, HomogenisedForm, PotentialJet, Term};
use actin_sim::ellipsoid::{SixMatrix, SixVector};
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

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

/// The coefficients of some terms, one after the other.
fn columns(terms: &[Term]) -> Vec<(Term, usize)> {
    let powers = |&term: &Term| (0..=term.degree()).map(move |power| (term, power));
    terms.iter().flat_map(powers).collect()
}

/// Energy, couple and force in one list.
pub(super) fn numbers(jet: &PotentialJet) -> [f64; 7] {
    let [a, b, c, d, e, f] = jet.loads.into();
    [jet.energy, a, b, c, d, e, f]
}

/// An entry of the tangent.
type Place = (usize, usize);

/// A cell with what its numbers weigh.
pub(super) struct Weighted<'a> {
    pub(super) row: &'a Row,
    /// Of energy, couple and force; of weight 0 are those that are not known.
    pub(super) numbers: [f64; 7],
    /// Of entries of the upper triangle of the tangent.
    pub(super) tangent: Vec<(Place, f64)>,
}

impl Weighted<'_> {
    /// The weighted numbers of the cell, or of a unit of a law at its strain.
    fn of(&self, jet: &PotentialJet) -> Vec<f64> {
        let known = numbers(jet).into_iter().zip(self.numbers);
        let known = known.filter(|(_, weight)| *weight > 0.0);
        let entries = self.tangent.iter().map(|(at, w)| jet.tangent[*at] * w);
        known.map(|(x, w)| x * w).chain(entries).collect()
    }

    /// The coefficients' equations: their matrix and right side.
    fn equations(&self, form: &HomogenisedForm, terms: &[Term]) -> (DMatrix<f64>, DVector<f64>) {
        let measured = PotentialJet {
            energy: self.row.energy,
            loads: self.row.loads,
            tangent: self.row.tangent,
        };
        let right = self.of(&measured);
        let units = units(form, terms, &self.row.six());
        let left = units.iter().flat_map(|unit| self.of(unit));
        (
            DMatrix::from_iterator(right.len(), units.len(), left),
            DVector::from_vec(right),
        )
    }
}

/// Entries of the upper triangle.
pub(super) fn upper() -> impl Iterator<Item = Place> {
    (0..6).flat_map(|i| (i..6).map(move |j| (i, j)))
}

/// Normal equations of the coefficients of some terms.
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
        // Chunks are added in their order, so that the result does not depend on the number of cores.
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

    /// The equations of some of the terms alone.
    fn of(&self, terms: &[Term]) -> Self {
        let all = columns(&self.terms);
        let kept = all
            .iter()
            .enumerate()
            .filter(|(_, (t, _))| terms.contains(t));
        let kept: Vec<usize> = kept.map(|(k, _)| k).collect();
        Self {
            form: self.form,
            terms: terms.to_vec(),
            matrix: self.matrix.select_columns(&kept).select_rows(&kept),
            right: self.right.select_rows(&kept),
        }
    }

    /// The law of some of the terms that fits best, whatever its tangent; they stand in the order of all.
    pub(super) fn best(&self, terms: &[Term]) -> Result<Homogenised, String> {
        let normal = self.of(terms);
        normal.law(&Conditions::default().solve(&normal, None)?)
    }

    /// The law of all terms that fits best among those with a positive tangent in the regions.
    pub(super) fn positive(&self, regions: &[(Region, u64)]) -> Result<Homogenised, String> {
        let places = regions.iter();
        let places = places.flat_map(|(region, count)| region.strains(self.form, 0, *count));
        let places: Vec<SixVector> = places.collect();
        let mut conditions = Conditions {
            rows: self.unbounded().collect(),
        };
        let mut found = conditions.solve(self, None)?;
        for _ in 0..ROUNDS {
            let law = self.law(&found)?;
            let soft = |strain: &SixVector| self.soft_directions(&law, strain);
            let new: Vec<_> = places.par_iter().flat_map_iter(soft).collect();
            if new.is_empty() {
                break;
            }
            conditions.rows.extend(new);
            found = conditions.solve(self, Some(found))?;
        }
        self.law(&found)
    }

    /// The law with these coefficients.
    fn law(&self, found: &DVector<f64>) -> Result<Homogenised, String> {
        let columns = columns(&self.terms);
        let of_term = |term| {
            let all = columns.iter().zip(found.iter());
            let own = all.filter(|((other, _), _)| *other == term);
            own.map(|(_, value)| *value).collect()
        };
        Homogenised::new(self.form.clone(), of_term).map_err(|e| e.to_string())
    }

    /// Conditions that the terms which are not bounded stay positive at any strain.
    fn unbounded(&self) -> impl Iterator<Item = DVector<f64>> {
        let columns = columns(&self.terms);
        let row = move |(term, least): (Term, f64)| {
            let is_own = |(other, _): &(Term, usize)| f64::from(u8::from(*other == term)) / least;
            DVector::from_iterator(columns.len(), columns.iter().map(is_own))
        };
        UNBOUNDED.into_iter().map(row)
    }

    /// The two softest directions at a strain, if they are too soft: what each coefficient brings there, over the
    /// least stiffness that there should be.
    fn soft_directions(&self, law: &Homogenised, strain: &SixVector) -> Vec<DVector<f64>> {
        let unit = SixMatrix::from_diagonal(&UNITS.map(f64::recip).into());
        let eigen = (unit * law.tangent(strain) * unit).symmetric_eigen();
        let mut order: Vec<usize> = (0..6).collect();
        order.sort_by(|&a, &b| eigen.eigenvalues[a].total_cmp(&eigen.eigenvalues[b]));
        order.truncate(2);
        order.retain(|&k| eigen.eigenvalues[k] < LEAST);
        if order.is_empty() {
            return Vec::new();
        }
        let units = units(self.form, &self.terms, strain);
        let row = |k: usize| {
            let direction = unit * eigen.eigenvectors.column(k);
            let stiffness = |jet: &PotentialJet| direction.dot(&(jet.tangent * direction)) / LEAST;
            DVector::from_iterator(units.len(), units.iter().map(stiffness))
        };
        order.into_iter().map(row).collect()
    }
}

/// Units of all coefficients of some terms.
fn units(form: &HomogenisedForm, terms: &[Term], strain: &SixVector) -> Vec<PotentialJet> {
    let units = |&term: &Term| form.units(term, strain);
    terms.iter().flat_map(units).collect()
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
    fn solve(
        &self,
        normal: &Normal<'_>,
        start: Option<DVector<f64>>,
    ) -> Result<DVector<f64>, String> {
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
    fn objective(&self, normal: &Normal<'_>, found: &DVector<f64>) -> f64 {
        let fit = found.dot(&(0.5 * (&normal.matrix * found) - &normal.right));
        let lack = |row: &DVector<f64>| (MARGIN - row.dot(found)).max(0.0).powi(2);
        let lacks: f64 = self.rows.iter().map(lack).sum();
        fit + 0.5 * STRENGTH * lacks
    }
}

/// The law as a table: a line for the stretch at rest, one for the natural length and one for each term, coefficients from the constant up.
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

//! Factorisation `K + shift M = L D L^T` without pivoting, and its inertia.
//!
//! The computed factors are exact for a matrix that differs from `K` by about
//! `eps (|L| |D| |L^T|)_ij`, at most `eps` times the largest [`growth`](Factor::growth).
//!
//! # Source
//! N. J. Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed. (2002), theorems 10.3 and
//! 11.4; faer, `sparse::linalg::cholesky::simplicial`.

use crate::band::{Band, Eliminate, Solve};
use actin_mechanics::wide;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::ldlt::factor::LdltRegularization;
use faer::sparse::linalg::cholesky::simplicial;
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par};
use std::ops::Range;

/// A pivot within this many roundings of its diagonal entry is doubtful.
const PIVOT_ROUNDINGS: f64 = 8.0;

/// Energy fraction of a pivot below rounding: amplitudes of 1e-12.
const UNSEEN: f64 = 1e-24;

/// Pivots below this fraction of their diagonal entry have no stiffness.
const FLOPPY: f64 = 1e-10;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Inertia {
    /// Number of negative pivots, or eigenvalues by Sylvester's law.
    pub(crate) negative: usize,
    /// Number of pivots that are zero within rounding.
    pub(crate) doubtful: usize,
    /// Number of pivots that are exactly zero or not finite.
    pub(crate) zero: usize,
}

impl Inertia {
    pub(crate) fn is_positive(&self) -> bool {
        self.negative == 0 && self.doubtful == 0
    }
}

pub(crate) struct Factor {
    symbolic: simplicial::SymbolicSimplicialCholesky<usize>,
    band: Option<Band>,
    values: Vec<f64>,
    shifted: Vec<f64>,
    diagonal: Vec<f64>,
    /// Replacement of zero pivots.
    least: f64,
    memory: MemBuffer,
}

impl std::fmt::Debug for Factor {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Factor")
            .field("unknowns", &self.symbolic.nrows())
            .field("entries", &self.entries())
            .finish_non_exhaustive()
    }
}

impl Factor {
    /// Symbolic factorisation.
    pub(crate) fn new(upper: &SymbolicSparseColMat<usize>) -> Self {
        let upper = upper.as_ref();
        let n = upper.ncols();
        let (mut tree, mut counts) = (vec![0isize; n], vec![0usize; n]);
        let mut memory = MemBuffer::new(
            simplicial::prefactorize_symbolic_cholesky_scratch::<usize>(n, upper.row_idx().len())
                .or(simplicial::factorize_simplicial_symbolic_cholesky_scratch::<usize>(n)),
        );
        let stack = MemStack::new(&mut memory);
        let tree = simplicial::prefactorize_symbolic_cholesky(&mut tree, &mut counts, upper, stack);
        let symbolic =
            simplicial::factorize_simplicial_symbolic_cholesky(upper, tree, &counts, stack)
                .expect("the factor of a filament fits into memory");
        Self {
            values: vec![0.0; symbolic.len_val()],
            band: Band::from_symbolic(&symbolic),
            symbolic,
            shifted: Vec::new(),
            diagonal: Vec::new(),
            least: 0.0,
            memory: MemBuffer::new(simplicial::factorize_simplicial_numeric_ldlt_scratch::<
                usize,
                f64,
            >(n)),
        }
    }

    pub(crate) fn entries(&self) -> usize {
        self.symbolic.len_val()
    }

    #[cfg(test)]
    pub(crate) fn is_band(&self) -> bool {
        self.band.is_some()
    }

    #[cfg(test)]
    pub(crate) fn with_gaps(mut self) -> Self {
        self.band = None;
        self
    }

    pub(crate) fn factorize(
        &mut self,
        upper: SymbolicSparseColMatRef<'_, usize>,
        values: &[f64],
        metric: &[f64],
        shift: f64,
    ) -> Inertia {
        self.shifted.clear();
        self.shifted.extend_from_slice(values);
        self.factorize_shifted(upper, metric, shift)
    }

    /// Factorises the ranges `changed` of columns, which are not coupled to others. Returns the
    /// inertia of the ranges `all`.
    pub(crate) fn factorize_columns(
        &mut self,
        upper: SymbolicSparseColMatRef<'_, usize>,
        values: &[f64],
        (changed, all): (&[Range<usize>], &[Range<usize>]),
    ) -> Inertia {
        self.diagonal.resize(upper.ncols(), 0.0);
        for column in changed.iter().cloned().flatten() {
            self.diagonal[column] = values[upper.col_ptr()[column + 1] - 1].abs();
        }
        self.eliminate(upper, values, changed);
        self.inertia(all)
    }

    pub(crate) fn factorize_sum(
        &mut self,
        upper: SymbolicSparseColMatRef<'_, usize>,
        (values, other): (&[f64], &[f64]),
        metric: &[f64],
        shift: f64,
    ) -> Inertia {
        self.shifted.clear();
        self.shifted
            .extend(values.iter().zip(other).map(|(k, t)| k + t));
        self.factorize_shifted(upper, metric, shift)
    }

    /// Pivots of exactly zero are replaced by one rounding of the largest diagonal entry and are
    /// doubtful.
    fn factorize_shifted(
        &mut self,
        upper: SymbolicSparseColMatRef<'_, usize>,
        metric: &[f64],
        shift: f64,
    ) -> Inertia {
        for (&end, weight) in upper.col_ptr()[1..].iter().zip(metric) {
            self.shifted[end - 1] += shift * weight;
        }
        self.diagonal.clear();
        let ends = &upper.col_ptr()[1..];
        self.diagonal
            .extend(ends.iter().map(|&end| self.shifted[end - 1].abs()));
        let all = 0..upper.ncols();
        let shifted = std::mem::take(&mut self.shifted);
        self.eliminate(upper, &shifted, std::slice::from_ref(&all));
        self.shifted = shifted;
        self.inertia(&[all])
    }

    /// Factorises `matrix`. Only columns of a band can be selected; else all are factorised.
    fn eliminate(
        &mut self,
        upper: SymbolicSparseColMatRef<'_, usize>,
        matrix: &[f64],
        ranges: &[Range<usize>],
    ) {
        let largest = self.largest_diagonal();
        let least = (f64::EPSILON * largest).max(f64::MIN_POSITIVE);
        self.least = least;
        if let Some(band) = &self.band {
            band.place(upper, matrix, &mut self.values, ranges);
            let values = &mut self.values;
            wide::dispatch(Eliminate {
                band,
                values,
                least,
                ranges,
            });
        } else {
            self.eliminate_with_gaps(upper, matrix, least);
        }
    }

    /// A non-finite pivot ends the elimination; the remaining pivots are doubtful.
    fn eliminate_with_gaps(
        &mut self,
        upper: SymbolicSparseColMatRef<'_, usize>,
        matrix: &[f64],
        least: f64,
    ) {
        let regularization = LdltRegularization {
            dynamic_regularization_signs: None,
            dynamic_regularization_delta: least,
            dynamic_regularization_epsilon: 0.0,
        };
        let done = simplicial::factorize_simplicial_numeric_ldlt(
            &mut self.values,
            SparseColMatRef::new(upper, matrix),
            regularization,
            &self.symbolic,
            MemStack::new(&mut self.memory),
        );
        if done.is_err() {
            self.values.fill(f64::NAN);
        }
    }

    /// Pivots equal to `least` replace zeros.
    fn inertia(&self, ranges: &[Range<usize>]) -> Inertia {
        let mut inertia = Inertia::default();
        for column in ranges.iter().cloned().flatten() {
            let pivot = self.pivot(column);
            let rounding = PIVOT_ROUNDINGS * f64::EPSILON * self.diagonal[column];
            inertia.negative += usize::from(pivot < 0.0);
            let is_none = !pivot.is_finite() || pivot.to_bits() == self.least.to_bits();
            inertia.zero += usize::from(is_none);
            inertia.doubtful += usize::from(is_none || pivot.abs() <= rounding);
        }
        inertia
    }

    pub(crate) fn floppy(&self) -> usize {
        let diagonal = self.diagonal.iter().enumerate();
        let is_floppy = |&(column, own): &(usize, &f64)| self.pivot(column).abs() <= FLOPPY * own;
        diagonal.filter(is_floppy).count()
    }

    /// Columns with pivots not positive beyond rounding.
    pub(crate) fn indefinite_columns(
        &self,
        ranges: &[Range<usize>],
    ) -> impl Iterator<Item = usize> {
        ranges.iter().cloned().flatten().filter(|&column| {
            let rounding = PIVOT_ROUNDINGS * f64::EPSILON * self.diagonal[column];
            let pivot = self.pivot(column);
            pivot <= rounding || pivot.is_nan()
        })
    }

    fn pivot(&self, column: usize) -> f64 {
        self.values[self.symbolic.col_ptr()[column]]
    }

    pub(crate) fn solve(&mut self, b: &mut [f64]) {
        let rows = b.len();
        simplicial::SimplicialLdltRef::new(&self.symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(b, rows, 1),
            Par::Seq,
            MemStack::new(&mut self.memory),
        );
    }

    /// Solves for the ranges of unknowns, which are not coupled to others.
    pub(crate) fn solve_columns(&mut self, b: &mut [f64], ranges: &[Range<usize>]) {
        match &self.band {
            Some(band) => wide::dispatch(Solve {
                band,
                values: &self.values,
                b,
                ranges,
            }),
            None => self.solve(b),
        }
    }

    /// Solves `L^T x = |D|^(-1/2) b`: white noise `b` gives the covariance `(L |D| L^T)^(-1)`.
    pub(crate) fn spread(&self, b: &mut [f64]) {
        for column in (0..b.len()).rev() {
            let below: f64 = self.below(column).map(|(row, value)| value * b[row]).sum();
            b[column] = b[column] / self.pivot(column).abs().sqrt() - below;
        }
    }

    /// Returns `true` if the loads `f` meet positive pivots only, for instance by symmetry. No
    /// pivot may be doubtful.
    ///
    /// With `L y = f` the step `p` of `L D L^T p = f` has the energy `f . p = sum y_k^2 / d_k`.
    /// Negligible contributions of negative pivots relative to `sum f_k^2 / |K_kk|` are accepted.
    pub(crate) fn is_positive_for(&self, f: &[f64]) -> bool {
        let energy = |f: f64, k: f64| if f == 0.0 { 0.0 } else { f * f / k.abs() };
        let energies = f.iter().zip(&self.diagonal).map(|(&f, &k)| energy(f, k));
        let limit = UNSEEN * energies.sum::<f64>();
        let mut y = f.to_vec();
        for column in 0..y.len() {
            let (pivot, own) = (self.pivot(column), y[column]);
            if !(pivot > 0.0 || energy(own, pivot) <= limit && limit.is_finite()) {
                return false;
            }
            for (row, value) in self.below(column) {
                y[row] -= value * own;
            }
        }
        true
    }

    pub(crate) fn largest_diagonal(&self) -> f64 {
        self.diagonal.iter().copied().fold(0.0, f64::max)
    }

    /// Largest diagonal entry of `|L| |D| |L^T|`.
    pub(crate) fn growth(&self) -> f64 {
        let mut growth = vec![0.0; self.symbolic.nrows()];
        for column in 0..growth.len() {
            let pivot = self.pivot(column).abs();
            growth[column] += pivot;
            for (row, value) in self.below(column) {
                growth[row] += value * value * pivot;
            }
        }
        growth.into_iter().fold(0.0, f64::max)
    }

    fn below(&self, column: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let range = self.symbolic.col_ptr()[column] + 1..self.symbolic.col_ptr()[column + 1];
        let rows = &self.symbolic.row_idx()[range.clone()];
        rows.iter().copied().zip(self.values[range].iter().copied())
    }

    /// Upper bound of the smallest eigenvalue in the metric, if a pivot is negative.
    ///
    /// With `L^T z = e_k`, `z . K z = d_k`, so the smallest eigenvalue is at most `d_k / z . M z`;
    /// `k` is the most negative pivot.
    pub(crate) fn negative_curvature(&self, metric: &[f64]) -> Option<f64> {
        let n = self.symbolic.nrows();
        let last = (0..n).min_by(|&a, &b| self.pivot(a).total_cmp(&self.pivot(b)))?;
        if self.pivot(last) >= 0.0 {
            return None;
        }
        let mut z = vec![0.0; n];
        z[last] = 1.0;
        for column in (0..last).rev() {
            z[column] = -self
                .below(column)
                .map(|(row, value)| value * z[row])
                .sum::<f64>();
        }
        let norm: f64 = z.iter().zip(metric).map(|(z, m)| m * z * z).sum();
        Some(self.pivot(last) / norm)
    }
}

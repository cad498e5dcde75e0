//! Lowest eigenvalue of the stiffness by Lanczos iteration on the inverse of `K + shift M` with the
//! smallest positive definite shift.
//!
//! # Source
//! B. N. Parlett, The Symmetric Eigenvalue Problem (1980), chapter 13 (full reorthogonalisation).

use crate::direction::{Solver, dot};
use crate::outcome::SolveError;
use actin_mechanics::Xorshift;
use nalgebra::{DMatrix, SymmetricEigen};

/// Relative residual of the eigenvalue.
const ACCURACY: f64 = 1e-9;
const VECTORS: usize = 80;
/// New vectors between solutions of the small problem.
const PERIOD: usize = 5;

/// Mode of the smallest eigenvalue of `K v = lambda M v`. The metric `M` is 1 for displacements
/// (nm) and the squared turn length for rotations (rad).
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// Eigenvalue (pN/nm).
    pub eigenvalue: f64,
    /// Error bound (pN/nm) of iteration and factorisation.
    pub error: f64,
    /// Mode shape, one number per unknown with `v . M v = 1`, for
    /// [`Layout::apply`](crate::Layout::apply).
    pub shape: Vec<f64>,
}

pub(crate) fn lowest(solver: &mut Solver) -> Result<Option<Mode>, SolveError> {
    let n = solver.layout.unknowns();
    if n == 0 {
        return Ok(None);
    }
    let inertia = solver.factorize(0.0);
    let shift = solver.make_positive(inertia)?;
    let root: Vec<f64> = solver.metric.iter().map(|m| m.sqrt()).collect();
    let mut lanczos = Lanczos::new(n);
    let ritz = loop {
        let mut w: Vec<f64> = lanczos
            .last()
            .iter()
            .zip(&root)
            .map(|(y, r)| y * r)
            .collect();
        solver.solve(&mut w);
        w.iter_mut().zip(&root).for_each(|(w, r)| *w *= r);
        let exhausted = lanczos.push(w);
        let size = lanczos.alpha.len();
        if exhausted || size == VECTORS.min(n) || size.is_multiple_of(PERIOD) {
            let ritz = lanczos.largest();
            if exhausted || size == VECTORS.min(n) || ritz.residual <= ACCURACY * ritz.value {
                break ritz;
            }
        }
    };
    let shifted = 1.0 / ritz.value;
    let rounding = f64::EPSILON * solver.largest_diagonal() / solver.lightest();
    Ok(Some(Mode {
        eigenvalue: shifted - shift,
        error: shifted * ritz.residual / ritz.value + rounding,
        shape: ritz.vector.iter().zip(&root).map(|(y, r)| y / r).collect(),
    }))
}

struct Lanczos {
    basis: Vec<Vec<f64>>,
    alpha: Vec<f64>,
    beta: Vec<f64>,
}

struct Ritz {
    value: f64,
    residual: f64,
    vector: Vec<f64>,
}

impl Lanczos {
    fn new(n: usize) -> Self {
        let mut noise = Xorshift::new(1);
        let start: Vec<f64> = (0..n).map(|_| noise.sample()).collect();
        let norm = dot(&start, &start).sqrt();
        Self {
            basis: vec![start.into_iter().map(|s| s / norm).collect()],
            alpha: Vec::new(),
            beta: Vec::new(),
        }
    }

    fn last(&self) -> &[f64] {
        &self.basis[self.basis.len() - 1]
    }

    /// Returns `true` if the space is exhausted.
    fn push(&mut self, mut w: Vec<f64>) -> bool {
        let before = dot(&w, &w).sqrt();
        self.alpha.push(dot(self.last(), &w));
        // Two orthogonalisations suffice.
        for _ in 0..2 {
            for v in &self.basis {
                let along = dot(v, &w);
                w.iter_mut().zip(v).for_each(|(w, v)| *w -= along * v);
            }
        }
        let norm = dot(&w, &w).sqrt();
        self.beta.push(norm);
        if norm <= f64::EPSILON * before {
            return true;
        }
        self.basis.push(w.into_iter().map(|w| w / norm).collect());
        false
    }

    fn largest(&self) -> Ritz {
        let size = self.alpha.len();
        let matrix = DMatrix::from_fn(size, size, |i, j| match i.abs_diff(j) {
            0 => self.alpha[i],
            1 => self.beta[i.min(j)],
            _ => 0.0,
        });
        let eigen = SymmetricEigen::new(matrix);
        let at = eigen.eigenvalues.imax();
        let weights = eigen.eigenvectors.column(at);
        let mut vector = vec![0.0; self.basis[0].len()];
        for (v, &weight) in self.basis.iter().zip(weights.iter()) {
            vector.iter_mut().zip(v).for_each(|(x, v)| *x += weight * v);
        }
        Ritz {
            value: eigen.eigenvalues[at],
            residual: (self.beta[size - 1] * weights[size - 1]).abs(),
            vector,
        }
    }
}

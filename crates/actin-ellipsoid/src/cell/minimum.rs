//! Damped Newton method for the energy minimum of a cell.

use super::pairs::Derivatives;
use super::{Cell, CellError, Displacements, STRAINS, SixVector};
use nalgebra::linalg::{Cholesky, SymmetricEigen};
use nalgebra::{DMatrix, DVector, Dyn};

/// Largest residual force (pN) or torque (pN nm) on a monomer: a hundred times the rounding error.
const ALLOWED: f64 = 1e-9;
const MOST_STEPS: usize = 400;
/// Largest displacement (nm) or rotation (rad) of a step.
const LONGEST: f64 = 0.2;
/// Sufficient decrease parameter of the line search (Armijo).
const ARMIJO: f64 = 1e-4;
/// Relative energy change below which rounding dominates.
const ROUNDING: f64 = 1e-12;
/// Stiffness (pN/nm) in the held directions, without effect on the minimum.
const HOLDING: f64 = 1e3;
/// Stiffness (pN/nm) below which a mode counts as zero-stiffness mode.
const MARGINAL: f64 = 1e-6;
/// Displacement (nm, rad) away from a saddle along its most unstable mode.
const KICK: f64 = 0.02;

#[derive(Clone, Debug)]
pub(super) struct CellState {
    pub(super) coordinates: Displacements,
    pub(super) strain: SixVector,
}

#[derive(Debug)]
pub(super) struct Problem<'a> {
    pub(super) cell: &'a Cell,
    pub(super) free: Vec<usize>,
    pub(super) loads: SixVector,
}

#[derive(Debug)]
pub(super) struct Minimum {
    pub(super) state: CellState,
    pub(super) derivatives: Derivatives,
    pub(super) iterations: usize,
}

impl Problem<'_> {
    fn size(&self) -> usize {
        self.cell.coordinates() + self.free.len()
    }

    fn place(&self, k: usize) -> usize {
        let coordinates = self.cell.coordinates();
        k.checked_sub(coordinates)
            .map_or(k, |k| coordinates + self.free[k])
    }

    fn work(&self, strain: &SixVector) -> f64 {
        let work = |&k: &usize| self.loads[k] * strain[k];
        self.free.iter().map(work).sum::<f64>() * self.cell.length()
    }

    fn energy(&self, state: &CellState) -> f64 {
        self.cell.energy(&state.coordinates, &state.strain) - self.work(&state.strain)
    }

    /// Gradient and Hessian in the admissible directions. Springs in the held directions make the
    /// Hessian regular.
    fn reduce(&self, all: &Derivatives) -> (DVector<f64>, DMatrix<f64>) {
        let (size, coordinates) = (self.size(), self.cell.coordinates());
        let mut gradient = DVector::from_fn(size, |k, _| all.gradient[self.place(k)]);
        for (k, &strain) in self.free.iter().enumerate() {
            gradient[coordinates + k] -= self.cell.length() * self.loads[strain];
        }
        let hessian = DMatrix::from_fn(size, size, |i, j| {
            all.hessian[(self.place(i), self.place(j))]
        });
        self.cell.project_vector(&mut gradient);
        (gradient, self.cell.project(hessian))
    }

    fn moved(&self, from: &CellState, step: &DVector<f64>, share: f64) -> CellState {
        let coordinates = self.cell.coordinates();
        let mut state = from.clone();
        state.coordinates += step.rows(0, coordinates) * share;
        for (k, &strain) in self.free.iter().enumerate() {
            state.strain[strain] += share * step[coordinates + k];
        }
        state
    }

    pub(super) fn minimise(&self, start: CellState) -> Result<Minimum, CellError> {
        let mut state = start;
        let mut residual = f64::INFINITY;
        for iterations in 0..MOST_STEPS {
            let derivatives = self.cell.derivatives(&state.coordinates, &state.strain);
            let (gradient, hessian) = self.reduce(&derivatives);
            residual = gradient.amax();
            let step = if residual > ALLOWED {
                newton_step(&gradient, &hessian)
            } else if let Some(mode) = unstable_mode(hessian) {
                self.kick(&state, &mode)
            } else {
                return Ok(Minimum {
                    state,
                    derivatives,
                    iterations,
                });
            };
            let energy = derivatives.energy - self.work(&state.strain);
            let slope = gradient.dot(&step);
            state = self.search(&state, &step, energy, slope);
        }
        Err(CellError::NoMinimum {
            strain: state.strain.into(),
            residual,
            allowed: ALLOWED,
            iterations: MOST_STEPS,
        })
    }

    /// Backtracking line search. Changes below rounding are accepted.
    fn search(&self, from: &CellState, step: &DVector<f64>, energy: f64, slope: f64) -> CellState {
        let mut share = 1.0;
        loop {
            let state = self.moved(from, step, share);
            let gain = share * slope;
            let lost = ROUNDING * (1.0 + energy.abs());
            if gain.abs() < lost || self.energy(&state) <= energy + ARMIJO * gain {
                return state;
            }
            share *= 0.5;
        }
    }

    fn kick(&self, state: &CellState, mode: &DVector<f64>) -> DVector<f64> {
        let step = mode * (KICK / mode.amax());
        let side = |sign: f64| self.energy(&self.moved(state, &step, sign));
        if side(1.0) <= side(-1.0) { step } else { -step }
    }
}

/// Shifts the Hessian if it is not positive definite.
fn newton_step(gradient: &DVector<f64>, hessian: &DMatrix<f64>) -> DVector<f64> {
    let mut damping = 0.0;
    let factor = loop {
        if let Some(factor) = factor(hessian, damping) {
            break factor;
        }
        damping = f64::max(4.0 * damping, 1e-3);
    };
    let step = -factor.solve(gradient);
    let longest = step.amax();
    step * (LONGEST / longest).min(1.0)
}

/// Cholesky factor of the Hessian plus `damping`; `None` if not positive definite to rounding.
fn factor(hessian: &DMatrix<f64>, damping: f64) -> Option<Cholesky<f64, Dyn>> {
    let mut damped = hessian.clone();
    for k in 0..damped.nrows() {
        damped[(k, k)] += damping;
    }
    let factor = Cholesky::new(damped)?;
    let least = factor.l_dirty().diagonal().min();
    (least * least > 1e-3 * MARGINAL).then_some(factor)
}

fn unstable_mode(hessian: DMatrix<f64>) -> Option<DVector<f64>> {
    if factor(&hessian, MARGINAL).is_some() {
        return None;
    }
    let eigen = SymmetricEigen::new(hessian);
    let (place, lowest) = eigen.eigenvalues.argmin();
    (lowest < -MARGINAL).then(|| eigen.eigenvectors.column(place).into_owned())
}

impl Cell {
    pub(super) fn project_vector(&self, vector: &mut DVector<f64>) {
        let mut rows = vector.rows_mut(0, self.coordinates());
        let along = &self.held * &rows;
        rows -= self.held.tr_mul(&along);
    }

    /// `P K P + c A^T A` with the held rows `A` and `P = 1 - A^T A` (coordinates first).
    pub(super) fn project(&self, mut matrix: DMatrix<f64>) -> DMatrix<f64> {
        let coordinates = self.coordinates();
        let rows = &self.held * matrix.rows(0, coordinates);
        let corner = rows.columns(0, coordinates) * self.held.transpose();
        let mut held = DMatrix::zeros(self.held.nrows(), matrix.ncols());
        held.columns_mut(0, coordinates).copy_from(&self.held);
        let inner = corner + DMatrix::identity(6, 6) * HOLDING;
        let half = inner * &held * 0.5 - rows;
        let product = held.tr_mul(&half);
        matrix += &product;
        matrix += product.transpose();
        matrix
    }

    /// Schur complement: Hessian of the relaxed energy with respect to the strains.
    pub(super) fn condense(&self, all: &Derivatives) -> DMatrix<f64> {
        let coordinates = self.coordinates();
        let hessian = all
            .hessian
            .view((0, 0), (coordinates, coordinates))
            .into_owned();
        let hessian = self.project(hessian);
        let mixed = all.hessian.view((0, coordinates), (coordinates, STRAINS));
        let mixed = mixed - self.held.tr_mul(&(&self.held * mixed));
        let mut damping = 0.0;
        let factor = loop {
            if let Some(factor) = factor(&hessian, damping) {
                break factor;
            }
            damping = f64::max(4.0 * damping, MARGINAL);
        };
        let corner = all
            .hessian
            .view((coordinates, coordinates), (STRAINS, STRAINS));
        corner - mixed.tr_mul(&factor.solve(&mixed))
    }
}

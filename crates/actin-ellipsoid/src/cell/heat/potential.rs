//! Potential of the sampled distribution.

use super::super::jets::log_density;
use super::super::pairs::Derivatives;
use super::super::{Cell, STRAINS, SixVector};
use actin_mechanics::Matrix3;
use nalgebra::{DMatrix, DVector};

/// Energy minus work of the given loads, plus the measure of rotations.
#[derive(Debug)]
pub(super) struct Potential<'a> {
    pub(super) cell: &'a Cell,
    pub(super) kt: f64,
    pub(super) free: Vec<usize>,
    /// Loads of the free strains; others are ignored.
    pub(super) loads: SixVector,
}

impl Potential<'_> {
    pub(super) fn size(&self) -> usize {
        self.cell.coordinates() + STRAINS
    }

    /// Value (pN nm) at `place` (coordinates, then strains). Writes the derivatives to `gradient`.
    pub(super) fn slopes(&self, place: &DVector<f64>, gradient: &mut DVector<f64>) -> f64 {
        let mut energy = self.cell.slopes(place, gradient);
        for (row, turn) in self.cell.turns(place) {
            let [value, slope, _] = log_density(turn.norm_squared());
            energy -= self.kt * value;
            let mut rows = gradient.fixed_rows_mut::<3>(row);
            rows -= turn * (2.0 * slope * self.kt);
        }
        for &k in &self.free {
            let (row, force) = (self.cell.coordinates() + k, self.work_per_strain(k));
            energy -= force * place[row];
            gradient[row] -= force;
        }
        energy
    }

    pub(super) fn derivatives(&self, place: &DVector<f64>) -> Derivatives {
        let coordinates = self.cell.coordinates();
        let strain: SixVector = place.fixed_rows::<STRAINS>(coordinates).into();
        let displacements = place.rows(0, coordinates).into_owned();
        let mut all = self.cell.derivatives(&displacements, &strain);
        for (row, turn) in self.cell.turns(place) {
            let [_, slope, second] = log_density(turn.norm_squared());
            let outer = turn * turn.transpose();
            let of_turn = Matrix3::identity() * (2.0 * slope) + outer * (4.0 * second);
            let mut block = all.hessian.fixed_view_mut::<3, 3>(row, row);
            block -= of_turn * self.kt;
        }
        all
    }

    /// Orthonormal basis of unconstrained motion.
    pub(super) fn directions(&self) -> DMatrix<f64> {
        let (coordinates, held) = (self.cell.coordinates(), &self.cell.held);
        let moving = coordinates - held.nrows();
        let mut basis = DMatrix::zeros(self.size(), moving + self.free.len());
        let projector = DMatrix::identity(coordinates, coordinates) - held.tr_mul(held);
        let eigen = projector.symmetric_eigen();
        let columns = (0..coordinates).filter(|&k| eigen.eigenvalues[k] > 0.5);
        for (column, k) in columns.enumerate() {
            let mut rows = basis.view_mut((0, column), (coordinates, 1));
            rows.copy_from(&eigen.eigenvectors.column(k));
        }
        for (column, &k) in (moving..).zip(&self.free) {
            basis[(coordinates + k, column)] = 1.0;
        }
        basis
    }

    fn work_per_strain(&self, k: usize) -> f64 {
        self.cell.length() * self.loads[k]
    }
}

use crate::error::FitError;
use faer::linalg::solvers::{Qr, SolveLstsq, Svd};
use faer::{Mat, MatRef};

/// Largest component of a determined parameter in the null space. Singular vectors are accurate to
/// about 1e-16 over the tolerance of the rank, at worst 1e-4 of this value.
const PARTICIPATION: f64 = 1e-6;

/// `A = Q R D` with unit columns in `Q R`, and the singular values of `R`.
#[derive(Debug)]
pub(crate) struct Factor {
    qr: Qr<f64>,
    /// Column norms, the diagonal of `D`; 1 for zero columns.
    lengths: Vec<f64>,
    singular: Vec<f64>,
    right: Mat<f64>,
    rank: usize,
}

impl Factor {
    /// Factors a matrix with at least as many rows as columns.
    ///
    /// Singular values below `tolerance` times the largest count as zero. A column counts as zero
    /// if its norm times unit is below `tolerance` times the largest such product. Its effect is
    /// then rounding for any scaling.
    ///
    /// # Errors
    /// If the singular value decomposition fails.
    pub(crate) fn new(
        matrix: MatRef<'_, f64>,
        units: &[f64],
        tolerance: f64,
    ) -> Result<Self, FitError> {
        let lengths = column_lengths(matrix, units, tolerance);
        let scaled = Mat::from_fn(matrix.nrows(), matrix.ncols(), |i, j| {
            lengths[j].map_or(0.0, |length| matrix[(i, j)] / length)
        });
        let qr = Qr::new(scaled.as_ref());
        let (singular, right) = singular(qr.thin_R())?;
        let least = tolerance * singular.first().copied().unwrap_or(0.0);
        let rank = singular.iter().take_while(|s| **s > least).count();
        Ok(Self {
            qr,
            lengths: lengths.iter().map(|l| l.unwrap_or(1.0)).collect(),
            singular,
            right,
            rank,
        })
    }

    pub(crate) fn rank(&self) -> usize {
        self.rank
    }

    pub(crate) fn condition(&self) -> f64 {
        match (self.singular.first(), self.singular.last()) {
            (Some(largest), Some(smallest)) => largest / smallest,
            _ => 1.0,
        }
    }

    /// Least-squares solution of `A z = right`; requires full rank.
    pub(crate) fn solve(&self, right: &[f64]) -> Vec<f64> {
        let right = Mat::from_fn(right.len(), 1, |i, _| right[i]);
        let scaled = self.qr.solve_lstsq(&right);
        (0..self.lengths.len())
            .map(|j| scaled[(j, 0)] / self.lengths[j])
            .collect()
    }

    pub(crate) fn determined(&self) -> Vec<bool> {
        let n = self.lengths.len();
        (0..n)
            .map(|j| {
                let part: f64 = (self.rank..n).map(|k| self.right[(j, k)].powi(2)).sum();
                part.sqrt() <= PARTICIPATION
            })
            .collect()
    }

    /// `(A^T A)^-1` of the determined columns; zero in the other rows and columns.
    pub(crate) fn inverse_normal(&self) -> Mat<f64> {
        let n = self.lengths.len();
        let determined = self.determined();
        Mat::from_fn(n, n, |i, j| {
            if !(determined[i] && determined[j]) {
                return 0.0;
            }
            let sum: f64 = (0..self.rank)
                .map(|k| {
                    self.right[(i, k)] / self.singular[k] * self.right[(j, k)] / self.singular[k]
                })
                .sum();
            sum / self.lengths[i] / self.lengths[j]
        })
    }
}

fn column_lengths(matrix: MatRef<'_, f64>, units: &[f64], tolerance: f64) -> Vec<Option<f64>> {
    let lengths: Vec<f64> = (0..matrix.ncols())
        .map(|j| matrix.col(j).norm_l2())
        .collect();
    // Logarithms avoid overflow for wide bounds.
    let pairs = lengths.iter().zip(units);
    let effects: Vec<f64> = pairs.map(|(l, u)| l.ln() + u.ln()).collect();
    let largest = effects.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let least = largest + tolerance.ln();
    let pairs = lengths.iter().zip(&effects);
    pairs
        .map(|(&length, &effect)| (effect > least).then_some(length))
        .collect()
}

fn singular(triangle: MatRef<'_, f64>) -> Result<(Vec<f64>, Mat<f64>), FitError> {
    let (rows, columns) = triangle.shape();
    if columns == 0 {
        return Ok((Vec::new(), Mat::zeros(0, 0)));
    }
    let svd = Svd::new(triangle).map_err(|_| FitError::NoSingularValues { rows, columns })?;
    let values = svd.S().column_vector().iter().copied().collect();
    Ok((values, svd.V().to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_column_of_rounding_counts_as_zero() {
        let matrix = Mat::from_fn(
            3,
            2,
            |i, j| {
                if j == 0 { 1.0 } else { [1e-16, -1e-16, 0.0][i] }
            },
        );
        let small = Factor::new(matrix.as_ref(), &[1.0, 1.0], 1e-12).unwrap();
        assert_eq!((small.rank(), small.determined()), (1, vec![true, false]));
        let large = Factor::new(matrix.as_ref(), &[1.0, 1e16], 1e-12).unwrap();
        assert_eq!((large.rank(), large.determined()), (2, vec![true, true]));
    }
}

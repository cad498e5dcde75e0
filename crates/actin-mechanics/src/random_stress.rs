//! Random stress of elements, which maintains thermal strain in time steps longer than the
//! relaxation time of strains.

use crate::{Loads, SecondOrder, State, Stiffness};
use nalgebra::{DMatrix, DVector, SMatrix};
use std::ops::Range;

/// Elements with strains `e(x)` under a random stress `s`, which adds the energy `-s . e(x)`.
///
/// Stresses have the covariance `kT C`, where `C` is the matrix of second derivatives of the energy
/// with respect to strains. They shift rest strains by the thermal fluctuation. The slice of
/// [`components`](RandomStress::components) numbers contains the stresses of all elements.
pub trait RandomStress: SecondOrder {
    /// Total number of stress components of all elements.
    fn components(&self) -> usize;

    /// Transforms independent deviates of mean 0 and variance 1 into stresses with the covariance
    /// `thermal_energy` times the strain stiffness at `state`. Negative stiffness counts as zero.
    fn draw(&self, state: &State, thermal_energy: f64, stresses: &mut [f64]);

    /// Changes random stresses to stresses that cancel the elements' own stresses at `state`. The sum
    /// exerts no loads and has the second derivatives of linear strains.
    fn balance(&self, state: &State, stresses: &mut [f64]);

    /// Adds the loads of the stresses, `s . de/dx`.
    ///
    /// Axial torques on slender bodies may be omitted where the elements exert none, because only
    /// friction would resist them.
    fn add_stress_loads(&self, state: &State, stresses: &[f64], loads: &mut Loads);

    /// Frames that are isotropic about their third axes: rotations about these axes change neither
    /// energies nor, after [`turn_back`](Self::turn_back), stresses. The default is an empty range.
    fn axial_frames(&self) -> Range<usize> {
        0..0
    }

    /// Transforms stresses into the axes of frames that have rotated about their third axes by
    /// `spins` (rad, one per frame) since the draw. The default copies the stresses.
    fn turn_back(&self, _spins: &[f64], drawn: &[f64], turned: &mut [f64]) {
        turned.copy_from_slice(drawn);
    }

    /// Records the stresses of a completed step in the controls of `state`. The default does nothing.
    fn record(&self, _stresses: &[f64], _state: &mut State) {}

    /// Adds the second derivatives of the energy of the elements and of the energy `-s . e(x)`, in
    /// the same blocks for every stress.
    fn add_stressed_stiffness(
        &self,
        state: &State,
        stress: &StepStress<'_>,
        stiffness: &mut Stiffness,
    );
}

/// Stresses of an interaction in the matrix of a time step.
#[derive(Clone, Copy, Debug)]
pub struct StepStress<'a> {
    /// One number per component.
    pub values: &'a [f64],
    /// `true` for stresses after [`turn_back`](RandomStress::turn_back), which do not act on axial
    /// rotations: blocks couple these rotations with each other only, by the stiffness of the
    /// elements.
    pub is_turned: bool,
    /// `true` for stresses that [`balance`](RandomStress::balance) the elements. The negative part
    /// of the strain stiffness is then omitted, so that the sum is positive semidefinite.
    pub is_balanced: bool,
}

/// Transforms independent deviates of mean 0 and variance 1 into deviates whose covariance is `c`
/// (symmetric). Negative eigenvalues count as zero.
///
/// A positive definite matrix is factorised by Cholesky's method. For an indefinite one, pivots
/// close to zero would give unbounded factors; the square root of its positive part is used
/// instead.
///
/// ```
/// use actin_mechanics::correlate;
/// let mut deviates = [1.0, 1.0];
/// correlate(nalgebra::Matrix2::new(4.0, 2.0, 2.0, 10.0), &mut deviates);
/// assert_eq!(deviates, [2.0, 4.0]);
/// // Positive part: 1/2 in each entry.
/// correlate(nalgebra::Matrix2::new(0.0, 1.0, 1.0, 0.0), &mut deviates);
/// assert!((deviates[0] - deviates[1]).abs() < 1e-15 && deviates[0].abs() < 5.0);
/// ```
pub fn correlate<const N: usize>(c: SMatrix<f64, N, N>, deviates: &mut [f64; N]) {
    *deviates = lower_factor_times(c, deviates).unwrap_or_else(|| {
        let eigen = DMatrix::from_fn(N, N, |i, j| c[(i, j)]).symmetric_eigen();
        let roots = eigen.eigenvalues.map(|value| value.max(0.0).sqrt());
        let own = DVector::from_column_slice(deviates).component_mul(&roots);
        let sums = eigen.eigenvectors * own;
        std::array::from_fn(|i| sums[i])
    });
}

/// Product of the Cholesky factor and the deviates; `None` if a pivot is not positive.
fn lower_factor_times<const N: usize>(
    mut c: SMatrix<f64, N, N>,
    deviates: &[f64; N],
) -> Option<[f64; N]> {
    let mut sums = [0.0; N];
    for k in 0..N {
        let pivot = c[(k, k)];
        if pivot <= 0.0 {
            return None;
        }
        let factors: [f64; N] = std::array::from_fn(|i| c[(i, k)] / pivot.sqrt());
        for i in k..N {
            sums[i] += factors[i] * deviates[k];
            for j in k + 1..=i {
                c[(i, j)] -= factors[i] * factors[j];
            }
        }
    }
    Some(sums)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Matrix3, Vector3};

    /// A compressed spring: stiff along its axis, slightly negative across. Close to the
    /// direction where the first pivot vanishes, plain factors would be unbounded.
    #[test]
    fn indefinite_matrices_have_bounded_deviates() {
        for angle in 0..2000 {
            let (sine, cosine) = (f64::from(angle) * 1e-3).sin_cos();
            let n = Vector3::new(sine, 0.6 * cosine, 0.8 * cosine);
            let along = n * n.transpose();
            let c = along - (Matrix3::identity() - along) * 0.01;
            let mut deviates = [1.0, -2.0, 1.5];
            let size = Vector3::from(deviates).norm();
            correlate(c, &mut deviates);
            let found = Vector3::from(deviates);
            assert!(
                found.cross(&n).norm() < 1e-12 && found.norm() <= size,
                "{found}"
            );
        }
    }
}

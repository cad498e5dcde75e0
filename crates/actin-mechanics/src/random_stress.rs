//! Random stress of elements, which maintains thermal strain in time steps longer than the
//! relaxation time of strains.

use crate::{Loads, State, Stiffness};
use nalgebra::SMatrix;
use std::ops::Range;

/// Elements with strains `e(x)` under a random stress `s`, which adds the energy `-s . e(x)`.
///
/// Stresses have the covariance `kT C`, where `C` is the matrix of second derivatives of the energy
/// with respect to strains. They shift rest strains by the thermal fluctuation. The slice of
/// [`components`](RandomStress::components) numbers contains the stresses of all elements.
pub trait RandomStress {
    /// Total number of stress components of all elements.
    fn components(&self) -> usize;

    /// Transforms independent deviates of mean 0 and variance 1 into stresses with the covariance
    /// `thermal_energy` times the strain stiffness at `state`. Negative stiffness counts as zero.
    fn draw(&self, state: &State, thermal_energy: f64, stresses: &mut [f64]);

    /// Writes the stresses that cancel the elements' own stresses at `state`. The sum exerts no
    /// loads and has the second derivatives of linear strains.
    fn balance(&self, state: &State, stresses: &mut [f64]);

    /// Adds the loads of the stresses, `s . de/dx`.
    ///
    /// Axial torques on slender bodies may be omitted where the elements exert none, because only
    /// friction would resist them.
    fn add_stress_loads(&self, state: &State, stresses: &[f64], loads: &mut Loads);

    /// Adds the negative part of the strain stiffness with opposite sign if `is_wanted`, otherwise
    /// zeros in the same blocks. The default adds no blocks.
    fn add_convexity(&self, _state: &State, _is_wanted: bool, _stiffness: &mut Stiffness) {}

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

    /// Adds the second derivatives of the energy `-s . e(x)`.
    fn add_stress_stiffness(&self, state: &State, stresses: &[f64], stiffness: &mut Stiffness);

    /// Adds the derivatives of the loads of stresses after [`turn_back`](Self::turn_back), in the
    /// same blocks. The default adds the second derivatives.
    fn add_turned_stiffness(&self, state: &State, stresses: &[f64], stiffness: &mut Stiffness) {
        self.add_stress_stiffness(state, stresses, stiffness);
    }
}

/// Transforms independent deviates of mean 0 and variance 1 into deviates of covariance `c`
/// (symmetric), by Cholesky factorisation. Directions with a pivot that is not positive are
/// skipped.
///
/// ```
/// use actin_mechanics::correlate;
/// let mut deviates = [1.0, 1.0];
/// correlate(nalgebra::Matrix2::new(4.0, 2.0, 2.0, 10.0), &mut deviates);
/// assert_eq!(deviates, [2.0, 4.0]);
/// ```
pub fn correlate<const N: usize>(mut c: SMatrix<f64, N, N>, deviates: &mut [f64; N]) {
    let mut sums = [0.0; N];
    for k in 0..N {
        let pivot = c[(k, k)];
        if pivot <= 0.0 {
            continue;
        }
        let factors: [f64; N] = std::array::from_fn(|i| c[(i, k)] / pivot.sqrt());
        for i in k..N {
            sums[i] += factors[i] * deviates[k];
            for j in k + 1..=i {
                c[(i, j)] -= factors[i] * factors[j];
            }
        }
    }
    *deviates = sums;
}

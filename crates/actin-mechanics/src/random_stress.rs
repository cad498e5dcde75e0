//! Random stress of the elements of an interaction: what keeps strains in thermal motion in time steps
//! that are longer than strains remember.

use crate::{Loads, State, Stiffness};
use nalgebra::SMatrix;
use std::ops::Range;

/// Elements whose energy depends on strains `e(x)`, under a random stress that adds the energy `-s . e(x)`.
///
/// Drawn with the covariance `kT C`, `C` the second derivatives of the energy with respect to strains, a stress
/// shifts its element's strain at rest by as much as thermal motion does.
///
/// Stresses of all elements stand one after the other in one slice of
/// [`components`](RandomStress::components) numbers; their units are those of the elements.
pub trait RandomStress {
    /// Number of components of all elements together.
    fn components(&self) -> usize;

    /// Turns independent deviates of mean 0 and variance 1 into stresses of the covariance
    /// `thermal_energy` times the stiffness of the strains at `state`. Directions of negative stiffness have none.
    fn draw(&self, state: &State, thermal_energy: f64, stresses: &mut [f64]);

    /// Writes the stresses that balance the elements' own at `state`: both together act on nothing, and have
    /// no second derivatives but those that strains have where they are linear.
    fn balance(&self, state: &State, stresses: &mut [f64]);

    /// Adds the loads of these stresses, `s . de/dx`. Torques of these about the axes of slender bodies may be left out where
    /// the elements themselves exert none: hardly anything resists such a turn, and bodies would turn to meet the stress.
    fn add_stress_loads(&self, state: &State, stresses: &[f64], loads: &mut Loads);

    /// Adds the negative part of the stiffness of strains with the opposite sign if `is_wanted`, otherwise zeros in the same
    /// blocks. Compressed springs have negative stiffness across. The default adds no blocks.
    fn add_convexity(&self, _state: &State, _is_wanted: bool, _stiffness: &mut Stiffness) {}

    /// Returns the frames of slender bodies that are isotropic about their third axes: turns about these axes change neither
    /// energies nor, after [`turn_back`](Self::turn_back), stresses. The default is an empty range. Other elements of the
    /// system may still resist such turns.
    fn axial_frames(&self) -> Range<usize> {
        0..0
    }

    /// Writes stresses in the axes of frames that have turned about their third axes by `spins` (rad, one for each frame)
    /// since the stresses were drawn: their directions in the lab do not change. The default copies them.
    fn turn_back(&self, _spins: &[f64], drawn: &[f64], turned: &mut [f64]) {
        turned.copy_from_slice(drawn);
    }

    /// Adds the second derivatives of the energy `-s . e(x)`.
    fn add_stress_stiffness(&self, state: &State, stresses: &[f64], stiffness: &mut Stiffness);

    /// Adds the derivatives of the loads of stresses that are turned back, in the same blocks: axial frames turn about their third
    /// axes without effect. By default the second derivatives.
    fn add_turned_stiffness(&self, state: &State, stresses: &[f64], stiffness: &mut Stiffness) {
        self.add_stress_stiffness(state, stresses, stiffness);
    }
}

/// Turns `N` independent deviates of mean 0 and variance 1 into some of covariance `c` (symmetric), by its Cholesky
/// factor. A direction of negative variance, up to those before it, has none.
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

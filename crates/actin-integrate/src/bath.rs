//! A heat bath: drag and the noise that belongs to it. The noise itself is in `noise`.

use crate::Drag;
use thiserror::Error;

/// Drag with the thermal noise that keeps every degree of freedom at the energy `kT/2`.
///
/// Velocities and body angular momenta follow Ornstein-Uhlenbeck processes, solved exactly: over a
/// time `t`, for each component of a free point of mass `m` and about each body axis `a` of a free
/// frame with moment `I_a`,
///
/// - `v   <- exp(-gamma_t t) v   + sqrt(kT/m (1 - exp(-2 gamma_t t))) xi`,
/// - `l_a <- exp(-gamma_r t) l_a + sqrt(kT I_a (1 - exp(-2 gamma_r t))) xi`,
///
/// with independent standard normal `xi`. At every `t` this leaves the Maxwell distribution as it
/// is; like drag, it is applied for half a step before and half a step after each conservative
/// step. Held and driven bodies take no part; a body that slides does along its free directions,
/// with its whole mass.
///
/// The noise is a function of the seed, the number of the step, the half, and the index of the body
/// among its kind; nothing is carried on from step to step. So runs can be broken off and
/// continued, and what a body meets does not depend on what follows it in the state, on threads, or
/// on when the state is looked at.
///
/// ```
/// use actin_integrate::{Bath, Drag};
/// let bath = Bath::new(Drag::new(0.5, 0.0).unwrap(), 4.0, 1).unwrap();
/// // Root of kT (1 - exp(-1)) for velocities; angular momenta without drag meet no noise.
/// let (translational, rotational) = bath.spreads(1.0);
/// assert!((translational - (4.0 * (1.0 - (-1.0f64).exp())).sqrt()).abs() < 1e-15);
/// assert_eq!(rotational, 0.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bath {
    drag: Drag,
    thermal_energy: f64,
    seed: u64,
}

impl Bath {
    /// A bath of the thermal energy `kT` (pN nm), with the rates of `drag`.
    ///
    /// # Errors
    /// A thermal energy that is negative or not finite.
    pub fn new(drag: Drag, thermal_energy: f64, seed: u64) -> Result<Self, BathError> {
        if !(thermal_energy.is_finite() && thermal_energy >= 0.0) {
            return Err(BathError(thermal_energy));
        }
        Ok(Self {
            drag,
            thermal_energy,
            seed,
        })
    }

    /// The drag.
    pub fn drag(&self) -> &Drag {
        &self.drag
    }

    /// The thermal energy `kT` (pN nm).
    pub fn thermal_energy(&self) -> f64 {
        self.thermal_energy
    }

    /// The seed of the noise.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// Standard deviations that the noise builds up in a time `t` (ns), in translation and in
    /// rotation: `sqrt(kT (1 - exp(-2 gamma t)))`, to be scaled with the inertia.
    ///
    /// None going back in time, where drag speeds up.
    pub fn spreads(&self, t: f64) -> (f64, f64) {
        let spread = |rate: f64| {
            let share = -(-2.0 * rate * t).exp_m1();
            (self.thermal_energy * share.max(0.0)).sqrt()
        };
        (
            spread(self.drag.translational()),
            spread(self.drag.rotational()),
        )
    }
}

/// A thermal energy (pN nm) that was refused.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("the thermal energy must be finite and not negative, got {0} pN nm")]
pub struct BathError(pub f64);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn energies_that_are_negative_or_not_finite_are_refused() {
        for bad in [-1e-300, f64::NAN, f64::INFINITY] {
            assert!(Bath::new(Drag::NONE, bad, 0).is_err(), "{bad}");
        }
    }

    /// At small rates the difference 1 - exp(-2 gamma t) would lose its digits: 5e-8 of them here.
    #[test]
    fn weak_noise_keeps_its_digits() {
        let bath = Bath::new(Drag::new(1e-9, 0.0).unwrap(), 1.0, 0).unwrap();
        let (spread, _) = bath.spreads(1.0);
        assert!((spread * spread / 2e-9 - 1.0).abs() < 2e-9);
    }
}

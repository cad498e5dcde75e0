use crate::Drag;
use thiserror::Error;

/// Drag with thermal noise that gives every degree of freedom the energy `kT/2`.
///
/// Velocities and body angular momenta follow Ornstein-Uhlenbeck processes, which are solved
/// exactly. For each component of a free point of mass `m`, and each body axis `a` of a free frame
/// with the moment `I_a`, over a time `t`:
///
/// ```text
/// v   <- exp(-gamma_t t) v   + sqrt(kT/m (1 - exp(-2 gamma_t t))) xi
/// l_a <- exp(-gamma_r t) l_a + sqrt(kT I_a (1 - exp(-2 gamma_r t))) xi
/// ```
///
/// `xi` are independent standard normal deviates. This preserves the Maxwell distribution for any
/// `t`. It is applied for half a step before and after each conservative step. Held and driven
/// bodies are excluded. Sliding bodies move along their free directions with their total mass.
///
/// The noise is a function of the seed, the step, the half and the index of the body, without a
/// running state. Resumed runs therefore agree bitwise with uninterrupted ones.
///
/// ```
/// use actin_integrate::{Bath, Drag};
/// let bath = Bath::new(Drag::new(0.5, 0.0).unwrap(), 4.0, 1).unwrap();
/// // sqrt(kT (1 - exp(-1))) for velocities; no noise without drag.
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
    /// Creates a bath of the thermal energy `kT` (pN nm), with the rates of `drag`.
    ///
    /// # Errors
    /// If the thermal energy is negative or not finite.
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

    /// Drag of the bath.
    pub fn drag(&self) -> &Drag {
        &self.drag
    }

    /// Seed of the noise.
    pub(crate) fn seed(&self) -> u64 {
        self.seed
    }

    /// Standard deviations of translation and rotation after a time `t` (ns), without the factor of
    /// the inertia: `sqrt(kT (1 - exp(-2 gamma t)))`. Zero for negative `t`.
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

/// Invalid thermal energy (pN nm).
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

    /// The difference 1 - exp(-2 gamma t) would have a relative error of 5e-8.
    #[test]
    fn weak_noise_keeps_its_digits() {
        let bath = Bath::new(Drag::new(1e-9, 0.0).unwrap(), 1.0, 0).unwrap();
        let (spread, _) = bath.spreads(1.0);
        assert!((spread * spread / 2e-9 - 1.0).abs() < 2e-9);
    }
}

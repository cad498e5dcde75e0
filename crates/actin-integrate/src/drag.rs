use thiserror::Error;

/// Exponential decay of velocities and angular momenta of free bodies:
///
/// ```text
/// dv/dt = -gamma_t v,   dl/dt = -gamma_r l   (rates in 1/ns)
/// ```
///
/// The factors `exp(-gamma t)` are applied for half a step before and after each conservative step,
/// which is rescaled in time, see [`time_rescaling`](Self::time_rescaling).
///
/// ```
/// use actin_integrate::Drag;
/// let drag = Drag::new(2.0, 0.0).unwrap();
/// assert_eq!(drag.factors(0.5), ((-1.0f64).exp(), 1.0));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Drag {
    translational: f64,
    rotational: f64,
}

impl Drag {
    /// No drag, without computational cost.
    pub const NONE: Self = Self {
        translational: 0.0,
        rotational: 0.0,
    };

    /// Creates drag with the rates `translational` and `rotational` (1/ns).
    ///
    /// # Errors
    /// If a rate is negative or not finite.
    pub fn new(translational: f64, rotational: f64) -> Result<Self, DragError> {
        for (kind, rate) in [("translational", translational), ("rotational", rotational)] {
            if !(rate.is_finite() && rate >= 0.0) {
                return Err(DragError { kind, rate });
            }
        }
        Ok(Self {
            translational,
            rotational,
        })
    }

    /// Rate of translational drag (1/ns).
    pub fn translational(&self) -> f64 {
        self.translational
    }

    /// Rate of rotational drag (1/ns).
    pub fn rotational(&self) -> f64 {
        self.rotational
    }

    /// Returns `true` if both rates are zero.
    pub(crate) fn is_none(&self) -> bool {
        *self == Self::NONE
    }

    /// Factors of velocities and angular momenta over a time `t` (ns).
    pub fn factors(&self, t: f64) -> (f64, f64) {
        (
            (-self.translational * t).exp(),
            (-self.rotational * t).exp(),
        )
    }

    /// Durations of the conservative step of points and frames relative to the step `h` (ns):
    ///
    /// ```text
    /// b = sqrt(tanh(gamma h/2) / (gamma h/2)) = 1 - (gamma h)^2/24 + ...
    /// ```
    ///
    /// The terminal motion under a constant force `F` is then `F h/(m gamma)` per step, and the
    /// diffusion coefficient in a heat bath is `kT/(m gamma)`, for any step. Without rescaling both
    /// are too large by `(gamma h/2) coth(gamma h/2)`.
    ///
    /// ```
    /// use actin_integrate::Drag;
    /// let (translation, rotation) = Drag::new(2.0, 0.0).unwrap().time_rescaling(1.0);
    /// assert!((translation * translation - 1.0f64.tanh()).abs() < 1e-15);
    /// assert_eq!(rotation, 1.0);
    /// ```
    ///
    /// # Source
    /// Sivak, Chodera and Crooks, J. Phys. Chem. B 118 (2014) 6466, equation 11.
    pub fn time_rescaling(&self, h: f64) -> (f64, f64) {
        let b = |rate: f64| {
            let x = 0.5 * rate * h;
            if x == 0.0 { 1.0 } else { (x.tanh() / x).sqrt() }
        };
        (b(self.translational), b(self.rotational))
    }

    /// Terminal velocities at the ends of steps of `h` (ns), relative to displacement per time.
    ///
    /// ```text
    /// b x/sinh(x) = 1 - (gamma h)^2/12 + ...,   x = gamma h/2
    /// ```
    ///
    /// They are smaller, since each step ends with drag over half a step.
    ///
    /// ```
    /// use actin_integrate::Drag;
    /// let (translation, rotation) = Drag::new(0.1, 0.0).unwrap().recorded_drift(1.0);
    /// assert!((translation - (1.0 - 0.01 / 12.0)).abs() < 1e-5);
    /// assert_eq!(rotation, 1.0);
    /// ```
    pub fn recorded_drift(&self, h: f64) -> (f64, f64) {
        let (translation, rotation) = self.time_rescaling(h);
        let share = |rate: f64, b: f64| {
            let x = 0.5 * rate * h;
            if x == 0.0 { 1.0 } else { b * x / x.sinh() }
        };
        (
            share(self.translational, translation),
            share(self.rotational, rotation),
        )
    }
}

/// Invalid drag rate.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("the {kind} drag rate must be finite and not negative, got {rate} per ns")]
pub struct DragError {
    /// `translational` or `rotational`.
    pub kind: &'static str,
    /// Value (1/ns).
    pub rate: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_that_are_negative_or_not_finite_are_refused() {
        for bad in [-1e-300, f64::NAN, f64::INFINITY] {
            assert_eq!(Drag::new(bad, 1.0).unwrap_err().kind, "translational");
            assert_eq!(Drag::new(1.0, bad).unwrap_err().kind, "rotational");
        }
        assert!(Drag::new(0.0, 0.0).unwrap().is_none());
        assert!(!Drag::new(0.0, 1.0).unwrap().is_none());
    }
}

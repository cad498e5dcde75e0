//! Mass-proportional drag, solved exactly.

use thiserror::Error;

/// Drag that slows every free body at a rate of its own kind.
///
/// `dv/dt = -gamma_t v` on velocities and `dl/dt = -gamma_r l` on angular momenta, rates in 1/ns.
/// Over a time `t` this multiplies them by `exp(-gamma t)`, which is how it is applied: half a
/// step before and half a step after each conservative step, never within.
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
    /// No drag at all; costs nothing.
    pub const NONE: Self = Self {
        translational: 0.0,
        rotational: 0.0,
    };

    /// Drag with the rates `translational` and `rotational` (1/ns).
    ///
    /// # Errors
    /// A rate that is negative or not finite.
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

    /// Whether both rates are zero.
    pub fn is_none(&self) -> bool {
        *self == Self::NONE
    }

    /// Factors on velocities and on angular momenta over a time `t` (ns).
    pub fn factors(&self, t: f64) -> (f64, f64) {
        (
            (-self.translational * t).exp(),
            (-self.rotational * t).exp(),
        )
    }
}

/// A drag rate that was refused.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("the {kind} drag rate must be finite and not negative, got {rate} per ns")]
pub struct DragError {
    /// Which of the two rates.
    pub kind: &'static str,
    /// Its value (1/ns).
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

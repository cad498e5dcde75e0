//! The time step that a method may take at a given largest frequency.

use crate::Composition;
use thiserror::Error;

/// The share of the stability limit that is used unless the caller says otherwise.
///
/// The limit is that of the linearised system at one state. Frequencies rise as the system
/// deforms away from it, the estimate may be short by a percent, and a nonlinear system has
/// resonances between its fast modes and the step, below the limit: those of Verlet at 0.87
/// (third order) and 0.71 (fourth order) of it do harm.
///
/// Measured over 1e5 steps of three bonded tops, by the rms strain of their bonds. At 2.6 %, from
/// eight random starts each: at half the limit the energy has no trend beyond a tenth of its
/// fluctuation, except with VEFRL, where it diffuses by up to 0.3 %; at 0.4 of the limit VEFRL has
/// none either. Larger motion needs smaller steps (one start each): at 6 % PEFRL and VEFRL wander
/// at half the limit, at 15 % VEFRL loses the energy altogether, at 31 % every method does. At a
/// quarter of the limit that last state still changes its energy by 1 % (Forest and Ruth) to 70 %
/// (PEFRL). So half the limit is no promise for long undamped runs in violent motion.
///
/// # Source
/// Schlick, Mandziuk, Skeel and Srinivas, J. Comput. Phys. 140 (1998) 1, for the resonances.
pub const SAFETY: f64 = 0.5;

/// The step (ns) `safety * limit / frequency`, with the limit of `scheme` and the largest
/// frequency of the system in rad/ns.
///
/// # Errors
/// A frequency that is not positive and finite (a system without stiffness has no largest step),
/// a safety factor outside (0, 1], or two numbers whose step overflows or underflows.
///
/// ```
/// use actin_integrate::{POSITION_VERLET, stable_step};
/// assert_eq!(stable_step(&POSITION_VERLET, 500.0, 0.5).unwrap(), 0.002);
/// ```
pub fn stable_step(scheme: &Composition, frequency: f64, safety: f64) -> Result<f64, StepError> {
    if !(frequency.is_finite() && frequency > 0.0) {
        return Err(StepError::Frequency(frequency));
    }
    if !(safety > 0.0 && safety <= 1.0) {
        return Err(StepError::Safety(safety));
    }
    let step = safety * scheme.stability_limit / frequency;
    if !(step.is_finite() && step > 0.0) {
        return Err(StepError::Step { step, frequency });
    }
    Ok(step)
}

/// Why no step could be given.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum StepError {
    /// The frequency is not positive and finite.
    #[error("the largest frequency must be positive and finite, got {0} rad/ns")]
    Frequency(f64),
    /// The safety factor is outside (0, 1].
    #[error("the safety factor must be above 0 and at most 1, got {0}")]
    Safety(f64),
    /// The step is infinite or zero in double precision.
    #[error(
        "the time step at a largest frequency of {frequency} rad/ns is {step} ns: must be positive and finite"
    )]
    Step {
        /// Step (ns).
        step: f64,
        /// Largest frequency (rad/ns).
        frequency: f64,
    },
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::PEFRL;

    #[test]
    fn steps_without_a_meaning_are_refused() {
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(
                stable_step(&PEFRL, bad, 0.5),
                Err(StepError::Frequency(_))
            ));
        }
        for bad in [0.0, -0.1, 1.1, f64::NAN] {
            assert!(matches!(
                stable_step(&PEFRL, 1.0, bad),
                Err(StepError::Safety(_))
            ));
        }
        for (frequency, safety) in [(1e-309, 0.5), (1e308, 1e-308)] {
            let refused = stable_step(&PEFRL, frequency, safety);
            assert!(matches!(refused, Err(StepError::Step { .. })));
        }
    }
}

//! When a damped run counts as having come to rest.

use actin_mechanics::Residual;
use thiserror::Error;

/// Ends a run when loads and motion are both small.
///
/// Small loads alone would stop a system that swings through its equilibrium; little motion alone
/// would stop it where it turns back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StopRule {
    force: f64,
    torque: f64,
    kinetic: f64,
}

impl StopRule {
    /// The rule with the tolerances `force` (pN) and `torque` (pN nm) on the largest load on a
    /// free body, and `kinetic` (pN nm) on the kinetic energy of all. A tolerance may be infinite.
    ///
    /// # Errors
    /// A tolerance that is not positive.
    pub fn new(force: f64, torque: f64, kinetic: f64) -> Result<Self, StopRuleError> {
        for (kind, tolerance) in [("force", force), ("torque", torque), ("kinetic", kinetic)] {
            if tolerance.is_nan() || tolerance <= 0.0 {
                return Err(StopRuleError { kind, tolerance });
            }
        }
        Ok(Self {
            force,
            torque,
            kinetic,
        })
    }

    /// Whether a state with these loads and this kinetic energy is at rest.
    pub fn is_met(&self, residual: Residual, kinetic: f64) -> bool {
        residual.force <= self.force && residual.torque <= self.torque && kinetic <= self.kinetic
    }
}

/// A tolerance that was refused.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("the {kind} tolerance must be positive, got {tolerance}")]
pub struct StopRuleError {
    /// Which tolerance.
    pub kind: &'static str,
    /// Its value.
    pub tolerance: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each of the three conditions can hold the run back on its own.
    #[test]
    fn all_three_tolerances_must_hold() {
        let rule = StopRule::new(1.0, 2.0, 3.0).unwrap();
        let met = |force, torque, kinetic| rule.is_met(Residual { force, torque }, kinetic);
        assert!(met(1.0, 2.0, 3.0));
        assert!(!met(1.1, 2.0, 3.0));
        assert!(!met(1.0, 2.1, 3.0));
        assert!(!met(1.0, 2.0, 3.1));
        assert!(!met(f64::NAN, 2.0, 3.0));
    }

    #[test]
    fn tolerances_that_are_not_positive_are_refused() {
        for bad in [0.0, -1.0, f64::NAN] {
            assert_eq!(StopRule::new(bad, 1.0, 1.0).unwrap_err().kind, "force");
            assert_eq!(StopRule::new(1.0, bad, 1.0).unwrap_err().kind, "torque");
            assert_eq!(StopRule::new(1.0, 1.0, bad).unwrap_err().kind, "kinetic");
        }
    }
}

use actin_mechanics::Residual;
use thiserror::Error;

/// Convergence criterion of a run: small loads and a small kinetic energy.
///
/// Loads alone are small when a system passes its equilibrium, and the kinetic energy alone is
/// small at turning points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StopRule {
    force: f64,
    torque: f64,
    kinetic: f64,
}

impl StopRule {
    /// Creates a rule with tolerances `force` (pN) and `torque` (pN nm) of the largest load on a
    /// free body, and `kinetic` (pN nm) of the total kinetic energy. Tolerances may be infinite.
    ///
    /// # Errors
    /// If a tolerance is not positive.
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

    /// Returns `true` if loads and kinetic energy are within the tolerances.
    pub fn is_met(&self, residual: Residual, kinetic: f64) -> bool {
        residual.force <= self.force && residual.torque <= self.torque && kinetic <= self.kinetic
    }
}

/// Invalid tolerance.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("the {kind} tolerance must be positive, got {tolerance}")]
pub struct StopRuleError {
    /// `force`, `torque` or `kinetic`.
    pub kind: &'static str,
    /// Value of the tolerance.
    pub tolerance: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

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

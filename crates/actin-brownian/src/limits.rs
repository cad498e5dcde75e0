//! Limits of the iterations of an implicit step.

use actin_equilibrium::StepSize;

/// Convergence limits of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepLimits {
    /// Largest displacement (nm) of the last iteration, positive.
    pub displacement: f64,
    /// Largest rotation (rad) of the last iteration, positive.
    pub rotation: f64,
    /// Maximum number of iterations, at least 1.
    pub iterations: usize,
}

impl Default for StepLimits {
    fn default() -> Self {
        Self {
            displacement: 1e-3,
            rotation: 1e-4,
            iterations: 60,
        }
    }
}

impl StepLimits {
    pub(crate) fn hold(&self, extent: &StepSize) -> bool {
        extent.displacement <= self.displacement && extent.rotation <= self.rotation
    }
}

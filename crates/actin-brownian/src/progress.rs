use crate::StepLimits;
use actin_equilibrium::StepSize;

/// Relative error of a step that is small compared with the noise.
const ENOUGH: f64 = 1e-3;

/// Initial iterations that may grow.
const FREE_ITERATIONS: usize = 3;

/// Factor of the change of added friction.
const DAMPING: f64 = 4.0;

/// Largest added friction in units of the friction over the time step.
const MOST_DAMPING: f64 = 64.0;

#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Progress {
    first: StepSize,
    last: StepSize,
    iterations: usize,
    /// Added friction in units of the friction over the time step.
    damping: f64,
    /// Whether the last two iterations had equal friction.
    is_even: bool,
}

impl Progress {
    pub(crate) fn is_first(&self) -> bool {
        self.iterations == 0
    }

    /// Factor of the friction in the next iteration, above 1 if iterations grow.
    pub(crate) fn friction(&self) -> f64 {
        1.0 + self.damping
    }

    /// Records the size of an iteration. Returns `true` if the predicted size of the next iteration
    /// is within the limits, or below a thousandth of the first one.
    pub(crate) fn is_solved(&mut self, extent: StepSize, limits: &StepLimits) -> bool {
        let before = self.damping;
        let is_first = self.is_first();
        if is_first {
            (self.first, self.last, self.is_even) = (extent, extent, true);
        }
        // Ratios of iterations with different friction do not measure convergence.
        let was_even = self.is_even;
        let ratios = [
            extent.displacement / self.last.displacement,
            extent.rotation / self.last.rotation,
        ];
        let ratio = ratios[0].max(ratios[1]);
        if self.is_even && self.iterations >= FREE_ITERATIONS && ratio > 1.0 {
            self.damping = (DAMPING * before).clamp(1.0, MOST_DAMPING);
        } else if self.is_even {
            self.damping = if before > 1.0 { before / DAMPING } else { 0.0 };
        }
        self.is_even = self.damping.total_cmp(&before).is_eq();
        self.last = extent;
        self.iterations += 1;
        if is_first {
            return limits.hold(&extent);
        }
        let limits = StepLimits {
            displacement: limits.displacement.max(ENOUGH * self.first.displacement),
            rotation: limits.rotation.max(ENOUGH * self.first.rotation),
            ..*limits
        };
        // Size of the iteration without added friction.
        let rests =
            ratios.map(|ratio| if was_even { ratio.min(1.0) } else { 1.0 } * (1.0 + before));
        limits.hold(&StepSize {
            displacement: rests[0] * extent.displacement,
            rotation: rests[1] * extent.rotation,
            ..extent
        })
    }
}

//! Convergence of the iterations of a step.

use crate::StepLimits;
use actin_equilibrium::StepSize;

/// Error of a step relative to its size that is small beside the noise.
const ENOUGH: f64 = 1e-3;

/// Iterations that need not shrink.
const FREE_ITERATIONS: usize = 3;

/// Factor by which added friction grows and falls.
const DAMPING: f64 = 4.0;

/// Largest added friction in units of the friction over the time step.
const MOST_DAMPING: f64 = 64.0;

/// The iterations of a step so far.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Progress {
    first: StepSize,
    last: StepSize,
    iterations: usize,
    /// Added friction in units of the friction over the time step.
    damping: f64,
    /// True if the last two iterations had equal friction.
    is_even: bool,
}

impl Progress {
    /// Returns true before the first iteration.
    pub(crate) fn is_first(&self) -> bool {
        self.iterations == 0
    }

    /// Returns the factor of the friction in the next iteration. Friction is added where iterations grow.
    pub(crate) fn friction(&self) -> f64 {
        1.0 + self.damping
    }

    /// Takes the extent of an iteration; returns true if the step is solved: if the next iteration, which leaves about the same
    /// share of the last, would be within the limits, or within a thousandth of the first.
    pub(crate) fn is_solved(&mut self, extent: StepSize, limits: &StepLimits) -> bool {
        let before = self.damping;
        let is_first = self.is_first();
        if is_first {
            (self.first, self.last, self.is_even) = (extent, extent, true);
        }
        // Iterations with different friction do not tell how they shrink.
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
        // As far as the iteration would have gone without added friction.
        let rests =
            ratios.map(|ratio| if was_even { ratio.min(1.0) } else { 1.0 } * (1.0 + before));
        limits.hold(&StepSize {
            displacement: rests[0] * extent.displacement,
            rotation: rests[1] * extent.rotation,
            ..extent
        })
    }
}

//! Options of paths.

use crate::options::{OptionsError, positive, rule};

/// Treatment of saddles on the path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Saddles {
    /// Leave saddles, at most this many times per step.
    Leave(usize),
    /// End the path at the last equilibrium before the saddle.
    Stop,
    /// Continue along the saddle, marked by its certificate.
    Keep,
}

/// Treatment of steps that move too far even with the smallest step. Small snaps, which longer steps could cross, are
/// crossed and marked in both cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Jumps {
    /// End the path before the jump.
    Stop,
    /// Continue after the jump, marked in the point.
    Accept,
}

/// Options of a [`Path`](crate::Path).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathOptions {
    /// First step of the path parameter. Default: 0.1.
    pub first_step: f64,
    /// Smallest step. Default: 1e-4.
    pub smallest_step: f64,
    /// Largest step. Default: 0.25.
    pub largest_step: f64,
    /// Maximum number of iterations after which the next step grows. Default: 10.
    pub easy: usize,
    /// Number of iterations above which the next step shrinks. Default: 40.
    pub hard: usize,
    /// Maximum rotation of a free body per step (rad). Default: 0.6.
    pub largest_turn: f64,
    /// Maximum relative motion of neighbours per step: rotation (rad), or displacement over
    /// distance. Default: 0.5.
    pub largest_strain: f64,
    /// Treatment of saddles. Default: leave, at most 3 times per step.
    pub saddles: Saddles,
    /// Treatment of jumps. Default: stop.
    pub jumps: Jumps,
    /// Extrapolates the last two equilibria as initial guess. Default: true.
    pub extrapolate: bool,
}

impl Default for PathOptions {
    fn default() -> Self {
        Self {
            first_step: 0.1,
            smallest_step: 1e-4,
            largest_step: 0.25,
            easy: 10,
            hard: 40,
            largest_turn: 0.6,
            largest_strain: 0.5,
            saddles: Saddles::Leave(3),
            jumps: Jumps::Stop,
            extrapolate: true,
        }
    }
}

impl PathOptions {
    pub(crate) fn check(&self) -> Result<(), OptionsError> {
        positive("smallest_step", self.smallest_step)?;
        positive("largest_strain", self.largest_strain)?;
        let at_least = "at least the smallest step";
        rule(
            "first_step",
            at_least,
            self.first_step,
            self.first_step >= self.smallest_step,
        )?;
        rule(
            "largest_step",
            at_least,
            self.largest_step,
            self.largest_step >= self.smallest_step,
        )?;
        rule(
            "largest_turn",
            "positive and below pi",
            self.largest_turn,
            self.largest_turn > 0.0 && self.largest_turn < std::f64::consts::PI,
        )?;
        Ok(())
    }
}

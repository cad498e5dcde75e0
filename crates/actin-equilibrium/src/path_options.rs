//! What a path may do.

use crate::options::{OptionsError, positive, rule};

/// What to do with a saddle on the path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Saddles {
    /// Leave it, at most this many times per step, and go on from the minimum.
    Leave(usize),
    /// End the path at the last equilibrium that was none.
    Stop,
    /// Go on along it; its certificate says what it is.
    Keep,
}

/// What to do where the equilibrium moves too far even in the smallest step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Jumps {
    /// End the path before the jump.
    Stop,
    /// Go on from where it leads; the point says that it jumped.
    Accept,
}

/// Settings of a [`Path`](crate::Path).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathOptions {
    /// First step of the path parameter; 0.1.
    pub first_step: f64,
    /// Smallest step; 1e-4.
    pub smallest_step: f64,
    /// Largest step; 0.25.
    pub largest_step: f64,
    /// Steps that take at most this many iterations let the next one grow; 10.
    pub easy: usize,
    /// Steps that take more than this many iterations let the next one shrink; 40.
    pub hard: usize,
    /// Largest turn of a free body between neighbouring equilibria (rad); 0.6.
    pub largest_turn: f64,
    /// Largest relative motion of neighbours between neighbouring equilibria: turn (rad), or
    /// displacement over distance; 0.5.
    pub largest_strain: f64,
    /// What to do with saddles; they are left, up to 3 times per step.
    pub saddles: Saddles,
    /// What to do with jumps; the path ends.
    pub jumps: Jumps,
    /// Whether steps begin from an extrapolation of the last two equilibria; yes.
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
    /// Checks the settings.
    ///
    /// # Errors
    /// If one of them makes no sense.
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

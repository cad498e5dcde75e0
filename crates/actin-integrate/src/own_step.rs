use crate::{Body, FailureKind};
use actin_mechanics::System;
use thiserror::Error;

/// Makes the steps of a run.
///
/// A step must depend only on the state of the system, its number and its length. Resumed runs
/// otherwise differ.
pub trait Stepper {
    /// Makes the `step`-th step, counted from 0, of length `h` (ns), including the actions at its
    /// end.
    ///
    /// # Errors
    /// If the step fails. The state is then invalid.
    fn step(&mut self, system: &mut System, step: u64, h: f64) -> Result<(), StepFailure>;

    /// Returns `true` if steps never move bodies through each other that an interaction separates.
    /// Runs then do not check for it. The default is `false`.
    fn prevents_crossings(&self) -> bool {
        false
    }
}

/// Failure of a step.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("{problem}, at {body}")]
pub struct StepFailure {
    /// Kind of the failure.
    pub problem: FailureKind,
    /// Body at which the step failed.
    pub body: Body,
}

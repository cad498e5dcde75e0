//! Steps that are made in a way of their own, with the run loop of all others.

use crate::execution::Execution;
use crate::{Body, Checkpoint, FailureKind, Observer, Run, RunFailure, RunOutcome};
use actin_mechanics::System;
use thiserror::Error;

/// Makes the steps of a run.
///
/// It carries nothing from one step to the next that is not in the system: a step depends on the state,
/// its number and its length alone, or a run that is resumed would give other bits.
pub trait Stepper {
    /// Makes one step of length `h` (ns), the `step`-th from 0, and lets happen what does at its end.
    ///
    /// # Errors
    /// A step that fails; the state is then of no use.
    fn step(&mut self, system: &mut System, step: u64, h: f64) -> Result<(), StepFailure>;
}

/// A step that failed.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("{problem}, at {body}")]
pub struct StepFailure {
    /// What went wrong.
    pub problem: FailureKind,
    /// The body where it went wrong.
    pub body: Body,
}

impl Run {
    /// Advances `system` with the steps of `stepper`, as [`execute`](Self::execute) does with those of the
    /// method. Of this run its step, its intervals and its rules count, not its drag or its bath; the method does not
    /// either.
    ///
    /// # Errors
    /// As [`execute`](Self::execute), and a step that fails.
    pub fn execute_steps(
        &self,
        stepper: &mut dyn Stepper,
        system: &mut System,
        observers: &mut [&mut dyn Observer],
    ) -> Result<RunOutcome, RunFailure> {
        Execution::new(self, Some(stepper), system, observers).run()
    }

    /// Goes on from `checkpoint` with the steps of `stepper`, as [`resume`](Self::resume) does.
    ///
    /// # Errors
    /// As [`execute_steps`](Self::execute_steps).
    ///
    /// # Panics
    /// As [`resume`](Self::resume).
    pub fn resume_steps(
        &self,
        checkpoint: &Checkpoint,
        stepper: &mut dyn Stepper,
        system: &mut System,
        observers: &mut [&mut dyn Observer],
    ) -> Result<RunOutcome, RunFailure> {
        Execution::resume(self, checkpoint, Some(stepper), system, observers).run_on()
    }
}

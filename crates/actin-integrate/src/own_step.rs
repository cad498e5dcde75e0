use crate::execution::Execution;
use crate::{Body, Checkpoint, FailureKind, Observer, Run, RunFailure, RunOutcome};
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

impl Run {
    /// Advances `system` with the steps of `stepper`, like [`execute`](Self::execute). The method,
    /// drag and heat bath of the run are ignored.
    ///
    /// # Errors
    /// See [`execute`](Self::execute). Also if a step fails.
    pub fn execute_steps(
        &self,
        stepper: &mut dyn Stepper,
        system: &mut System,
        observers: &mut [&mut dyn Observer],
    ) -> Result<RunOutcome, RunFailure> {
        Execution::new(self, Some(stepper), system, observers).run()
    }

    /// Continues from `checkpoint` with the steps of `stepper`, like [`resume`](Self::resume).
    ///
    /// # Errors
    /// See [`execute_steps`](Self::execute_steps).
    ///
    /// # Panics
    /// See [`resume`](Self::resume).
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

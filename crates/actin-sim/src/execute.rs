//! Runs of plans.

use crate::Plan;
use crate::run::{Outcome, RunError, SavedRun, Sink, Trajectory};
use crate::trade::model_error;

impl Plan<'_> {
    /// Runs the plan and returns its records in memory.
    ///
    /// # Errors
    /// As [`run_into`](Self::run_into). The records of a failed run are lost.
    pub fn run(&self) -> Result<(Trajectory, Outcome), RunError> {
        let mut trajectory = Trajectory::default();
        let outcome = self.run_into(&mut trajectory)?;
        Ok((trajectory, outcome))
    }

    /// Runs the plan and passes records to `sink`.
    ///
    /// # Errors
    /// If the state diverges, a path ends early, twist is lost, the run ends on a saddle or with a
    /// load below the residual, or states exceed the validity of the model. The sink has all
    /// records up to the last good one.
    pub fn run_into(&self, sink: &mut dyn Sink) -> Result<Outcome, RunError> {
        self.execute(None, sink, model_error)
    }

    /// Resumes an interrupted run, whose records `sink` has.
    ///
    /// Interrupted and resumed runs give bitwise the same records and outcome as uninterrupted
    /// runs, except for the run time.
    ///
    /// # Errors
    /// As [`run_into`](Self::run_into).
    ///
    /// # Panics
    /// If `saved` belongs to another task or to other numbers of bodies.
    pub fn resume_into(&self, saved: SavedRun, sink: &mut dyn Sink) -> Result<Outcome, RunError> {
        self.execute(Some(saved), sink, model_error)
    }
}

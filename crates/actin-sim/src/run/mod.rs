//! Runs of scenes: equilibria and motions in time, with their records.

mod bound;
mod brownian;
mod dynamics;
mod equilibrium;
mod hinge;
mod long_steps;
mod lost_load;
mod outcome;
mod periodic;
mod plan;
mod points;
mod record_stream;
mod recorder;
mod records;
mod rest;
mod sink;
mod slip;
mod start;
mod states;
mod step_check;
mod steps;
mod unknowns;

pub use brownian::RelaxationTimes;
pub(crate) use dynamics::composition_of;
pub use dynamics::{Estimate, composition};
pub use equilibrium::EquilibriumReport;
pub use hinge::HingeSlip;
pub use outcome::{FailedRun, Failure, Outcome, RunError, Status};
pub use plan::Plan;
pub use record_stream::{RecordSummary, RunStatistics};
pub(crate) use recorder::record;
pub use records::{
    At, EnergyTotals, Record, RecordIter, Records, RecordsError, Row, StoredRecord, Trajectory,
};
pub use rest::SaddlePush;
pub use sink::{
    MotionPosition, PathPosition, Progress, ResolutionSwitch, RunPosition, SavedRun, Sink,
    SolveReport,
};
pub use slip::Slip;
pub use start::near_equilibrium;
pub use states::{StableState, StableStates};
pub use step_check::StepError;
pub use steps::LongestStep;
pub use unknowns::newton as solver;
pub(crate) use unknowns::order;

use crate::scene::{SceneProblem, Task};
use sink::Clock;

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
        self.execute(None, sink)
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
        self.execute(Some(saved), sink)
    }

    fn execute(&self, saved: Option<SavedRun>, sink: &mut dyn Sink) -> Result<Outcome, RunError> {
        let assembly = self.assembly();
        if assembly.scene.filament.sections.following().is_some() {
            let rule = "sections that follow a motion can only be run by `actin run`, or by `follow::Follower` in Rust";
            return Err(SceneProblem::new("filament.sections", "Following(..)", rule).into());
        }
        let clock = Clock::new(saved.as_ref(), self.set_up_s());
        let (mut outcome, failure) = match (&assembly.scene.task, self.estimate()) {
            (Task::Dynamics(dynamics), Some(estimate)) => {
                dynamics::run(assembly, dynamics, estimate, saved, clock, sink)?
            }
            (Task::Brownian(task), Some(estimate)) => {
                brownian::run(assembly, task, estimate, saved, clock, sink)?
            }
            (Task::Equilibrium(settings), _) => {
                equilibrium::run(assembly, settings, saved, clock, sink)?
            }
            (Task::Dynamics(_) | Task::Brownian(_), None) => {
                unreachable!("the plan of a motion has an estimate")
            }
        };
        outcome.plan_notes = self.notes();
        let is_of_use = outcome.beyond_use.is_empty() || outcome.status == Status::Interrupted;
        let failure = failure.or_else(|| {
            (!is_of_use).then(|| Failure::ModelLimitExceeded(outcome.beyond_use.clone()))
        });
        match failure {
            None => Ok(outcome),
            Some(failure) => {
                outcome.status = Status::Failed;
                outcome.failure = failure.to_string();
                Err(RunError::Failed(Box::new(FailedRun { failure, outcome })))
            }
        }
    }
}

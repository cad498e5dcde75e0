//! Runs of scenes: equilibria and motions in time, with their records.

mod brownian;
mod dynamics;
mod equilibrium;
mod estimate;
mod hinge;
mod long_steps;
mod outcome;
mod plan;
mod record_stream;
mod record_summary;
mod recorder;
mod records;
mod rest;
mod sink;
mod slip;
mod spins;
mod start;
mod states;
mod step_check;
mod steps;
mod unknowns;

pub use brownian::RelaxationTimes;
pub use equilibrium::path_options;
pub(crate) use estimate::composition_of;
pub use estimate::{Estimate, LongestStep, composition};
pub use hinge::HingeSlip;
pub use outcome::{
    EquilibriumReport, FailedRun, Failure, ModelError, Outcome, RunError, Scatter, Status,
};
pub(crate) use outcome::{MeasureModelError, ModelErrorResult};
pub use plan::Plan;
pub use record_summary::{RecordSummary, RunStatistics};
pub(crate) use recorder::record;
pub use records::{
    EnergyTotals, Record, RecordIter, Records, RecordsError, Row, StoredRecord, Trajectory,
};
pub use rest::SaddlePush;
pub(crate) use sink::InterruptibleTrajectory;
pub use sink::{
    MotionPosition, PathPosition, Progress, ResolutionSwitch, RunPosition, SavedRun, Sink,
    SolveReport,
};
pub use slip::Slip;
pub use start::near_equilibrium;
pub use states::{StableState, StableStates};
pub use step_check::StepError;
pub use unknowns::newton as solver;
pub(crate) use unknowns::order;

use crate::scene::{SceneProblem, Task};
use recorder::Recorder;
use sink::Clock;

impl Plan<'_> {
    /// Runs or resumes the plan; `model_error` measures the error of an equilibrium.
    pub(crate) fn execute(
        &self,
        saved: Option<SavedRun>,
        sink: &mut dyn Sink,
        model_error: MeasureModelError,
    ) -> Result<Outcome, RunError> {
        let assembly = self.assembly();
        if assembly.scene.filament.sections.following().is_some() {
            let rule = "sections that follow a motion can only be run by `actin run`, or by `follow::Follower` in Rust";
            return Err(SceneProblem::new("filament.sections", "Following(..)", rule).into());
        }
        let clock = Clock::new(saved.as_ref(), self.set_up_s());
        let (mut outcome, failure) = match (&assembly.scene.task, self.estimate()) {
            (Task::Dynamics(dynamics), Some(estimate)) => {
                let recorder = Recorder::new(assembly, dynamics, saved, clock, sink);
                dynamics::run(assembly, dynamics, estimate, recorder)?
            }
            (Task::Brownian(task), Some(estimate)) => {
                let recorder = Recorder::new(assembly, &task.to_dynamics(), saved, clock, sink);
                brownian::run(assembly, task, estimate, recorder)?
            }
            (Task::Equilibrium(settings), _) => {
                equilibrium::run(assembly, (settings, model_error), saved, clock, sink)?
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

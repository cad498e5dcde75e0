//! Running a scene: an equilibrium or a motion in time, with records on the way.

mod bound;
mod brownian;
mod dynamics;
mod endless;
mod equilibrium;
mod hinge;
mod long_steps;
mod lost_load;
mod outcome;
mod plan;
mod points;
mod recorder;
mod records;
mod rest;
mod sink;
mod slip;
mod start;
mod states;
mod steps;
mod taken;
mod unknowns;

pub use brownian::RelaxationTimes;
pub(crate) use dynamics::composition_of;
pub use dynamics::{Estimate, composition};
pub use equilibrium::EquilibriumReport;
pub use hinge::HingeSlip;
pub use outcome::{FailedRun, Failure, Outcome, RunError, Status};
pub use plan::Plan;
pub(crate) use recorder::record;
pub use records::{At, Record, RecordIter, Records, Row, RowIter, Trajectory};
pub use rest::SaddlePush;
pub use sink::{
    Arrival, BehindSwitch, MotionPosition, PathPosition, Progress, RunPosition, Saved, Sink,
};
pub use slip::Slip;
pub use start::near_equilibrium;
pub use states::{StableState, StableStates};
pub use steps::LongestStep;
pub(crate) use taken::Carried;
pub use taken::Recorded;
pub use unknowns::newton as solver;
pub(crate) use unknowns::order;

use crate::scene::{SceneProblem, Task};
use sink::Clock;

impl Plan<'_> {
    /// Runs it into memory.
    ///
    /// # Errors
    /// What went wrong, with what the run cost; its records up to there are lost:
    /// [`run_into`](Self::run_into) keeps them.
    pub fn run(&self) -> Result<(Trajectory, Outcome), RunError> {
        let mut trajectory = Trajectory::default();
        let outcome = self.run_into(&mut trajectory)?;
        Ok((trajectory, outcome))
    }

    /// Runs it into a sink.
    ///
    /// # Errors
    /// A state that explodes, a path that ends early, twist that is lost, an end on a saddle or in an
    /// equilibrium in which a load is lost, states far outside the range of the model. The sink has all records up
    /// to the last good one.
    pub fn run_into(&self, sink: &mut dyn Sink) -> Result<Outcome, RunError> {
        self.execute(None, sink)
    }

    /// Runs what is left of a run that was interrupted, whose records `sink` has.
    ///
    /// A run that was interrupted and resumed, any number of times, gives the records and the outcome of
    /// one that was not, to the bit, but for the time that it took.
    ///
    /// # Errors
    /// As [`run_into`](Self::run_into).
    ///
    /// # Panics
    /// If what was saved belongs to another task or other numbers of bodies.
    pub fn resume_into(&self, saved: Saved, sink: &mut dyn Sink) -> Result<Outcome, RunError> {
        self.execute(Some(saved), sink)
    }

    fn execute(&self, saved: Option<Saved>, sink: &mut dyn Sink) -> Result<Outcome, RunError> {
        let assembly = self.assembly();
        if assembly.scene.filament.sections.following().is_some() {
            let rule = "sections that follow a motion are run by `actin run` alone, and by follow::Follower in Rust";
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
        let failure = failure
            .or_else(|| (!is_of_use).then(|| Failure::BeyondUse(outcome.beyond_use.clone())));
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

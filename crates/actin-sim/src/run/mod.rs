//! Running a scene: an equilibrium or a motion in time, with records on the way.

mod bound;
mod dynamics;
mod equilibrium;
mod keep;
mod steps;

pub use dynamics::{Estimate, estimate};
pub use equilibrium::EquilibriumReport;
pub(crate) use equilibrium::newton as solver;
pub use keep::{Arrival, Keeper, Kept, PathStanding, Standing, Unkept};

use crate::Assembly;
use crate::scene::{Problem, Task};
use actin_equilibrium::PathFailure;
use actin_integrate::RunFailure;
use actin_mechanics::State;
use std::ops::ControlFlow;
use thiserror::Error;

/// One recorded moment.
#[derive(Clone, Debug)]
pub struct Record {
    /// Time (ns); of an equilibrium the path parameter, which counts stages.
    pub time_ns: f64,
    /// Everything that moves.
    pub state: State,
    /// Energy of each term of the assembly, in order (pN nm).
    pub energies_pn_nm: Vec<f64>,
    /// Kinetic energy of the free bodies (pN nm).
    pub kinetic_pn_nm: f64,
    /// Largest force on a free point (pN).
    pub residual_force_pn: f64,
    /// Largest torque on a free frame (pN nm).
    pub residual_torque_pn_nm: f64,
}

impl Record {
    /// Energy of all terms (pN nm).
    pub fn potential_pn_nm(&self) -> f64 {
        self.energies_pn_nm.iter().sum()
    }
}

/// The recorded moments of a run, in time.
#[derive(Clone, Debug, Default)]
pub struct Trajectory {
    /// Records in time; the last is where the run ended.
    pub records: Vec<Record>,
}

/// How a run ended and what it cost.
#[derive(Clone, Debug)]
pub struct RunReport {
    /// Whether the stop rule was met.
    pub converged: bool,
    /// Whether the run broke off (a state exploded, a path ended early) or a load is lost in the
    /// equilibrium that it reached.
    pub failed: bool,
    /// Whether the run was left at the wish of its keeper, to be taken up again.
    pub interrupted: bool,
    /// Steps taken.
    pub steps: u64,
    /// Load evaluations.
    pub force_evaluations: u64,
    /// Time step (ns); none of an equilibrium.
    pub time_step_ns: Option<f64>,
    /// Largest frequency found at the start (rad/ns); none of an equilibrium.
    pub largest_frequency_rad_per_ns: Option<f64>,
    /// What is known of the equilibrium; none of a motion in time.
    pub equilibrium: Option<EquilibriumReport>,
    /// Time that the run took (s).
    pub wall_s: f64,
}

/// How far a run has come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Time (ns), or the path parameter.
    pub time_ns: f64,
    /// Time at which it ends (ns), or the number of stages.
    pub end_ns: f64,
    /// Steps taken.
    pub steps: u64,
    /// Largest force on a free point (pN).
    pub residual_force_pn: f64,
}

/// Why a scene did not run to its end.
#[derive(Debug, Error)]
pub enum RunError {
    /// The scene asks for something that shows as wrong only now.
    #[error(transparent)]
    Refused(#[from] Problem),
    /// The path of equilibria ended before its end.
    #[error("{place}{failure}")]
    Ended {
        /// The stage that broke, in words; empty where there is no path.
        place: String,
        /// Where and why.
        failure: Box<PathFailure>,
        /// The equilibria that were reached.
        trajectory: Box<Trajectory>,
        /// Cost up to there.
        report: Box<RunReport>,
    },
    /// Equilibria were reached, but the last does not tell what a load does.
    #[error("{problem}")]
    Lost {
        /// Which load, and in what it is lost.
        problem: Box<Problem>,
        /// The equilibria.
        trajectory: Box<Trajectory>,
        /// Their cost.
        report: Box<RunReport>,
    },
    /// The state exploded.
    #[error("{failure}; {} is {body}", failure.body)]
    Failed {
        /// Where and when.
        failure: Box<RunFailure>,
        /// The body where it went wrong, in words.
        body: String,
        /// What was recorded up to the last good state.
        trajectory: Box<Trajectory>,
        /// Cost up to there.
        report: Box<RunReport>,
    },
}

/// Runs the scene of `assembly`; `watch` sees its progress and may break it off.
///
/// The assembly's scene afterwards holds the time step that was taken, and its system the last
/// state.
///
/// # Errors
/// What [`estimate`] refuses; a state that explodes, a path that ends early or an equilibrium in which
/// a load is lost, with all records up to the last good one.
pub fn run(
    assembly: &mut Assembly,
    watch: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Result<(Trajectory, RunReport), RunError> {
    run_kept(assembly, None, &mut Unkept, watch)
}

/// The same under the eyes of a `keeper`, and from where it was left if it was.
///
/// A run that was left and taken up again, any number of times, gives the records and the report
/// of one that was not, to the bit, but for the time that it took. `assembly` is then as built, of
/// the same scene by the same program.
///
/// # Errors
/// As [`run`].
///
/// # Panics
/// If what was kept belongs to another task or other numbers of bodies.
pub fn run_kept(
    assembly: &mut Assembly,
    kept: Option<Kept>,
    keeper: &mut dyn Keeper,
    watch: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Result<(Trajectory, RunReport), RunError> {
    match assembly.scene.task.clone() {
        Task::Dynamics(dynamics) => dynamics::run(assembly, &dynamics, kept, keeper, watch),
        Task::Equilibrium(settings) => equilibrium::run(assembly, &settings, kept, keeper, watch),
    }
}

//! Running a scene: an equilibrium or a motion in time, with records on the way.

mod bound;
mod dynamics;
mod equilibrium;
mod keep;
mod points;
mod recorder;
mod rest;
mod slip;
mod steps;
mod unknowns;

pub use dynamics::{Estimate, estimate};
pub(crate) use dynamics::{estimate_at, shears_softly};
pub use equilibrium::EquilibriumReport;
pub use keep::{Arrival, Keeper, Kept, MotionStanding, PathStanding, Standing, Unkept};
pub use rest::SaddlePush;
pub use slip::Slip;
pub use unknowns::newton as solver;

use crate::scene::{Problem, Task};
use crate::{Assembly, BeyondUse};
use actin_equilibrium::{Certificate, PathFailure};
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
    /// Whether the run broke off (a state exploded, twist was lost, a path ended early), ended on a
    /// saddle, or what it reached is of no use (a load is lost in it, neighbours have passed through
    /// each other).
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
    /// Counts of eigenvalues at the equilibrium in which a motion has come to rest; none of one that
    /// still moves, that is in a heat bath, or whose loads have no potential.
    pub at_rest: Option<Certificate>,
    /// How many saddles were left, on the whole path or in the whole motion.
    pub saddles_left: usize,
    /// How a motion was pushed off saddles.
    pub pushes: Vec<SaddlePush>,
    /// How often the path went on from where a sudden jump led.
    pub jumps: usize,
    /// What is beyond any use in its states, the worst of all records; a run with any has failed.
    pub beyond_use: Vec<BeyondUse>,
    /// Time that the run took (s).
    pub wall_s: f64,
}

impl RunReport {
    /// What the stiffness says of the state in which the run ended, if that is an equilibrium.
    pub fn certificate(&self) -> Option<&Certificate> {
        let of_equilibrium = self.equilibrium.as_ref().map(|e| &e.certificate);
        of_equilibrium.or(self.at_rest.as_ref())
    }

    /// The same with these counts.
    fn counting(self, steps: u64, force_evaluations: u64) -> Self {
        Self {
            steps,
            force_evaluations,
            ..self
        }
    }
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
    /// The run reached its end, but through or in states that are beyond any use.
    #[error("the result is beyond any use: {}{}", .worst[0], more(.worst.len() - 1))]
    BeyondUse {
        /// What goes too far, at least one.
        worst: Vec<BeyondUse>,
        /// All records.
        trajectory: Box<Trajectory>,
        /// What the run cost.
        report: Box<RunReport>,
    },
    /// The run ended, but on a saddle.
    #[error("{problem}")]
    Saddle {
        /// How many negative eigenvalues there are, and what leads off it.
        problem: Box<Problem>,
        /// All records.
        trajectory: Box<Trajectory>,
        /// Their cost.
        report: Box<RunReport>,
    },
    /// A filament lost twist.
    #[error("{place}{slip}")]
    Slipped {
        /// When, or in which stage, in words.
        place: String,
        /// Which filament and how much.
        slip: Box<Slip>,
        /// What was recorded up to the last good state.
        trajectory: Box<Trajectory>,
        /// Cost up to there.
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

impl RunError {
    /// What was recorded up to there, and its cost; none of a scene that was refused.
    pub fn into_results(self) -> Option<(Trajectory, RunReport)> {
        match self {
            Self::Refused(_) => None,
            Self::Ended {
                trajectory, report, ..
            }
            | Self::Lost {
                trajectory, report, ..
            }
            | Self::BeyondUse {
                trajectory, report, ..
            }
            | Self::Saddle {
                trajectory, report, ..
            }
            | Self::Slipped {
                trajectory, report, ..
            }
            | Self::Failed {
                trajectory, report, ..
            } => Some((*trajectory, *report)),
        }
    }

    fn saddle(problem: Problem, trajectory: Trajectory, report: RunReport) -> Self {
        Self::Saddle {
            problem: Box::new(problem),
            trajectory: Box::new(trajectory),
            report: Box::new(report),
        }
    }

    fn slipped((place, slip): (String, Slip), trajectory: Trajectory, report: RunReport) -> Self {
        Self::Slipped {
            place,
            slip: Box::new(slip),
            trajectory: Box::new(trajectory),
            report: Box::new(report),
        }
    }
}

/// Runs the scene of `assembly`; `watch` sees its progress and may break it off.
///
/// The assembly's scene afterwards holds the time step that was taken, and its system the last
/// state.
///
/// # Errors
/// What [`estimate`] refuses; a state that explodes, a path that ends early, twist that is lost, an
/// end on a saddle or in an equilibrium in which a load is lost, with all records up to the last good
/// one; states that are beyond any use.
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
    run_estimated(assembly, None, kept, keeper, watch)
}

/// The same with what [`estimate`] says of `assembly`, which a motion then does not ask again.
///
/// # Errors
/// As [`run`].
///
/// # Panics
/// As [`run_kept`].
pub fn run_estimated(
    assembly: &mut Assembly,
    estimate: Option<&Estimate>,
    kept: Option<Kept>,
    keeper: &mut dyn Keeper,
    watch: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Result<(Trajectory, RunReport), RunError> {
    let result = match assembly.scene.task.clone() {
        Task::Dynamics(dynamics) => {
            let asked = (&dynamics, estimate);
            dynamics::run(assembly, asked, kept, keeper, watch)
        }
        Task::Equilibrium(settings) => equilibrium::run(assembly, &settings, kept, keeper, watch),
    };
    look_for_use(assembly, result)
}

/// Adds to a report what is beyond any use in the records; a run that reached its end with any has
/// failed.
fn look_for_use(
    assembly: &Assembly,
    mut result: Result<(Trajectory, RunReport), RunError>,
) -> Result<(Trajectory, RunReport), RunError> {
    let (trajectory, report) = match &mut result {
        Ok((trajectory, report)) => (trajectory, report),
        Err(error) => match error.records_mut() {
            Some(records) => records,
            None => return result,
        },
    };
    let states = trajectory.records.iter().map(|record| &record.state);
    report.beyond_use = assembly.worst_beyond_use(states);
    match result {
        Ok((trajectory, mut report)) if !(report.beyond_use.is_empty() || report.interrupted) => {
            report.failed = true;
            Err(RunError::BeyondUse {
                worst: report.beyond_use.clone(),
                trajectory: Box::new(trajectory),
                report: Box::new(report),
            })
        }
        result => result,
    }
}

impl RunError {
    /// The records of a run that began, and its report.
    fn records_mut(&mut self) -> Option<(&mut Trajectory, &mut RunReport)> {
        match self {
            Self::Refused(_) => None,
            Self::Ended {
                trajectory, report, ..
            }
            | Self::Lost {
                trajectory, report, ..
            }
            | Self::BeyondUse {
                trajectory, report, ..
            }
            | Self::Saddle {
                trajectory, report, ..
            }
            | Self::Slipped {
                trajectory, report, ..
            }
            | Self::Failed {
                trajectory, report, ..
            } => Some((trajectory, report)),
        }
    }
}

/// That there are `others` of the same kind, in words.
fn more(others: usize) -> String {
    match others {
        0 => String::new(),
        others => format!(" (and {others} more)"),
    }
}

//! How a run ended, what it cost, and what went wrong.

use super::taken::Remarks;
use super::{EquilibriumReport, HingeSlip, SaddlePush, Slip};
use crate::notes::Note;
use crate::scene::SceneProblem;
use crate::trade::{ModelError, Scatter};
use crate::{BeyondRange, BeyondUse, LinkerEvent, UnstableTwist};
use actin_equilibrium::{Certificate, PathFailure, Residual};
use actin_integrate::RunFailure;
use serde::{Deserialize, Serialize};
use std::fmt;
use thiserror::Error;

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// The equilibrium was reached, or the stop rule was met.
    Converged,
    /// The time that was asked for has passed.
    Completed,
    /// The run broke off, and the record is the last good one; or what it reached is no result:
    /// see [`Failure`].
    Failed,
    /// The run was interrupted and can be resumed; the record is the last one made.
    Interrupted,
}

/// How a run ended and what it cost.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// How it ended.
    pub status: Status,
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
    /// Energy with which a motion began (pN nm); not of one whose cells are switched.
    pub begun_with_pn_nm: Option<f64>,
    /// The largest kinetic energy that a motion came to at a check (pN nm).
    pub largest_kinetic_pn_nm: f64,
    /// How many saddles were left, on the whole path or in the whole motion.
    pub saddles_left: usize,
    /// How a motion was pushed off saddles.
    pub pushes: Vec<SaddlePush>,
    /// What happened to linkers, in order.
    pub events: Vec<LinkerEvent>,
    /// How often the path went on from where a sudden jump led.
    pub jumps: usize,
    /// Where the model does not apply to its states, the worst of all records; a run with any has failed.
    pub beyond_use: Vec<BeyondUse>,
    /// Where rods leave the data behind their laws, the worst of all records; in a heat bath with how often.
    pub beyond_range: Vec<BeyondRange>,
    /// Where the force along a rod makes its twist unstable, the worst of all records; never in a heat bath.
    pub unstable_twist: Vec<UnstableTwist>,
    /// Notes of its plan.
    pub plan_notes: Vec<Note>,
    /// Why it failed, in words; empty unless it did.
    pub failure: String,
    /// Time that the run took, with building and planning (s).
    pub wall_s: f64,
}

impl Outcome {
    /// One of which nothing is known but how it ended and the time that it took (s).
    pub(crate) fn new(status: Status, wall_s: f64) -> Self {
        Self {
            status,
            steps: 0,
            force_evaluations: 0,
            time_step_ns: None,
            largest_frequency_rad_per_ns: None,
            equilibrium: None,
            at_rest: None,
            begun_with_pn_nm: None,
            largest_kinetic_pn_nm: 0.0,
            saddles_left: 0,
            pushes: Vec::new(),
            events: Vec::new(),
            jumps: 0,
            beyond_use: Vec::new(),
            beyond_range: Vec::new(),
            unstable_twist: Vec::new(),
            plan_notes: Vec::new(),
            failure: String::new(),
            wall_s,
        }
    }

    /// The same with what is wrong with the states of its records.
    pub(super) fn with(self, remarks: Remarks) -> Self {
        let Remarks {
            beyond_use,
            beyond_range,
            unstable_twist,
        } = remarks;
        Self {
            beyond_use,
            beyond_range,
            unstable_twist,
            ..self
        }
    }

    /// Whether the equilibrium was reached, or the stop rule of a motion was met.
    pub fn has_converged(&self) -> bool {
        self.status == Status::Converged
    }

    /// Force and torque that rounding leaves of an equilibrium, where it ended there.
    pub fn residual_floor(&self) -> Option<Residual> {
        self.equilibrium.as_ref()?.floor
    }

    /// The lowest eigenvalue of the stiffness at an equilibrium that is not neutral, where the scene asks for it.
    pub fn lowest_eigenvalue(&self) -> Option<f64> {
        self.equilibrium.as_ref()?.lowest_eigenvalue
    }

    /// The error of the number that the scene asked for it, where it is known.
    pub fn model_error(&self) -> Option<ModelError> {
        Some(self.equilibrium.as_ref()?.error.as_ref()?.as_ref().ok()?.0)
    }

    /// How filaments with drawn bonds scatter in that number, where it is known.
    pub fn scatter(&self) -> Option<Scatter> {
        Some(self.equilibrium.as_ref()?.error.as_ref()?.as_ref().ok()?.1)
    }

    /// What the stiffness says of the state in which the run ended, if that is an equilibrium.
    pub fn certificate(&self) -> Option<&Certificate> {
        let of_equilibrium = self.equilibrium.as_ref().map(|e| &e.certificate);
        of_equilibrium.or(self.at_rest.as_ref())
    }
}

/// Why a plan did not run to an end that is a result.
#[derive(Debug, Error)]
pub enum RunError {
    /// The scene asks for something that shows as wrong only now.
    #[error(transparent)]
    Refused(#[from] SceneProblem),
    /// The run began and failed.
    #[error("{}", .0.failure)]
    Failed(Box<FailedRun>),
}

/// A run that failed, of which the sink has all records up to the last good one.
#[derive(Debug)]
pub struct FailedRun {
    /// What went wrong.
    pub failure: Failure,
    /// What is known up to there, and its cost.
    pub outcome: Outcome,
}

/// What went wrong in a run.
#[derive(Debug)]
#[non_exhaustive]
pub enum Failure {
    /// The path of equilibria ended before its end.
    PathEnded {
        /// The stage that broke, in words; empty where there is no path.
        place: String,
        /// Where and why.
        failure: Box<PathFailure>,
        /// What the loads of the scene have to do with it; empty where nothing is known.
        hint: &'static str,
    },
    /// Equilibria were reached, but the last does not tell what a load does: which, and in what it is
    /// lost.
    LoadLost(SceneProblem),
    /// The run reached its end, but through or in states to which the model does not apply: what goes too far, at
    /// least one.
    BeyondUse(Vec<BeyondUse>),
    /// The run ended, but on a saddle: how many negative eigenvalues there are, and what leads off it.
    Saddle(SceneProblem),
    /// A filament lost twist.
    TwistLost {
        /// When, or in which stage, in words.
        place: String,
        /// Which filament and how much.
        slip: Slip,
    },
    /// The spring of a hinged end was turned past half a turn.
    HingeSlipped {
        /// When, or in which stage, in words.
        place: String,
        /// Which end.
        slip: HingeSlip,
    },
    /// The state exploded.
    Diverged {
        /// Where and when.
        failure: RunFailure,
        /// The body where it went wrong, in words.
        body: String,
    },
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::PathEnded {
                place,
                failure,
                hint,
            } => write!(f, "{place}{failure}{hint}"),
            Self::LoadLost(problem) | Self::Saddle(problem) => write!(f, "{problem}"),
            Self::BeyondUse(worst) => {
                write!(f, "the model does not apply to the result: {}", worst[0])?;
                match worst.len() - 1 {
                    0 => Ok(()),
                    others => write!(f, " (and {others} more)"),
                }
            }
            Self::TwistLost { place, slip } => write!(f, "{place}{slip}"),
            Self::HingeSlipped { place, slip } => write!(f, "{place}{slip}"),
            Self::Diverged { failure, body } => write!(f, "{failure}; {} is {body}", failure.body),
        }
    }
}

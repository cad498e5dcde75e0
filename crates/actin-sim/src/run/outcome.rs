//! Outcome of a run: status, cost, warnings and failures.

use super::slip::TurnLoss;
use super::states::StableStates;
use super::{HingeSlip, RunStatistics, SaddlePush, Slip, StepError};
use crate::scene::{Quantity, SceneProblem};
use crate::{Assembly, LawExtrapolation, LinkerEvent, ModelLimitExceeded, Record, UnstableTwist};
use actin_assembly::Note;
use actin_equilibrium::{Certificate, PathFailure, Residual};
use actin_integrate::RunFailure;
use serde::{Deserialize, Serialize};
use std::fmt;
use thiserror::Error;

/// Status at the end of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// The equilibrium or the stop rule was reached.
    Converged,
    /// The full duration has passed.
    Completed,
    /// The run stopped at an error, with the last good record, or its result is invalid; see
    /// [`Failure`].
    Failed,
    /// The run was interrupted and can be resumed from its last record.
    #[default]
    Interrupted,
}

/// Status and cost of a run.
#[derive(Clone, Debug, Default)]
pub struct Outcome {
    /// Status at the end.
    pub status: Status,
    /// Number of steps.
    pub steps: u64,
    /// Number of load evaluations.
    pub force_evaluations: u64,
    /// Time step (ns); `None` for an equilibrium.
    pub time_step_ns: Option<f64>,
    /// Largest frequency at the start (rad/ns); `None` for an equilibrium.
    pub largest_frequency_rad_per_ns: Option<f64>,
    /// Report of the equilibrium; `None` for a motion in time.
    pub equilibrium: Option<EquilibriumReport>,
    /// Eigenvalue counts at the equilibrium in which a motion came to rest. `None` if it still
    /// moves, in a heat bath, or for loads without a potential.
    pub at_rest: Option<Certificate>,
    /// Initial energy of a motion (pN nm); `None` if cells are switched.
    pub begun_with_pn_nm: Option<f64>,
    /// Largest kinetic energy at a check of a motion (pN nm).
    pub largest_kinetic_pn_nm: f64,
    /// Number of saddles that the path or the motion reached and moved away from.
    pub saddles_left: usize,
    /// Perturbations of a motion at saddles.
    pub pushes: Vec<SaddlePush>,
    /// Linker events in order.
    pub events: Vec<LinkerEvent>,
    /// Number of sudden jumps after which the path continued.
    pub jumps: usize,
    /// Exceeded model limits, largest over all records; if nonempty, the run has failed.
    pub beyond_use: Vec<ModelLimitExceeded>,
    /// Extrapolations of rod laws, largest over all records; in a heat bath with their frequency.
    pub beyond_range: Vec<LawExtrapolation>,
    /// Segments with unstable twist, worst over all records; empty in a heat bath.
    pub unstable_twist: Vec<UnstableTwist>,
    /// Terms whose mean energy differs in steps of half the length.
    pub step_errors: Vec<StepError>,
    /// Warnings of its plan.
    pub plan_notes: Vec<Note>,
    /// Message of the failure, or empty.
    pub failure: String,
    /// Run time including build and plan (s).
    pub wall_s: f64,
}

impl Outcome {
    /// Creates the outcome of a run without steps.
    pub fn new(status: Status, wall_s: f64) -> Self {
        Self {
            status,
            wall_s,
            ..Self::default()
        }
    }

    /// Adds the warnings about all records of the run.
    pub(super) fn with_statistics(self, assembly: &Assembly, all: RunStatistics) -> Self {
        Self {
            beyond_use: all.beyond_use,
            beyond_range: all.ranges.end(assembly),
            unstable_twist: all.twist.end(),
            step_errors: all.steps.errors(self.time_step_ns.unwrap_or_default()),
            ..self
        }
    }

    /// Returns `true` if the equilibrium or the stop rule of a motion was reached.
    pub fn has_converged(&self) -> bool {
        self.status == Status::Converged
    }

    /// Residual at round-off of an equilibrium that did not reach its tolerance.
    pub(crate) fn residual_floor(&self) -> Option<Residual> {
        self.equilibrium.as_ref()?.floor
    }

    /// Lowest nonzero eigenvalue of the stiffness at an equilibrium, if requested.
    pub(crate) fn lowest_eigenvalue(&self) -> Option<f64> {
        self.equilibrium.as_ref()?.lowest_eigenvalue
    }

    /// Model error of the requested quantity, if known.
    pub fn model_error(&self) -> Option<ModelError> {
        Some(self.equilibrium.as_ref()?.error.as_ref()?.as_ref().ok()?.0)
    }

    /// Scatter of filaments with sampled bonds in the requested quantity, if known.
    pub fn scatter(&self) -> Option<Scatter> {
        Some(self.equilibrium.as_ref()?.error.as_ref()?.as_ref().ok()?.1)
    }

    /// Certificate of the equilibrium in which the run ended, if any.
    pub fn certificate(&self) -> Option<&Certificate> {
        let of_equilibrium = self.equilibrium.as_ref().map(|e| &e.certificate);
        of_equilibrium.or(self.at_rest.as_ref())
    }
}

/// Certificate, cost and accuracy of an equilibrium.
#[derive(Clone, Debug, PartialEq)]
pub struct EquilibriumReport {
    /// Numbers of negative and unresolved eigenvalues of the stiffness.
    pub certificate: Certificate,
    /// Lowest nonzero eigenvalue of the stiffness (pN/nm; rotations count as displacements at 1
    /// nm), if requested.
    pub lowest_eigenvalue: Option<f64>,
    /// Newton steps on the whole path.
    pub newton_iterations: u64,
    /// Number of equilibria on the path.
    pub points: usize,
    /// Residual force (pN) and torque (pN nm) at round-off, if the last equilibrium did not reach
    /// its tolerance.
    pub floor: Option<Residual>,
    /// Residual force (pN) and torque (pN nm) before each Newton step of the last equilibrium.
    pub history: Vec<Residual>,
    /// Stable states near the equilibrium, if requested.
    pub states: Option<StableStates>,
    /// Model error and scatter of the requested quantity, or the reason for their absence.
    pub error: Option<ModelErrorResult>,
}

/// Model error and scatter of a quantity, or the reason for their absence.
pub(crate) type ModelErrorResult = Result<(ModelError, Scatter), SceneProblem>;

/// Measurement of the model error of a quantity in the last record of an equilibrium.
pub(crate) type MeasureModelError = fn(&Assembly, &Record, Quantity) -> ModelErrorResult;

/// Error of a quantity of an equilibrium against every monomer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModelError {
    /// Quantity with this error.
    pub quantity: Quantity,
    /// Value in the [unit](Quantity::unit) of the quantity; the size of a vector.
    pub value: f64,
    /// Correction in the same unit: the value with every monomer minus `value`.
    pub error: f64,
    /// Size of the difference divided by the size with every monomer. The difference of vectors includes their direction.
    pub relative: f64,
}

impl ModelError {
    pub(crate) fn note(&self, scatter: &Scatter) -> String {
        let size = self.corrected().abs().max(f64::MIN_POSITIVE);
        format!(
            "{} is {}, and {} in the all-monomer model (error {:.2} %); filaments with {} sampled bonds per interface differ \
             from the all-monomer model by {:+.2} % on average, with a root mean square difference of {:.2} %",
            self.quantity,
            self.quantity.show(self.value),
            self.quantity.show(self.corrected()),
            100.0 * self.relative,
            scatter.bonds,
            100.0 * scatter.shift / size,
            100.0 * scatter.deviation / size
        )
    }

    /// Returns the value with every monomer.
    fn corrected(&self) -> f64 {
        self.value + self.error
    }
}

/// Scatter of a quantity between filaments with sampled bonds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scatter {
    /// Sampled bonds per interface.
    pub bonds: usize,
    /// Number of filaments.
    pub filaments: u64,
    /// Mean over the filaments minus the value with quadrature bonds, in the unit of the quantity.
    pub shift: f64,
    /// Root mean square difference from the value with quadrature bonds, in the same unit. The difference of vectors
    /// includes their direction.
    pub deviation: f64,
}

/// Error of a run without a valid result.
#[derive(Debug, Error)]
pub enum RunError {
    /// The scene is invalid in a way that shows only at the run.
    #[error(transparent)]
    Refused(#[from] SceneProblem),
    /// The run started and failed.
    #[error("{}", .0.failure)]
    Failed(Box<FailedRun>),
}

/// Failed run. The sink has all records up to the last good one.
#[derive(Debug)]
pub struct FailedRun {
    /// Cause of the failure.
    pub failure: Failure,
    /// Outcome and cost up to the failure.
    pub outcome: Outcome,
}

/// Failure of a run.
#[derive(Debug)]
#[non_exhaustive]
pub enum Failure {
    /// The path of equilibria ended early.
    PathEnded {
        /// Failed stage; empty without a path.
        place: String,
        /// Place and cause.
        failure: Box<PathFailure>,
        /// Hint from the loads of the scene, or empty.
        hint: &'static str,
    },
    /// A load of the last equilibrium is below its residual.
    LoadBelowResidual(SceneProblem),
    /// States exceed the validity of the model; at least one entry.
    ModelLimitExceeded(Vec<ModelLimitExceeded>),
    /// The run ended on a saddle.
    Saddle(SceneProblem),
    /// A filament lost twist.
    TwistLost {
        /// Time or stage.
        place: String,
        /// Filament and lost turns.
        slip: Slip,
    },
    /// The spring of a hinged end was turned past half a turn.
    HingeSlipped {
        /// Time or stage.
        place: String,
        /// Hinged end and angle.
        slip: HingeSlip,
    },
    /// The state diverged.
    Diverged {
        /// Place and time.
        failure: RunFailure,
        /// Description of the body.
        body: String,
    },
}

impl Failure {
    pub(super) fn from_turn_loss(loss: TurnLoss, place: String) -> Self {
        match loss {
            TurnLoss::Twist(slip) => Self::TwistLost { place, slip },
            TurnLoss::Hinge(slip) => Self::HingeSlipped { place, slip },
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::PathEnded {
                place,
                failure,
                hint,
            } => write!(f, "{place}{failure}{hint}"),
            Self::LoadBelowResidual(problem) | Self::Saddle(problem) => write!(f, "{problem}"),
            Self::ModelLimitExceeded(worst) => {
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

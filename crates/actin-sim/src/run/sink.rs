//! Output of a run: records, progress and checkpoints.

use super::{Record, RecordSummary, SaddlePush, Trajectory};
use crate::At;
use crate::LinkerEvent;
use actin_equilibrium::{Certificate, PathCheckpoint, SolverWork};
use actin_integrate::Checkpoint;
use actin_mechanics::{Motion, Residual, State};
use serde::{Deserialize, Serialize};
use std::time::Instant;

/// Receiver of the output of a run: memory ([`Trajectory`]), a run directory (`Checkpoints` of
/// `actin-rundir`), or a user type.
///
/// Queries are made at every check of a motion (at least every hundred steps), at every Newton step
/// and at every equilibrium of a path. They should be cheap.
pub trait Sink {
    /// Receives the next record.
    fn record(&mut self, record: &Record);

    /// Receives the progress of the run after each record.
    fn progress(&mut self, _progress: &Progress) {}

    /// Returns `true` to stop the run as soon as possible, for a later resume.
    fn is_interrupted(&mut self) -> bool {
        false
    }

    /// Returns `true` to leave the motion in this state, as if interrupted. Queried every hundred
    /// steps, and at every step of overdamped motion, at step numbers that do not depend on
    /// interruptions.
    fn is_left(&mut self, _step: u64, _state: &State) -> bool {
        false
    }

    /// Returns `true` if a checkpoint is due.
    fn is_checkpoint_due(&mut self) -> bool {
        false
    }

    /// Keeps a checkpoint: position of the run, summary of the records before it, and run time (s).
    /// The sink may already have later records.
    ///
    /// Called when a checkpoint is due, and when the run is interrupted, fails or ends. Errors must
    /// be reported by the sink; the run continues.
    fn checkpoint(&mut self, _position: &RunPosition, _recorded: &RecordSummary, _wall_s: f64) {}
}

impl Sink for Trajectory {
    fn record(&mut self, record: &Record) {
        self.records.push(record.clone());
    }
}

/// Records in memory of a run that a query on the records can interrupt.
pub(crate) struct InterruptibleTrajectory<F> {
    pub(crate) trajectory: Trajectory,
    pub(crate) is_interrupted: F,
}

impl<F: FnMut(&[Record]) -> bool> InterruptibleTrajectory<F> {
    pub(crate) fn new(is_interrupted: F) -> Self {
        Self {
            trajectory: Trajectory::default(),
            is_interrupted,
        }
    }
}

impl<F: FnMut(&[Record]) -> bool> Sink for InterruptibleTrajectory<F> {
    fn record(&mut self, record: &Record) {
        self.trajectory.record(record);
    }

    fn is_interrupted(&mut self) -> bool {
        (self.is_interrupted)(&self.trajectory.records)
    }
}

/// Progress of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Time or path parameter.
    pub at: At,
    /// Final time (ns), or number of stages.
    pub end: f64,
    /// Number of steps.
    pub steps: u64,
    /// Largest force on a free point (pN).
    pub residual_force_pn: f64,
}

/// Position of a run: everything the remaining run depends on besides its scene and records.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum RunPosition {
    /// Motion in time, at a check of its state.
    Motion(Box<MotionPosition>),
    /// Path of equilibria, at an equilibrium.
    Path(Box<PathPosition>),
}

impl RunPosition {
    /// Returns `true` if the numbers of bodies and controls equal the numbers in `state`.
    pub fn fits(&self, state: &State) -> bool {
        match self {
            Self::Motion(position) => {
                let Checkpoint {
                    here, last_good, ..
                } = &position.checkpoint;
                here.motion.fits(state) && last_good.motion.fits(state)
            }
            Self::Path(position) => {
                let waypoint = position.waypoint.as_ref();
                let previous = waypoint.and_then(|waypoint| waypoint.previous.as_ref());
                position.motion.fits(state) && previous.is_none_or(|(motion, _)| motion.fits(state))
            }
        }
    }
}

/// Position of a motion in time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MotionPosition {
    /// State of the integrator.
    pub checkpoint: Checkpoint,
    /// Perturbations at saddles so far.
    pub pushes: Vec<SaddlePush>,
    /// Linker events so far.
    pub events: Vec<LinkerEvent>,
    /// Start of the motion, if it continues after a switch of cells.
    pub behind_switch: Option<ResolutionSwitch>,
}

/// Start of a motion that continues after a switch of cells.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ResolutionSwitch {
    /// Steps before the switch.
    pub step: u64,
    /// Energy after the switch (pN nm).
    pub energy_pn_nm: f64,
}

/// Position on a path of equilibria.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PathPosition {
    /// Index of the stage.
    pub stage: usize,
    /// Position in the stage; `None` before its first equilibrium.
    pub waypoint: Option<PathCheckpoint>,
    /// Bodies and controls at this position.
    pub motion: Motion,
    /// Equilibria so far.
    pub points: usize,
    /// Saddles left so far.
    pub saddles_left: usize,
    /// Sudden jumps so far after which the path continued.
    pub jumps: usize,
    /// Report of the last equilibrium.
    pub last: Option<SolveReport>,
    /// Work of the solver so far.
    pub work: SolverWork,
}

/// Solver results of an equilibrium.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SolveReport {
    /// Eigenvalue counts.
    pub certificate: Option<Certificate>,
    /// Residual force (pN) and torque (pN nm) at round-off, if the tolerance was not reached.
    pub floor: Option<Residual>,
    /// Residual force (pN) and torque (pN nm) before each Newton step.
    pub history: Vec<Residual>,
}

/// Saved state of an interrupted run.
#[derive(Clone, Debug)]
pub struct SavedRun {
    /// Position of the run.
    pub position: RunPosition,
    /// Summary of the records up to the position.
    pub recorded: RecordSummary,
    /// Run time so far (s).
    pub wall_s: f64,
}

/// Run time over all parts of a run, including build and plan of each.
#[derive(Clone, Copy, Debug)]
pub(super) struct Clock {
    started: Instant,
    earlier_s: f64,
}

impl Clock {
    pub(super) fn new(saved: Option<&SavedRun>, set_up_s: f64) -> Self {
        Self {
            started: Instant::now(),
            earlier_s: set_up_s + saved.map_or(0.0, |saved| saved.wall_s),
        }
    }

    pub(super) fn wall_s(&self) -> f64 {
        self.earlier_s + self.started.elapsed().as_secs_f64()
    }
}

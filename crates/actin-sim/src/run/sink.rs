//! What a run tells as it goes on, and to whom: records, progress and checkpoints.
//!
//! What goes through a sink is values; files are the business of `results`.

use super::{At, Record, Recorded, SaddlePush, Trajectory};
use crate::LinkerEvent;
use actin_equilibrium::{Certificate, PathCheckpoint, SolverWork};
use actin_integrate::Checkpoint;
use actin_mechanics::{Motion, Residual, State};
use serde::{Deserialize, Serialize};
use std::time::Instant;

/// Takes what a run gives: memory ([`Trajectory`]), a run directory ([`Checkpoints`](crate::Checkpoints)),
/// or anything else.
///
/// The questions are asked at every check of a motion (at least every hundred steps), at every Newton
/// step and at every equilibrium of a path, so their answers are to be cheap.
pub trait Sink {
    /// Takes a record; they come in order.
    fn record(&mut self, record: &Record);

    /// Takes note of how far the run has come, after each record.
    fn progress(&mut self, _progress: &Progress) {}

    /// Whether the run is to stop as soon as it can, to be resumed.
    fn is_interrupted(&mut self) -> bool {
        false
    }

    /// Whether the motion is to be left in this state, after so many steps: asked at every hundredth step, at each of overdamped
    /// motion, at step numbers that do not depend on interruptions. It is then as if interrupted.
    fn is_left(&mut self, _step: u64, _state: &State) -> bool {
        false
    }

    /// Whether a checkpoint is due.
    fn is_checkpoint_due(&mut self) -> bool {
        false
    }

    /// Keeps a checkpoint: where the run stands, what it remembers of the records before that, of which the
    /// sink may have more, and the time it has taken (s). Called when one is due, when the run is interrupted, when it fails and when it
    /// has ended, before results are written.
    ///
    /// A sink that cannot keep it has to say so itself: the run goes on all the same.
    fn checkpoint(&mut self, _position: &RunPosition, _recorded: &Recorded, _wall_s: f64) {}
}

impl Sink for Trajectory {
    fn record(&mut self, record: &Record) {
        self.records.push(record.clone());
    }
}

/// How far a run has come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// When, or where on the path.
    pub at: At,
    /// Time at which it ends (ns), or the number of stages.
    pub end: f64,
    /// Steps taken.
    pub steps: u64,
    /// Largest force on a free point (pN).
    pub residual_force_pn: f64,
}

/// Where a run stands: all that its rest depends on besides its scene and its records.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum RunPosition {
    /// A motion in time, at a check of its state.
    Motion(Box<MotionPosition>),
    /// A path of equilibria, at one of them.
    Path(Box<PathPosition>),
}

impl RunPosition {
    /// Whether it is one of a run with as many bodies and controls as `state` has.
    pub(crate) fn fits(&self, state: &State) -> bool {
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

/// Where a motion in time stands.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MotionPosition {
    /// What the integrator carries.
    pub checkpoint: Checkpoint,
    /// How it was pushed off saddles so far.
    pub pushes: Vec<SaddlePush>,
    /// What happened to linkers so far.
    pub events: Vec<LinkerEvent>,
    /// Where it began, where it goes on behind a switch of cells.
    pub behind_switch: Option<BehindSwitch>,
}

/// Where a motion began that goes on behind a switch of cells.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BehindSwitch {
    /// Steps up to there.
    pub step: u64,
    /// Its energy there (pN nm).
    pub energy_pn_nm: f64,
}

/// Where a path of equilibria stands.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PathPosition {
    /// The stage, from 0.
    pub stage: usize,
    /// Where the path stands in that stage; `None` before its first equilibrium.
    pub waypoint: Option<PathCheckpoint>,
    /// What moves, as it is there.
    pub motion: Motion,
    /// Equilibria so far.
    pub points: usize,
    /// Saddles left so far.
    pub saddles_left: usize,
    /// Sudden jumps so far, from where they led the path went on.
    pub jumps: usize,
    /// What is known of the last of them.
    pub last: Option<Arrival>,
    /// What the solver has done so far.
    pub work: SolverWork,
}

/// What a report says of an equilibrium.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Arrival {
    /// Counts of eigenvalues.
    pub certificate: Option<Certificate>,
    /// Force (pN) and torque (pN nm) that rounding leaves, if it ended there and not within its tolerance.
    pub floor: Option<Residual>,
    /// Residual force (pN) and torque (pN nm) before each Newton step.
    pub history: Vec<Residual>,
}

/// An interrupted run.
#[derive(Clone, Debug)]
pub struct Saved {
    /// Where it stands.
    pub position: RunPosition,
    /// What it remembers of the records up to there.
    pub recorded: Recorded,
    /// Time that it had taken (s).
    pub wall_s: f64,
}

/// Time that a run has taken in all its parts, with building and planning of each.
#[derive(Clone, Copy, Debug)]
pub(super) struct Clock {
    started: Instant,
    earlier_s: f64,
}

impl Clock {
    /// A clock of a run that took `set_up_s` (s) to build and plan.
    pub(super) fn new(saved: Option<&Saved>, set_up_s: f64) -> Self {
        Self {
            started: Instant::now(),
            earlier_s: set_up_s + saved.map_or(0.0, |saved| saved.wall_s),
        }
    }

    pub(super) fn wall_s(&self) -> f64 {
        self.earlier_s + self.started.elapsed().as_secs_f64()
    }
}

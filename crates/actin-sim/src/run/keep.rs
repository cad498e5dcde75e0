//! Leaving a run and taking it up again: what it carries, and who keeps it.
//!
//! What is kept is values; files are the business of `results`.

use super::{Record, SaddlePush, Trajectory};
use actin_equilibrium::{Certificate, Waypoint, Work};
use actin_integrate::Checkpoint;
use actin_mechanics::State;
use std::time::Instant;

/// Where a run stands: all that its rest depends on besides its scene and its records.
#[derive(Clone, Debug, PartialEq)]
pub enum Standing {
    /// A motion in time, at a check of its state.
    Motion(Box<MotionStanding>),
    /// A path of equilibria, at one of them.
    Path(Box<PathStanding>),
}

/// Where a motion in time stands.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionStanding {
    /// What the integrator carries.
    pub checkpoint: Checkpoint,
    /// How it was pushed off saddles so far.
    pub pushes: Vec<SaddlePush>,
}

/// Where a path of equilibria stands.
#[derive(Clone, Debug, PartialEq)]
pub struct PathStanding {
    /// The stage, from 0.
    pub stage: usize,
    /// Where the path stands in that stage; `None` before its first equilibrium.
    pub waypoint: Option<Waypoint>,
    /// The state there.
    pub state: State,
    /// Equilibria so far.
    pub points: usize,
    /// Saddles left so far.
    pub saddles_left: usize,
    /// Sudden jumps so far, from where they led the path went on.
    pub jumps: usize,
    /// What is known of the last of them.
    pub last: Option<Arrival>,
    /// What the solver has done so far.
    pub work: Work,
}

/// What a report says of an equilibrium.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrival {
    /// Counts of eigenvalues.
    pub certificate: Option<Certificate>,
    /// Force (pN) and torque (pN nm) that rounding leaves, if it ended there and not within its tolerance.
    pub floor: Option<(f64, f64)>,
    /// Residual force (pN) and torque (pN nm) before each Newton step.
    pub history: Vec<(f64, f64)>,
}

/// A run that was left.
#[derive(Clone, Debug)]
pub struct Kept {
    /// Where it stands.
    pub standing: Standing,
    /// What it had recorded.
    pub trajectory: Trajectory,
    /// Time that it had taken (s).
    pub wall_s: f64,
}

/// Someone who keeps a run while it goes on.
///
/// Asked at every check of a motion (at least every hundred steps), at every Newton step and at
/// every equilibrium of a path, so both questions are to be cheap.
pub trait Keeper {
    /// Whether the run is to be left as soon as it can.
    fn is_interrupted(&mut self) -> bool;

    /// Whether the run is to be kept now, while it goes on.
    fn is_due(&mut self) -> bool;

    /// Keeps the run as it stands, with all records made so far and the time it has taken (s): when it
    /// is due, when the run is left, when it fails and when it has ended, before anybody writes results.
    ///
    /// Whoever cannot says so elsewhere: a run goes on all the same.
    fn keep(&mut self, standing: &Standing, records: &[Record], wall_s: f64);
}

/// Nobody: keeps nothing and never interrupts.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unkept;

impl Keeper for Unkept {
    fn is_interrupted(&mut self) -> bool {
        false
    }

    fn is_due(&mut self) -> bool {
        false
    }

    fn keep(&mut self, _standing: &Standing, _records: &[Record], _wall_s: f64) {}
}

/// Time that a run has taken, in all its parts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Clock {
    started: Instant,
    earlier_s: f64,
}

impl Clock {
    pub(super) fn new(kept: Option<&Kept>) -> Self {
        Self {
            started: Instant::now(),
            earlier_s: kept.map_or(0.0, |kept| kept.wall_s),
        }
    }

    pub(super) fn wall_s(&self) -> f64 {
        self.earlier_s + self.started.elapsed().as_secs_f64()
    }
}

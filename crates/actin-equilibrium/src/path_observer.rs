//! Observers and checkpoints of paths.

use crate::history::{Iteration, SolverWork};
use crate::motion::StepSize;
use crate::outcome::Equilibrium;
use crate::path_options::PathOptions;
use actin_mechanics::{Motion, State};
use std::ops::ControlFlow;

/// Equilibrium on a path.
#[derive(Clone, Copy, Debug)]
pub struct PathPoint<'a> {
    /// Path parameter, from 0 to 1.
    pub parameter: f64,
    /// State.
    pub state: &'a State,
    /// Properties of the equilibrium.
    pub equilibrium: &'a Equilibrium,
    /// Motion of free bodies since the last point.
    pub moved: StepSize,
    /// The point is farther from the last one than the options allow, or deviates from the
    /// prediction, even with the smallest step. It may lie on another branch.
    pub jumped: bool,
    /// Cost so far.
    pub work: SolverWork,
    /// Checkpoint of the path.
    pub waypoint: &'a PathCheckpoint,
}

/// Observer of a path, which may interrupt it. Implemented for closures that take a point.
pub trait PathObserver {
    /// Called at every equilibrium; [`ControlFlow::Break`] ends the path there.
    fn arrive(&mut self, point: &PathPoint<'_>) -> ControlFlow<()>;

    /// Called at every Newton step; [`ControlFlow::Break`] discards the next equilibrium and ends
    /// the path at the last one.
    fn iterate(&mut self, _step: &Iteration) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

impl<F: FnMut(&PathPoint<'_>) -> ControlFlow<()>> PathObserver for F {
    fn arrive(&mut self, point: &PathPoint<'_>) -> ControlFlow<()> {
        self(point)
    }
}

/// Sudden motion between the last equilibrium of a path and a parameter ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Snap {
    /// Parameter at the end of the refused step.
    pub parameter: f64,
    /// Motion up to that parameter (rad, or strain).
    pub motion: f64,
    /// A longer step across it was neither too large nor too sudden. The path may then cross it by a jump.
    pub is_small: bool,
}

/// Checkpoint of a path: with the state, it determines the rest of the path.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PathCheckpoint {
    /// Path parameter.
    pub parameter: f64,
    /// Next step of the parameter.
    pub step: f64,
    /// Previous equilibrium and its parameter, unless the last step was a jump.
    pub previous: Option<(Motion, f64)>,
    /// Motion per parameter in the last step, unless it was a jump.
    pub rate: Option<f64>,
    /// Snap ahead, which steps approach by halves.
    pub snap: Option<Snap>,
    /// Number of equilibria so far.
    pub points: usize,
    /// Number of rejected steps, each repeated with a smaller step.
    pub refused: usize,
}

impl PathCheckpoint {
    pub(crate) fn start(options: &PathOptions) -> Self {
        Self {
            parameter: 0.0,
            step: options.first_step,
            previous: None,
            rate: None,
            snap: None,
            points: 0,
            refused: 0,
        }
    }
}

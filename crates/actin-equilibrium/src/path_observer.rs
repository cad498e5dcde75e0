//! What is seen of a path of equilibria, and where it can be left and taken up again.

use crate::history::{Iteration, SolverWork};
use crate::motion::StepSize;
use crate::outcome::Equilibrium;
use crate::path_options::PathOptions;
use actin_mechanics::{Motion, State};
use std::ops::ControlFlow;

/// An equilibrium on a path.
#[derive(Clone, Copy, Debug)]
pub struct PathPoint<'a> {
    /// The path parameter, from 0 to 1.
    pub parameter: f64,
    /// The state.
    pub state: &'a State,
    /// What is known of it.
    pub equilibrium: &'a Equilibrium,
    /// How far free bodies have gone since the last point.
    pub moved: StepSize,
    /// Whether the point is further from the last one than the options allow, or elsewhere than the path
    /// predicts, even after the smallest step: it may lie on another branch.
    pub jumped: bool,
    /// What the solver has done so far.
    pub work: SolverWork,
    /// What the rest of the path depends on besides the state.
    pub waypoint: &'a PathCheckpoint,
}

/// Observes a path of equilibria, and may end it.
///
/// Implemented by every closure that looks at the points.
pub trait PathObserver {
    /// Sees an equilibrium; [`ControlFlow::Break`] ends the path there.
    fn arrive(&mut self, point: &PathPoint<'_>) -> ControlFlow<()>;

    /// Sees a Newton step on the way to the next equilibrium; [`ControlFlow::Break`] gives that one
    /// up and ends the path at the last.
    fn iterate(&mut self, _step: &Iteration) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

impl<F: FnMut(&PathPoint<'_>) -> ControlFlow<()>> PathObserver for F {
    fn arrive(&mut self, point: &PathPoint<'_>) -> ControlFlow<()> {
        self(point)
    }
}

/// Where a path stands at an equilibrium: all that its rest depends on besides the state.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PathCheckpoint {
    /// The path parameter.
    pub parameter: f64,
    /// The next step of the parameter.
    pub step: f64,
    /// The equilibrium before, with its parameter, if the path came here without a jump.
    pub previous: Option<(Motion, f64)>,
    /// Motion per parameter in the last step, if there was one without a jump.
    pub rate: Option<f64>,
    /// Equilibria so far, this one included.
    pub points: usize,
    /// Steps that were tried and made again with a smaller one.
    pub refused: usize,
}

impl PathCheckpoint {
    /// Before the first equilibrium.
    pub(crate) fn start(options: &PathOptions) -> Self {
        Self {
            parameter: 0.0,
            step: options.first_step,
            previous: None,
            rate: None,
            points: 0,
            refused: 0,
        }
    }
}

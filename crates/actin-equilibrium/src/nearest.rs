//! The equilibrium next to a state that is nearly at rest, be it a minimum or a saddle.

use crate::certificate::Certificate;
use crate::direction::Solver;
use crate::evaluation::Evaluation;
use crate::newton::{NEAR_FLOOR, Newton, STILL_FALLING};
use crate::outcome::SolveError;
use actin_mechanics::{Interaction, State};

/// Most steps: next to an equilibrium each step squares what is left of the distance.
const STEPS: usize = 8;
/// A step that turns a body by more than this (rad), or moves one by more than this share of the size of
/// everything, does not lead to something near.
const FARTHEST: f64 = 0.5;
/// What is added to the stiffness, in roundings of its largest eigenvalue: enough to keep a step
/// along directions without stiffness short, far too little to slow the others down.
const SHIFT: f64 = 1e3;

/// The largest distance between points along an axis (nm).
fn size(state: &State) -> f64 {
    let position = &state.points.position;
    let span = |values: &[f64]| {
        let largest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let smallest = values.iter().copied().fold(f64::INFINITY, f64::min);
        largest - smallest
    };
    [&position.x, &position.y, &position.z]
        .into_iter()
        .map(|values| span(values))
        .fold(0.0, f64::max)
}

/// An equilibrium next to a state.
#[derive(Clone, Debug, PartialEq)]
pub struct Nearest {
    /// The equilibrium; velocities are those of the state that was asked about.
    pub state: State,
    /// Potential energy of that state less that of the equilibrium (pN nm): negative where it is on
    /// its way down from a saddle.
    pub energy_above: f64,
    /// What the stiffness says at the equilibrium.
    pub certificate: Certificate,
}

impl Newton {
    /// The equilibrium next to `state`, by at most eight plain steps of Newton's method; `None` if
    /// they do not reach one.
    ///
    /// [`solve`](Newton::solve) goes downhill to a minimum. Plain steps lead to the nearest stationary
    /// point of the energy, be it a minimum or a saddle: the one in which a motion has come to rest.
    /// They go on until the residual no longer falls.
    ///
    /// # Errors
    /// If an interaction has no potential or no second derivatives.
    pub fn nearest(
        &mut self,
        state: &State,
        interactions: &[Box<dyn Interaction>],
    ) -> Result<Option<Nearest>, SolveError> {
        Solver::check(interactions)?;
        let start = Evaluation::new(interactions, state);
        let Some(state) = self.reach(state, start.clone(), interactions) else {
            return Ok(None);
        };
        Ok(Some(Nearest {
            energy_above: start.energy_above(&Evaluation::new(interactions, &state)),
            certificate: self.certify(&state, interactions)?,
            state,
        }))
    }

    /// The state of least residual to which plain steps lead from `state`, whose evaluation is `here`,
    /// if its residual is within the tolerance or what rounding leaves.
    fn reach(
        &mut self,
        state: &State,
        mut here: Evaluation,
        interactions: &[Box<dyn Interaction>],
    ) -> Option<State> {
        let tolerance = self.options().tolerance;
        let size = size(state).max(self.options().turn_length);
        let mut there = state.clone();
        let mut best: Option<(f64, State)> = None;
        for _ in 0..=STEPS {
            self.solver.work.evaluations += 1;
            if !here.is_finite() {
                break;
            }
            self.solver.assemble(interactions, &there, &here.loads);
            let (residual, _) = self.solver.residual_and_floor(&there);
            let is_reached =
                residual.is_within(&tolerance) || self.solver.is_at_floor(&tolerance, NEAR_FLOOR);
            let residual = residual.relative_to(&tolerance);
            // A residual within the tolerance would still pass for the sign of a neutral mode.
            let falls = best
                .as_ref()
                .is_none_or(|(least, _)| residual < STILL_FALLING * least);
            match (is_reached, falls) {
                (true, true) => best = Some((residual, there.clone())),
                (false, true) if best.is_none() => {}
                _ => break,
            }
            let step = self.undamped_step();
            let extent = self.layout().step_extent(&step);
            // Written so that a step that is not a number leads nowhere.
            if !(extent.rotation <= FARTHEST && extent.displacement <= FARTHEST * size) {
                break;
            }
            let before = there.clone();
            self.layout().apply(&mut there, &step, 1.0);
            here.follow(interactions, (&before, &there));
        }
        best.map(|(_, state)| state)
    }

    /// The step to where the loads of the last assembly vanish, to first order.
    fn undamped_step(&mut self) -> Vec<f64> {
        let shift = SHIFT * f64::EPSILON * self.solver.largest_in_metric();
        self.solver.factorize(shift);
        self.solver.plain_step()
    }
}

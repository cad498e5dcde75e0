//! Nearest equilibrium, minimum or saddle.

use crate::certificate::Certificate;
use crate::direction::Solver;
use crate::evaluation::Evaluation;
use crate::newton::{NEAR_FLOOR, Newton, STILL_FALLING};
use crate::outcome::SolveError;
use actin_mechanics::{Interaction, State};

const STEPS: usize = 8;
/// Maximum rotation (rad), or relative displacement, of a step.
const FARTHEST: f64 = 0.5;
/// Shift in roundings of the largest eigenvalue. It limits steps along directions without
/// stiffness.
const SHIFT: f64 = 1e3;

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

/// Equilibrium near a state.
#[derive(Clone, Debug, PartialEq)]
pub struct Nearest {
    /// Equilibrium, with the velocities of the given state.
    pub state: State,
    /// Energy of the given state minus energy of the equilibrium (pN nm). Negative if the
    /// equilibrium is a saddle above the given state.
    pub energy_above: f64,
    /// Certificate of the equilibrium.
    pub certificate: Certificate,
}

impl Newton {
    /// Nearest equilibrium of `state`, minimum or saddle, by at most eight undamped Newton steps;
    /// `None` if they do not converge.
    ///
    /// Steps continue until the residual no longer decreases.
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

    /// State of smallest residual, if within the tolerance or rounding.
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
            // The remaining residual could determine the sign of a neutral mode.
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
            if !(extent.rotation <= FARTHEST && extent.displacement <= FARTHEST * size) {
                break;
            }
            let before = there.clone();
            self.layout().apply(&mut there, &step, 1.0);
            here.follow(interactions, (&before, &there));
        }
        best.map(|(_, state)| state)
    }

    fn undamped_step(&mut self) -> Vec<f64> {
        let shift = SHIFT * f64::EPSILON * self.solver.largest_in_metric();
        self.solver.factorize(shift);
        self.solver.plain_step()
    }
}

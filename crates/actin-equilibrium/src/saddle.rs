//! The way off a saddle: along the direction of negative curvature, downhill, and on.

use crate::evaluation::Evaluation;
use crate::history::Iteration;
use crate::mode::{self, Mode};
use crate::motion::StepSize;
use crate::newton::Newton;
use crate::outcome::{Equilibrium, NewtonFailure, SolveError};
use actin_mechanics::{Interaction, State};
use std::ops::ControlFlow;

/// Size (nm and rad) of the first displacement off a saddle.
const FIRST: f64 = 1e-3;
/// Largest extent (rad, or nm per turn length) to which the displacement is doubled.
const LAST: f64 = 0.2;

/// A push off a saddle.
#[derive(Clone, Debug, PartialEq)]
pub struct Push {
    /// The mode along which it went.
    pub mode: Mode,
    /// How far bodies were moved and turned at most; strains are not looked at.
    pub extent: StepSize,
}

impl Newton {
    /// The lowest eigenvalue of the stiffness at `state` and its shape; `None` if nothing moves.
    ///
    /// # Errors
    /// If an interaction has no potential or no second derivatives.
    pub fn lowest_mode(
        &mut self,
        state: &State,
        interactions: &[Box<dyn Interaction>],
    ) -> Result<Option<Mode>, SolveError> {
        self.solver.prepare(state, interactions)?;
        mode::lowest(&mut self.solver)
    }

    /// Moves `state` off a saddle: along the lowest mode to the side where the energy is lower,
    /// as far as it keeps falling by doubling, at most to turns of 0.2 rad.
    ///
    /// Returns the mode, or `None`, with `state` as it was, if the lowest eigenvalue is not
    /// negative beyond its error. The sign of a mode is arbitrary: where both sides are alike it
    /// decides the branch, always in the same way for the same input. To choose a branch,
    /// displace the state and solve again.
    ///
    /// # Errors
    /// If an interaction has no potential or no second derivatives.
    pub fn leave_saddle(
        &mut self,
        state: &mut State,
        interactions: &[Box<dyn Interaction>],
    ) -> Result<Option<Mode>, SolveError> {
        let Some(mode) = self.unstable_mode(state, interactions)? else {
            return Ok(None);
        };
        let extent = self.layout().step_extent(&mode.shape);
        let unit = 1.0 / largest(&extent, self.options().turn_length);
        let ridge = Ridge::new(state, interactions, &mode);
        let (side, (mut best, mut moved)) = ridge.lower_side(self, FIRST * unit);
        let mut amplitude = 2.0 * FIRST;
        while amplitude <= LAST {
            let (energy, further) = ridge.at(self, amplitude * unit * side);
            if energy.is_nan() || energy >= best {
                break;
            }
            (best, moved) = (energy, further);
            amplitude *= 2.0;
        }
        *state = moved;
        Ok(Some(mode))
    }

    /// Moves `state` off a saddle by a small amount: along the lowest mode to the side where the
    /// energy is lower, until a body has moved or turned by as much as `largest` says. Velocities
    /// stay as they are.
    ///
    /// Returns what was done, or `None`, with `state` as it was, if the lowest eigenvalue is not
    /// negative beyond its error. The side is chosen as by [`leave_saddle`](Newton::leave_saddle).
    ///
    /// # Errors
    /// If an interaction has no potential or no second derivatives.
    pub fn push_off_saddle(
        &mut self,
        state: &mut State,
        interactions: &[Box<dyn Interaction>],
        largest: &StepSize,
    ) -> Result<Option<Push>, SolveError> {
        let Some(mode) = self.unstable_mode(state, interactions)? else {
            return Ok(None);
        };
        let extent = self.layout().step_extent(&mode.shape);
        let amplitude =
            (largest.displacement / extent.displacement).min(largest.rotation / extent.rotation);
        let (_, (_, moved)) = Ridge::new(state, interactions, &mode).lower_side(self, amplitude);
        *state = moved;
        let extent = extent.scaled(amplitude);
        Ok(Some(Push { mode, extent }))
    }

    /// The lowest mode, if its eigenvalue is negative beyond its error.
    fn unstable_mode(
        &mut self,
        state: &State,
        interactions: &[Box<dyn Interaction>],
    ) -> Result<Option<Mode>, SolveError> {
        let mode = self.lowest_mode(state, interactions)?;
        Ok(mode.filter(|mode| mode.eigenvalue < -mode.error))
    }

    /// Moves `state` to a minimum: solves, and leaves saddles up to `attempts` times.
    ///
    /// The equilibrium says how many saddles were left and has the history of all solves. After
    /// the last attempt it may still be a saddle, which its certificate then says.
    ///
    /// # Errors
    /// If a solve fails; `state` is then the best state reached.
    pub fn minimize(
        &mut self,
        state: &mut State,
        interactions: &[Box<dyn Interaction>],
        attempts: usize,
    ) -> Result<Equilibrium, Box<NewtonFailure>> {
        self.minimize_observed(state, interactions, attempts, &mut |_| {
            ControlFlow::Continue(())
        })
    }

    /// The same, with a callback after every step that may break it off.
    ///
    /// # Errors
    /// If a solve fails or the observer breaks off; `state` is then the best state reached.
    pub fn minimize_observed(
        &mut self,
        state: &mut State,
        interactions: &[Box<dyn Interaction>],
        attempts: usize,
        observe: &mut dyn FnMut(&Iteration) -> ControlFlow<()>,
    ) -> Result<Equilibrium, Box<NewtonFailure>> {
        let before = self.work();
        let mut equilibrium = self.solve_observed(state, interactions, observe)?;
        for _ in 0..attempts {
            if !equilibrium.is_saddle() {
                break;
            }
            let left = self.leave_saddle(state, interactions);
            // The interactions have just been used for a solve, so this cannot fail on them.
            if !matches!(left, Ok(Some(_))) {
                break;
            }
            let mut next = self.solve_observed(state, interactions, observe)?;
            equilibrium.history.append(&mut next.history);
            next.history = equilibrium.history;
            next.saddles_left = equilibrium.saddles_left + 1;
            equilibrium = next;
        }
        equilibrium.work = self.work().since(&before);
        Ok(equilibrium)
    }
}

/// A saddle, or a state next to one, and the direction in which the energy falls on both sides.
struct Ridge<'a> {
    state: &'a State,
    interactions: &'a [Box<dyn Interaction>],
    mode: &'a Mode,
    energies: Evaluation,
}

impl<'a> Ridge<'a> {
    fn new(state: &'a State, interactions: &'a [Box<dyn Interaction>], mode: &'a Mode) -> Self {
        Self {
            state,
            interactions,
            mode,
            energies: Evaluation::new(interactions, state),
        }
    }

    /// Energy above the saddle (pN nm) at `amplitude` times the mode, and the state there.
    fn at(&self, newton: &mut Newton, amplitude: f64) -> (f64, State) {
        let mut moved = self.state.clone();
        newton
            .layout()
            .apply(&mut moved, &self.mode.shape, amplitude);
        let mut there = self.energies.clone();
        there.follow(self.interactions, (self.state, &moved));
        newton.solver.work.evaluations += 1;
        (there.energy_above(&self.energies), moved)
    }

    /// The side (1 or -1) where the energy is lower, with what is `amplitude` away on it; 1 if both
    /// are alike.
    fn lower_side(&self, newton: &mut Newton, amplitude: f64) -> (f64, (f64, State)) {
        let (plus, minus) = (self.at(newton, amplitude), self.at(newton, -amplitude));
        if plus.0 <= minus.0 {
            (1.0, plus)
        } else {
            (-1.0, minus)
        }
    }
}

/// The largest turn, or displacement over the turn length.
fn largest(extent: &StepSize, turn_length: f64) -> f64 {
    extent.rotation.max(extent.displacement / turn_length)
}

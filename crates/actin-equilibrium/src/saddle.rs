//! Motion away from saddles.

use crate::direction::Solver;
use crate::evaluation::Evaluation;
use crate::history::Iteration;
use crate::mode::{self, Mode};
use crate::motion::StepSize;
use crate::newton::Newton;
use crate::outcome::{Equilibrium, NewtonFailure, SolveError};
use actin_mechanics::{Interaction, State};
use std::ops::ControlFlow;

/// First displacement from a saddle (nm and rad).
const FIRST: f64 = 1e-3;
/// Maximum displacement by doubling (rad, or nm per turn length).
const LAST: f64 = 0.2;

/// Displacement from a saddle.
#[derive(Clone, Debug, PartialEq)]
pub struct Push {
    /// Mode of the displacement.
    pub mode: Mode,
    /// Largest displacement and rotation; strains are not computed.
    pub extent: StepSize,
}

impl Newton {
    /// Lowest eigenvalue of the stiffness at `state` with its mode; `None` without unknowns.
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

    /// Moves `state` away from a saddle along the lowest mode, in the direction of lower energy.
    /// The amplitude is doubled while the energy decreases, up to rotations of 0.2 rad.
    ///
    /// Returns the mode. If the lowest eigenvalue is not negative by more than its error bound, the
    /// state does not move and the result is `None`. If both directions have equal energy, the
    /// computed sign of the mode determines the direction, reproducibly. Displace the state to
    /// select a branch.
    ///
    /// # Errors
    /// If an interaction has no potential or no second derivatives.
    pub fn leave_saddle(
        &mut self,
        state: &mut State,
        interactions: &[Box<dyn Interaction>],
    ) -> Result<Option<Mode>, SolveError> {
        self.solver.prepare(state, interactions)?;
        let turn_length = self.options().turn_length;
        leave_saddle(&mut self.solver, turn_length, state, interactions)
    }

    /// Moves `state` away from a saddle along the lowest mode, in the direction of lower energy.
    /// `largest` limits the displacements and rotations of bodies, and one of its limits is
    /// reached. Velocities are unchanged.
    ///
    /// Returns the displacement. If the lowest eigenvalue is not negative by more than its error
    /// bound, the state does not move and the result is `None`. The direction is chosen as in
    /// [`leave_saddle`](Newton::leave_saddle).
    ///
    /// # Errors
    /// If an interaction has no potential or no second derivatives.
    pub fn push_off_saddle(
        &mut self,
        state: &mut State,
        interactions: &[Box<dyn Interaction>],
        largest: &StepSize,
    ) -> Result<Option<Push>, SolveError> {
        self.solver.prepare(state, interactions)?;
        let Some(mode) = unstable_mode(&mut self.solver)? else {
            return Ok(None);
        };
        let extent = self.layout().step_extent(&mode.shape);
        let amplitude =
            (largest.displacement / extent.displacement).min(largest.rotation / extent.rotation);
        let (_, (_, moved)) =
            Ridge::new(state, interactions, &mode).lower_side(&mut self.solver, amplitude);
        *state = moved;
        let extent = extent.scaled(amplitude);
        Ok(Some(Push { mode, extent }))
    }

    /// Moves `state` to a minimum: solves, and moves away from saddles up to `attempts` times.
    ///
    /// The result contains [`Equilibrium::saddles_left`] and the history of all solves. It may
    /// still be a saddle, see [`Equilibrium::is_saddle`].
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

    /// As [`minimize`](Self::minimize), with a callback after every step that may interrupt it.
    ///
    /// # Errors
    /// If a solve fails or the observer interrupts; `state` is then the best state reached.
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
            // Cannot fail, since the interactions were used in the preceding solve.
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

/// As [`Newton::leave_saddle`], for the assembled stiffness of `state`.
pub(crate) fn leave_saddle(
    solver: &mut Solver,
    turn_length: f64,
    state: &mut State,
    interactions: &[Box<dyn Interaction>],
) -> Result<Option<Mode>, SolveError> {
    let Some(mode) = unstable_mode(solver)? else {
        return Ok(None);
    };
    let extent = solver.layout.step_extent(&mode.shape);
    let unit = 1.0 / largest(&extent, turn_length);
    let ridge = Ridge::new(state, interactions, &mode);
    let (side, (mut best, mut moved)) = ridge.lower_side(solver, FIRST * unit);
    let mut amplitude = 2.0 * FIRST;
    while amplitude <= LAST {
        let (energy, further) = ridge.at(solver, amplitude * unit * side);
        if energy.is_nan() || energy >= best {
            break;
        }
        (best, moved) = (energy, further);
        amplitude *= 2.0;
    }
    *state = moved;
    Ok(Some(mode))
}

fn unstable_mode(solver: &mut Solver) -> Result<Option<Mode>, SolveError> {
    let mode = mode::lowest(solver)?;
    Ok(mode.filter(|mode| mode.eigenvalue < -mode.error))
}

/// Saddle, or a nearby state, with its mode.
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

    /// Relative energy (pN nm) and state at `amplitude`.
    fn at(&self, solver: &mut Solver, amplitude: f64) -> (f64, State) {
        let mut moved = self.state.clone();
        solver.layout.apply(&mut moved, &self.mode.shape, amplitude);
        let mut there = self.energies.clone();
        there.follow(self.interactions, (self.state, &moved));
        solver.work.evaluations += 1;
        (there.energy_above(&self.energies), moved)
    }

    /// Direction of lower energy, with energy and state there.
    fn lower_side(&self, solver: &mut Solver, amplitude: f64) -> (f64, (f64, State)) {
        let (plus, minus) = (self.at(solver, amplitude), self.at(solver, -amplitude));
        if plus.0 <= minus.0 {
            (1.0, plus)
        } else {
            (-1.0, minus)
        }
    }
}

fn largest(extent: &StepSize, turn_length: f64) -> f64 {
    extent.rotation.max(extent.displacement / turn_length)
}

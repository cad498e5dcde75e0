//! Motion away from saddles.

use crate::descent::ROUND_OFF;
use crate::direction::Solver;
use crate::evaluation::Evaluation;
use crate::history::Iteration;
use crate::mode::{self, Mode};
use crate::motion::StepSize;
use crate::newton::Newton;
use crate::options::NewtonOptions;
use crate::outcome::{Equilibrium, NewtonFailure, SolveError};
use actin_mechanics::{Interaction, State};
use std::ops::ControlFlow;

/// First displacement from a saddle (nm and rad).
const FIRST: f64 = 1e-3;
/// Maximum displacement by doubling (rad, or nm per turn length).
const LAST: f64 = 0.2;
/// Number of times that an amplitude is halved if it does not lower the energy.
const HALVINGS: usize = 4;

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
    /// The amplitude is doubled while the energy decreases, up to rotations of 0.2 rad and the limits
    /// of a step.
    ///
    /// Returns the mode. If the lowest eigenvalue is not negative by more than its error bound, or
    /// no displacement lowers the energy, the state does not move and the result is `None`. If both directions have equal energy, the
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
        let options = *self.options();
        leave_saddle(&mut self.solver, &options, state, interactions)
    }

    /// Moves `state` away from a saddle along the lowest mode, in the direction of lower energy.
    /// `largest` limits the displacements and rotations of bodies. One of its limits is reached,
    /// unless only smaller amplitudes lower the energy. Velocities are unchanged.
    ///
    /// Returns the displacement. If the lowest eigenvalue is not negative by more than its error
    /// bound, or no displacement lowers the energy, the state does not move and the result is
    /// `None`. The direction is chosen as in
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
        let ridge = Ridge::new(state, interactions, &mode);
        let lower = ridge.lower_side(&mut self.solver, amplitude);
        Ok(lower.map(|lower| {
            *state = lower.state;
            let extent = extent.scaled(lower.amplitude.abs());
            Push { mode, extent }
        }))
    }

    /// Moves `state` to a minimum: solves, and moves away from saddles up to `attempts` times. Slow
    /// descents of symmetric states are displaced along the lowest mode as often as necessary. With
    /// 0 attempts nothing is displaced.
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
        let may_displace = attempts > 0;
        let mut equilibrium = self.solve_observed(state, interactions, may_displace, observe)?;
        for _ in 0..attempts {
            if !equilibrium.is_saddle() {
                break;
            }
            let left = self.leave_saddle(state, interactions);
            // Cannot fail, since the interactions were used in the preceding solve.
            if !matches!(left, Ok(Some(_))) {
                break;
            }
            let mut next = self.solve_observed(state, interactions, may_displace, observe)?;
            equilibrium.history.append(&mut next.history);
            next.history = equilibrium.history;
            next.saddles_left += equilibrium.saddles_left + 1;
            equilibrium = next;
        }
        equilibrium.work = self.work().since(&before);
        Ok(equilibrium)
    }
}

/// As [`Newton::leave_saddle`], for the assembled stiffness of `state`.
pub(crate) fn leave_saddle(
    solver: &mut Solver,
    options: &NewtonOptions,
    state: &mut State,
    interactions: &[Box<dyn Interaction>],
) -> Result<Option<Mode>, SolveError> {
    let Some(mode) = unstable_mode(solver)? else {
        return Ok(None);
    };
    let extent = solver.layout.step_extent(&mode.shape);
    let unit = 1.0 / largest(&extent, options.turn_length);
    let limit = (LAST * unit)
        .min(options.largest_rotation / extent.rotation)
        .min(options.largest_displacement / extent.displacement);
    let ridge = Ridge::new(state, interactions, &mode);
    let Some(mut best) = ridge.lower_side(solver, limit.min(FIRST * unit)) else {
        return Ok(None);
    };
    while 2.0 * best.amplitude.abs() <= limit {
        let further = ridge.at(solver, 2.0 * best.amplitude);
        if further.energy >= best.energy {
            break;
        }
        best = further;
    }
    *state = best.state;
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

    fn at(&self, solver: &mut Solver, amplitude: f64) -> Displaced {
        let mut state = self.state.clone();
        solver.layout.apply(&mut state, &self.mode.shape, amplitude);
        let mut there = self.energies.clone();
        there.follow(self.interactions, (self.state, &state));
        solver.work.evaluations += 1;
        let is_finite = there.is_finite();
        let energy = there.energy_above(&self.energies);
        Displaced {
            amplitude,
            energy: if is_finite { energy } else { f64::INFINITY },
            state,
        }
    }

    /// Displacement in the direction of lower energy. The amplitude is halved if neither direction
    /// lowers the energy; `None` if this does not help either.
    fn lower_side(&self, solver: &mut Solver, amplitude: f64) -> Option<Displaced> {
        let mut amplitude = amplitude;
        for _ in 0..=HALVINGS {
            let (plus, minus) = (self.at(solver, amplitude), self.at(solver, -amplitude));
            let lower = if plus.energy <= minus.energy {
                plus
            } else {
                minus
            };
            if self.is_lower(&lower) {
                return Some(lower);
            }
            amplitude *= 0.5;
        }
        None
    }

    /// Returns `true` if the energy is lower, or if both the change and the decrease of the
    /// quadratic model are within rounding.
    fn is_lower(&self, displaced: &Displaced) -> bool {
        let predicted = -0.5 * self.mode.eigenvalue * displaced.amplitude.powi(2);
        let rounding = ROUND_OFF * self.energies.magnitude;
        displaced.energy < 0.0 || predicted.max(displaced.energy) <= rounding
    }
}

/// State displaced along a mode.
struct Displaced {
    amplitude: f64,
    /// Energy relative to the ridge (pN nm); infinite if it is not finite, or if bodies passed
    /// through each other.
    energy: f64,
    state: State,
}

fn largest(extent: &StepSize, turn_length: f64) -> f64 {
    extent.rotation.max(extent.displacement / turn_length)
}

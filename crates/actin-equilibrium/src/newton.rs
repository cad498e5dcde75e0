//! Newton's method for minima of the potential energy.
//!
//! Each step solves `(K + mu M) p = f` with the full stiffness `K`; `mu` is zero where `K` is
//! positive definite and else just large enough to make it so. Where the stiffness changes a lot
//! within the step, as that of floppy filaments does, coupled neighbours are stiffened in
//! proportion to their relative motion (see `ties`). The step is shortened to the limits of the
//! options and judged by the energy. Bodies follow it straight or, where that is lower in energy,
//! each carried along by the one before it, which bends a filament without stretching it (see
//! `chain`). An excursion, a few steps above the energy where it began, is allowed: what is
//! stretched by the straight step relaxes in the next ones, which is far quicker than to follow
//! a bend in small steps (the watchdog technique). An excursion that does not pay is taken back.
//!
//! A start of many bodies that is floppy, as a long filament may be at rest, is far from its
//! equilibrium. From there each body is carried along in every step, with the second derivatives that belong
//! to that, while such steps lower the energy (see `descent/composed`).
//!
//! The direction of a step is found in `direction`, its acceptance in `descent`.
//!
//! # Source
//! J. Nocedal and S. J. Wright, Numerical Optimization, 2nd ed. (2006), sections 3.4 (modified
//! Cholesky) and 15.6 (watchdog).

use crate::certificate::Certificate;
use crate::certify::certify;
use crate::descent::Descent;
use crate::direction::Solver;
use crate::history::{Iteration, SolverWork};
use crate::layout::Layout;
use crate::load_scale::{LoadScale, is_loaded};
use crate::options::{NewtonOptions, OptionsError};
use crate::outcome::{Convergence, Equilibrium, NewtonFailure, SolveError};
use actin_mechanics::Residual;
use actin_mechanics::{Interaction, Loads, State};
use std::ops::ControlFlow;

/// The residual counts as being at its floor below this multiple of the estimate.
const AT_FLOOR: f64 = 8.0;
/// Where no step helps or is allowed any more, the same with more room, since the estimate is rough.
pub(crate) const NEAR_FLOOR: f64 = 100.0;
/// A residual that falls less than by this factor in a step does not fall any more.
pub(crate) const STILL_FALLING: f64 = 0.5;
/// A failed solve has no equilibrium if more than this share of its residual acts along motions without
/// stiffness. A rigid motion has a share of 1, up to rounding; the lowest mode of a long filament has less.
const UNRESISTED: f64 = 0.9;

/// A solver for equilibria of one model: layout, options, and the memory of earlier solves.
///
/// Symbolic factorisation and places of blocks are kept from solve to solve.
#[derive(Debug)]
pub struct Newton {
    pub(crate) solver: Solver,
    options: NewtonOptions,
}

impl Newton {
    /// A solver.
    ///
    /// # Errors
    /// If an option makes no sense.
    pub fn new(layout: Layout, options: NewtonOptions) -> Result<Self, OptionsError> {
        options.check()?;
        Ok(Self {
            solver: Solver::new(layout, options.turn_length),
            options,
        })
    }

    /// What may move.
    pub fn layout(&self) -> &Layout {
        &self.solver.layout
    }

    /// What may move, to give groups new directions.
    pub fn layout_mut(&mut self) -> &mut Layout {
        &mut self.solver.layout
    }

    /// The options.
    pub fn options(&self) -> &NewtonOptions {
        &self.options
    }

    /// Whether bodies carry one another along from any start of many of them, or from floppy ones only: for starts
    /// that are like the equilibrium but far from it.
    pub fn carry_along(&mut self, from_any_start: bool) {
        self.options.carries_along = from_any_start;
    }

    /// What all solves so far have cost.
    pub fn work(&self) -> SolverWork {
        self.solver.work
    }

    /// Counts on from what an earlier solver has done that this one continues. The symbolic
    /// factorisation that it has to repeat counts once more.
    pub fn count_on(&mut self, work: SolverWork) {
        self.solver.work = work;
    }

    /// Settles the order of unknowns by what is coupled in `state`, for interactions whose pairs change:
    /// what follows then does not depend on the state that is solved first. Nothing happens where an
    /// interaction has no potential or no second derivatives.
    pub fn settle_order(&mut self, state: &State, interactions: &[Box<dyn Interaction>]) {
        // Solves refuse such interactions, with their names.
        let _ = self.solver.prepare(state, interactions);
    }

    /// Moves `state` to an equilibrium near it.
    ///
    /// Held bodies and controls stay as they are, velocities are not looked at.
    ///
    /// # Errors
    /// If none is found; `state` is then the best state reached.
    pub fn solve(
        &mut self,
        state: &mut State,
        interactions: &[Box<dyn Interaction>],
    ) -> Result<Equilibrium, Box<NewtonFailure>> {
        self.solve_observed(state, interactions, &mut |_| ControlFlow::Continue(()))
    }

    /// The same, with a callback after every step that may break it off.
    ///
    /// # Errors
    /// If no equilibrium is found or the observer breaks off; `state` is then the best state
    /// reached.
    pub fn solve_observed(
        &mut self,
        state: &mut State,
        interactions: &[Box<dyn Interaction>],
        observe: &mut dyn FnMut(&Iteration) -> ControlFlow<()>,
    ) -> Result<Equilibrium, Box<NewtonFailure>> {
        let before = self.solver.work;
        let mut run = Run {
            solver: &mut self.solver,
            options: &self.options,
            interactions,
            history: Vec::new(),
            residual: Residual::default(),
            floor: Residual::default(),
            previous: f64::INFINITY,
        };
        let result = run.execute(state, observe);
        let (history, residual, floor) = (run.history, run.residual, run.floor);
        let solver = &mut self.solver;
        let certificate =
            (result.is_ok() && self.options.certify).then(|| certify(solver, state, interactions));
        let work = solver.work.since(&before);
        match result {
            Ok((ending, energy)) => Ok(Equilibrium {
                ending,
                energy,
                residual,
                floor,
                certificate,
                saddles_left: 0,
                history,
                work,
            }),
            Err(cause) => Err(Box::new(NewtonFailure {
                cause,
                residual,
                floor,
                history,
                work,
            })),
        }
    }

    /// Counts the eigenvalues of the stiffness at any state, in equilibrium or not.
    ///
    /// # Errors
    /// If an interaction has no potential or no second derivatives.
    pub fn certify(
        &mut self,
        state: &State,
        interactions: &[Box<dyn Interaction>],
    ) -> Result<Certificate, SolveError> {
        self.solver.prepare(state, interactions)?;
        Ok(certify(&mut self.solver, state, interactions))
    }

    /// The residual of a state.
    pub fn residual(&self, state: &State, interactions: &[Box<dyn Interaction>]) -> Residual {
        let loads = self.generalised_loads(state, interactions);
        self.layout().largest(&loads)
    }

    /// Minus the derivative of the energy by each unknown.
    ///
    /// The order of unknowns may change at the first solve if the layout was given no order.
    pub fn generalised_loads(
        &self,
        state: &State,
        interactions: &[Box<dyn Interaction>],
    ) -> Vec<f64> {
        let mut loads = Loads::zeros(state);
        for interaction in interactions {
            interaction.add_loads(state, &mut loads);
        }
        let mut reduced = vec![0.0; self.layout().unknowns()];
        self.layout().reduce(state, &loads, &mut reduced);
        reduced
    }

    /// The stiffness at `state` times `v`, one number per unknown: minus the derivative of the
    /// generalised loads along `v`, to be compared with differences. If the layout was given no
    /// order, certify or solve first: that settles the order of unknowns.
    ///
    /// # Errors
    /// If an interaction has no potential or no second derivatives.
    ///
    /// # Panics
    /// If `v` has not one number per unknown.
    pub fn stiffness_times(
        &mut self,
        state: &State,
        interactions: &[Box<dyn Interaction>],
        v: &[f64],
    ) -> Result<Vec<f64>, SolveError> {
        assert_eq!(v.len(), self.layout().unknowns(), "one number per unknown");
        self.solver.prepare(state, interactions)?;
        let mut product = vec![0.0; v.len()];
        self.solver.assembly.multiply(v, &mut product);
        Ok(product)
    }
}

/// One solve.
struct Run<'a> {
    solver: &'a mut Solver,
    options: &'a NewtonOptions,
    interactions: &'a [Box<dyn Interaction>],
    history: Vec<Iteration>,
    residual: Residual,
    floor: Residual,
    /// Residual, relative to the tolerance, before the last step.
    previous: f64,
}

impl Run<'_> {
    /// Steps until an end is reached; returns the ending and the energy.
    fn execute(
        &mut self,
        state: &mut State,
        observe: &mut dyn FnMut(&Iteration) -> ControlFlow<()>,
    ) -> Result<(Convergence, f64), SolveError> {
        Solver::check(self.interactions)?;
        count_turns(self.interactions, state);
        let mut descent = Descent::new(self.interactions, state, self.options);
        self.solver.work.evaluations += 1;
        if !descent.here.is_finite() {
            return Err(SolveError::NotFinite);
        }
        let result = loop {
            match self.step(&mut descent) {
                Ok(None) => count_turns(self.interactions, &mut descent.state),
                Ok(Some(ending)) => break Ok((ending, descent.here.energy)),
                Err(cause) => break Err(cause),
            }
            let last = self.history.last().expect("a step has just been made");
            if observe(last).is_break() {
                break Err(SolveError::Interrupted);
            }
        };
        if result.is_err() && descent.end_excursion() {
            self.solver
                .assemble(self.interactions, &descent.state, &descent.here.loads);
            self.measure(&descent);
        }
        *state = descent.state;
        result
    }

    /// Residual and floor of the present state, whose stiffness is assembled.
    fn measure(&mut self, descent: &Descent) {
        let (residual, floor) = self.solver.residual_and_floor(&descent.state);
        (self.residual, self.floor) = (residual, floor);
    }

    /// One step, or the reason why none is needed.
    fn step(&mut self, descent: &mut Descent) -> Result<Option<Convergence>, SolveError> {
        self.solver
            .assemble(self.interactions, &descent.state, &descent.here.loads);
        self.measure(descent);
        if let Some(ending) = self.ending(descent)? {
            return Ok(Some(ending));
        }
        if descent.is_far() && self.solver.has_weak_mode() {
            return Err(SolveError::Unbounded);
        }
        if descent.stays_blocked() {
            return self.give_up(descent, SolveError::PassesThrough);
        }
        if self.history.len() >= self.options.iterations {
            return self.give_up(descent, SolveError::IterationLimit(self.options.iterations));
        }
        self.previous = self.residual.relative_to(&self.options.tolerance);
        let before = descent.here.energy;
        let Some((direction, taken)) = descent.advance(self.solver, self.interactions)? else {
            self.solver
                .assemble(self.interactions, &descent.state, &descent.here.loads);
            self.measure(descent);
            let cause = if descent.is_blocked() {
                SolveError::PassesThrough
            } else {
                SolveError::Stagnated
            };
            return self.give_up(descent, cause);
        };
        self.solver.work.iterations += 1;
        self.history.push(Iteration {
            energy: before,
            residual: self.residual,
            negative_pivots: direction.negative_pivots,
            regularization: direction.regularization,
            stiffening: direction.cubic,
            fraction: taken.fraction,
            extent: taken.extent,
            verdict: taken.verdict,
        });
        Ok(None)
    }

    /// Whether the present state is an equilibrium.
    ///
    /// Within the tolerance steps are made as long as they halve the residual, until it is small against the
    /// loads too. An excursion that ends in an equilibrium above where it began has not paid: it is taken
    /// back, so that a solve never ends above its start.
    ///
    /// # Errors
    /// If the remaining load acts along motions without stiffness.
    fn ending(&mut self, descent: &mut Descent) -> Result<Option<Convergence>, SolveError> {
        let tolerance = &self.options.tolerance;
        let falling = self.residual.relative_to(tolerance) < STILL_FALLING * self.previous;
        let is_final = !falling && !descent.is_on_excursion();
        let ending = if self.residual.is_within(tolerance) {
            Convergence::Converged
        } else if is_final && self.solver.is_at_floor(tolerance, AT_FLOOR) {
            Convergence::FloorReached
        } else {
            return Ok(None);
        };
        let scale = self.load_scale(descent);
        let is_small = scale.dwarfs(&self.residual);
        let goes_on = falling && !is_small && self.is_worth_another_step(descent);
        if goes_on || descent.gives_up_excursion() {
            return Ok(None);
        }
        self.accept(&scale, ending)
    }

    /// Whether a residual within the tolerance may fall further: it is more than what rounding leaves, or a dead
    /// load acts. Steps from a saddle would lead away from it.
    fn is_worth_another_step(&mut self, descent: &Descent) -> bool {
        let is_rounding = self.solver.is_at_floor(&Residual::default(), AT_FLOOR);
        (!is_rounding || is_loaded(self.interactions, &descent.state)) && self.solver.is_stable()
    }

    /// The ending, unless a part of the loads acts along motions without stiffness: it would move bodies
    /// without end.
    fn accept(
        &mut self,
        scale: &LoadScale,
        ending: Convergence,
    ) -> Result<Option<Convergence>, SolveError> {
        if scale.dwarfs(&self.residual) {
            return Ok(Some(ending));
        }
        match self.solver.unresisted() {
            Some(unresisted) if !scale.outweighs(&unresisted) => Err(SolveError::Unbounded),
            _ => Ok(Some(ending)),
        }
    }

    /// Size of the loads of the present state, which act at arms between the turn length and the size of the whole.
    fn load_scale(&mut self, descent: &Descent) -> LoadScale {
        self.solver.work.evaluations += 1;
        let shortest = self.options.turn_length;
        let arms = [shortest, descent.size.max(shortest)];
        LoadScale::new(self.interactions, &descent.state, arms)
    }

    /// No step helps or none is allowed any more: either the tolerance or the floor is reached, about which
    /// steps may wander, or something is wrong.
    fn give_up(
        &mut self,
        descent: &Descent,
        cause: SolveError,
    ) -> Result<Option<Convergence>, SolveError> {
        let tolerance = &self.options.tolerance;
        let ending = if self.residual.is_within(tolerance) {
            Some(Convergence::Converged)
        } else {
            let is_at_floor = self.solver.is_at_floor(tolerance, NEAR_FLOOR);
            is_at_floor.then_some(Convergence::FloorReached)
        };
        if let Some(ending) = ending.filter(|_| !descent.is_on_excursion()) {
            let scale = self.load_scale(descent);
            return self.accept(&scale, ending);
        }
        let all = self.solver.total();
        match self.solver.unresisted() {
            Some(part) if !part.is_within(&all.scaled(UNRESISTED)) => Err(SolveError::Unbounded),
            _ => Err(cause),
        }
    }
}

fn count_turns(interactions: &[Box<dyn Interaction>], state: &mut State) {
    for interaction in interactions {
        interaction.count_turns(state);
    }
}

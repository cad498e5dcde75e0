//! Newton's method for minima of the potential energy.
//!
//! Each step solves `(K + mu M) p = f` with the full stiffness `K` and the smallest shift `mu` that
//! makes the sum positive definite. If the stiffness changes much within a step, the coupling of
//! neighbours is stiffened in proportion to their relative motion (see `ties`).
//!
//! In a straight step bodies move along straight lines. In a carried step each body keeps its pose
//! relative to its predecessor (see `chain`); this step is used if the energy is lower. A straight
//! step stretches a bent filament, and the following steps relax the stretch. The energy may
//! therefore exceed its initial value for a few steps (watchdog technique). If the energy does not
//! decrease afterwards, these steps are reverted.
//!
//! Far from equilibrium, a symmetric state may have many unstable modes along which the loads have
//! no component. The regularised steps are then short. [`Newton::minimize`] therefore displaces the
//! state along the lowest mode after 20 short steps.
//!
//! # Source
//! J. Nocedal and S. J. Wright, Numerical Optimization, 2nd ed. (2006), sections 3.4 (modified
//! Cholesky) and 15.6 (watchdog).

mod certify;
mod saddle;

use crate::certificate::Certificate;
use crate::descent::Descent;
use crate::direction::Solver;
use crate::history::{Iteration, SolverWork, Verdict};
use crate::layout::Layout;
use crate::load_scale::{LoadScale, is_loaded};
use crate::options::{NewtonOptions, OptionsError};
use crate::outcome::{Convergence, Equilibrium, NewtonFailure, SolveError};
use actin_mechanics::Residual;
use actin_mechanics::{Interaction, Loads, State};
use certify::certify;
pub use saddle::Push;
use saddle::leave_saddle;
use std::ops::ControlFlow;

/// Multiple of the rounding error considered negligible.
const AT_FLOOR: f64 = 8.0;
/// Multiple of the rounding error considered negligible if no further step is possible.
pub(crate) const NEAR_FLOOR: f64 = 100.0;
/// Minimum decrease of a residual per step.
pub(crate) const STILL_FALLING: f64 = 0.5;
/// Number of consecutive slow steps with indefinite stiffness before a displacement along the
/// lowest mode.
const SLOW_STEPS: usize = 20;
/// Largest rotation (rad) and strain of a slow step.
const SLOW: f64 = 1e-3;
/// Fraction of the residual along zero-stiffness motions above which no equilibrium exists.
const UNRESISTED: f64 = 0.9;

/// Newton solver for one model: layout, options and reusable factorisation.
#[derive(Debug)]
pub struct Newton {
    pub(crate) solver: Solver,
    options: NewtonOptions,
}

impl Newton {
    /// Creates a solver.
    ///
    /// # Errors
    /// If an option is invalid.
    pub fn new(layout: Layout, options: NewtonOptions) -> Result<Self, OptionsError> {
        options.check()?;
        Ok(Self {
            solver: Solver::new(layout, options.turn_length),
            options,
        })
    }

    /// Layout of the unknowns.
    pub fn layout(&self) -> &Layout {
        &self.solver.layout
    }

    /// Options of the solver.
    pub fn options(&self) -> &NewtonOptions {
        &self.options
    }

    /// Sets [`NewtonOptions::carries_along`]. Use `true` for an initial guess with the shape of the
    /// equilibrium, but far from it.
    pub fn carry_along(&mut self, from_any_start: bool) {
        self.options.carries_along = from_any_start;
    }

    /// Cost of all solves so far.
    pub fn work(&self) -> SolverWork {
        self.solver.work
    }

    /// Sets the cost counters, to continue the counters of an earlier solver. The symbolic
    /// factorisation of this solver is counted in addition.
    pub fn set_work(&mut self, work: SolverWork) {
        self.solver.work = work;
    }

    /// Determines the order of unknowns from the couplings at `state`. If an interaction has
    /// changing pairs, later results then do not depend on the state that is solved first. Does
    /// nothing if an interaction has no potential or no second derivatives.
    pub fn determine_order(&mut self, state: &State, interactions: &[Box<dyn Interaction>]) {
        // The next solve returns the error.
        let _ = self.solver.prepare(state, interactions);
    }

    /// Moves `state` to a nearby equilibrium.
    ///
    /// Held bodies, controls and velocities are unchanged.
    ///
    /// # Errors
    /// If no equilibrium is found; `state` is then the best state reached.
    pub fn solve(
        &mut self,
        state: &mut State,
        interactions: &[Box<dyn Interaction>],
    ) -> Result<Equilibrium, Box<NewtonFailure>> {
        self.solve_observed(state, interactions, false, &mut |_| {
            ControlFlow::Continue(())
        })
    }

    /// As [`solve`](Self::solve), with a callback after every step that may interrupt it. If
    /// `may_displace`, slow descents of symmetric states are displaced along the lowest mode.
    ///
    /// # Errors
    /// If no equilibrium is found or the observer interrupts; `state` is then the best state
    /// reached.
    pub(crate) fn solve_observed(
        &mut self,
        state: &mut State,
        interactions: &[Box<dyn Interaction>],
        may_displace: bool,
        observe: &mut dyn FnMut(&Iteration) -> ControlFlow<()>,
    ) -> Result<Equilibrium, Box<NewtonFailure>> {
        let before = self.solver.work;
        let mut run = Run {
            solver: &mut self.solver,
            options: &self.options,
            interactions,
            history: Vec::new(),
            may_displace,
            displaced_at: 0,
            displacements: 0,
            residual: Residual::default(),
            floor: Residual::default(),
            previous: f64::INFINITY,
        };
        let result = run.execute(state, observe);
        let (history, residual, floor) = (run.history, run.residual, run.floor);
        let saddles_left = run.displacements;
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
                saddles_left,
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

    /// Counts the eigenvalues of the stiffness at any state.
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

    /// Residual of a state.
    pub fn residual(&self, state: &State, interactions: &[Box<dyn Interaction>]) -> Residual {
        let loads = self.generalised_loads(state, interactions);
        self.layout().largest(&loads)
    }

    /// Generalised loads: negative derivative of the energy with respect to each unknown.
    ///
    /// The order of unknowns may change at the first solve if the layout has no prescribed order.
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
        self.layout().reduce(&loads, &mut reduced);
        reduced
    }

    /// Product of the stiffness at `state` and `v` (one number per unknown): negative derivative of
    /// the generalised loads along `v`. If the layout has no prescribed order, certify or solve
    /// first.
    ///
    /// # Errors
    /// If an interaction has no potential or no second derivatives.
    ///
    /// # Panics
    /// If the length of `v` is wrong.
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

struct Run<'a> {
    solver: &'a mut Solver,
    options: &'a NewtonOptions,
    interactions: &'a [Box<dyn Interaction>],
    history: Vec<Iteration>,
    /// Permits displacements along the lowest mode.
    may_displace: bool,
    /// Number of steps before the last displacement, or before the last attempt.
    displaced_at: usize,
    displacements: usize,
    residual: Residual,
    floor: Residual,
    previous: f64,
}

impl Run<'_> {
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
            let steps = self.history.len();
            match self.step(&mut descent) {
                Ok(None) => count_turns(self.interactions, &mut descent.state),
                Ok(Some(ending)) => break Ok((ending, descent.here.energy)),
                Err(cause) => break Err(cause),
            }
            // Displacements along the lowest mode are not recorded.
            let new = self.history.get(steps);
            if new.is_some_and(|step| observe(step).is_break()) {
                break Err(SolveError::Interrupted);
            }
        };
        if result.is_err() && descent.end_excursion() {
            self.assemble(&descent);
        }
        *state = descent.state;
        result
    }

    /// Assembles the stiffness and measures the residual.
    fn assemble(&mut self, descent: &Descent) {
        self.solver
            .assemble(self.interactions, &descent.state, &descent.here.loads);
        let (residual, floor) = self.solver.residual_and_floor(&descent.state);
        (self.residual, self.floor) = (residual, floor);
    }

    fn step(&mut self, descent: &mut Descent) -> Result<Option<Convergence>, SolveError> {
        self.assemble(descent);
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
        if self.may_displace && self.is_slow() && self.displace(descent)? {
            return Ok(None);
        }
        self.previous = self.residual.relative_to(&self.options.tolerance);
        let before = descent.here.energy;
        let Some((direction, accepted_step)) = descent.advance(self.solver, self.interactions)?
        else {
            return self.stop_at_best(descent);
        };
        self.solver.work.iterations += 1;
        self.history.push(Iteration {
            energy: before,
            residual: self.residual,
            negative_pivots: direction.negative_pivots,
            regularization: direction.regularization,
            stiffening: direction.cubic,
            fraction: accepted_step.fraction,
            extent: accepted_step.extent,
            verdict: accepted_step.verdict,
        });
        Ok(None)
    }

    /// Termination where no step is accepted.
    fn stop_at_best(&mut self, descent: &mut Descent) -> Result<Option<Convergence>, SolveError> {
        self.assemble(descent);
        let cause = if descent.is_blocked() {
            SolveError::PassesThrough
        } else {
            SolveError::Stagnated
        };
        self.give_up(descent, cause)
    }

    /// Returns `true` if recent steps are short, because the loads have small components along the
    /// unstable modes.
    fn is_slow(&self) -> bool {
        let steps = &self.history[self.displaced_at..];
        steps.len() >= SLOW_STEPS
            && steps.iter().rev().take(SLOW_STEPS).all(|step| {
                step.negative_pivots > 0
                    && step.regularization > 0.0
                    && step.verdict == Verdict::Decrease
                    && step.extent.rotation.max(step.extent.strain) < SLOW
            })
    }

    /// Displaces the state along the lowest mode; `false` if no displacement lowers the energy.
    fn displace(&mut self, descent: &mut Descent) -> Result<bool, SolveError> {
        self.displaced_at = self.history.len();
        let mut state = descent.state.clone();
        let mode = leave_saddle(self.solver, self.options, &mut state, self.interactions)?;
        if mode.is_some() {
            descent.restart(self.interactions, &state);
            self.solver.work.evaluations += 1;
            self.displacements += 1;
        }
        Ok(mode.is_some())
    }

    /// Reason for termination, if any. Within the tolerance, steps continue as long as they halve
    /// the residual, until it is small compared with the loads.
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

    /// Returns `true` if the state is not a saddle, and the residual exceeds the rounding error or
    /// a dead load acts. A step from a saddle would move away from the saddle.
    fn is_worth_another_step(&mut self, descent: &Descent) -> bool {
        let is_rounding = self.solver.is_at_floor(&Residual::default(), AT_FLOOR);
        (!is_rounding || is_loaded(self.interactions, &descent.state)) && self.solver.is_stable()
    }

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

    /// Scale of the loads, with lever arms from the turn length to the size of the system.
    fn load_scale(&mut self, descent: &Descent) -> LoadScale {
        self.solver.work.evaluations += 1;
        let shortest = self.options.turn_length;
        let arms = [shortest, descent.size.max(shortest)];
        LoadScale::new(self.interactions, &descent.state, arms)
    }

    /// Result if no further step is possible: convergence near the rounding error, or failure.
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

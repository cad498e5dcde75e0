//! Carried Newton steps with the second derivatives in their chart,
//! [`Chain::carry`](crate::chain::Chain::carry), for long filaments with zero-stiffness modes.
//!
//! If the stiffness is indefinite, ties are stiffened in proportion to their own negative
//! transverse stiffness. A multiple of the unit matrix would prevent large motion. After a step
//! without decrease of the energy, straight steps are used for a while.

use super::{AcceptedStep, Descent, accepted_step};
use crate::chain::is_open;
use crate::direction::{Direction, Solver};
use crate::history::Verdict;
use crate::options::NewtonOptions;
use actin_mechanics::Interaction;

const FEWEST: usize = 400;
/// Directions without stiffness per body above which a start is floppy.
const FLOPPY: f64 = 1.0 / 16.0;
const ATTEMPTS: usize = 4;
const SHORTEN: f64 = 0.1;
/// Straight steps after a failure, doubled after each consecutive failure.
const REST: usize = 1;

#[derive(Debug)]
pub(super) struct ComposedSteps {
    is_used: Option<bool>,
    failures: u32,
    /// Straight steps before the next carried one.
    rest: usize,
    /// Largest stiffening in the last step (pN/nm).
    stiffest: f64,
    /// Requested also for starts that are not floppy.
    is_wanted: bool,
}

impl ComposedSteps {
    pub(super) fn new(options: &NewtonOptions) -> Self {
        let is_free = options.largest_displacement.is_infinite();
        Self {
            is_used: if is_free { None } else { Some(false) },
            failures: 0,
            rest: 0,
            stiffest: 0.0,
            is_wanted: options.carries_along,
        }
    }

    /// Decides at the start; returns `true` if carried steps are chosen.
    pub(super) fn begins(&mut self, solver: &Solver) -> bool {
        if self.is_used.is_some() {
            return false;
        }
        let bodies = solver.layout.len();
        let is_floppy = solver.floppy() as f64 >= FLOPPY * bodies as f64;
        let is_used = bodies >= FEWEST
            && (is_floppy || self.is_wanted)
            && solver.layout.sliders().is_empty()
            && is_open(&solver.layout, solver.assembly.ties());
        self.is_used = Some(is_used);
        is_used
    }

    fn is_due(&mut self) -> bool {
        let is_due = self.rest == 0;
        self.rest = self.rest.saturating_sub(1);
        is_due && self.is_used == Some(true)
    }

    fn note(&mut self, is_failure: bool) {
        self.failures = if is_failure { self.failures + 1 } else { 0 };
        if is_failure {
            self.rest = REST << self.failures.min(16);
        }
    }
}

impl Descent {
    /// Takes a carried step. `None` if none is due or accepted; the stiffness is then restored.
    pub(super) fn compose(
        &mut self,
        solver: &mut Solver,
        interactions: &[Box<dyn Interaction>],
    ) -> Option<(Direction, AcceptedStep)> {
        if self.anchor.is_some() || !self.composed.is_due() {
            return None;
        }
        let loads = &self.here.loads;
        solver
            .assembly
            .add_turning(&self.state, loads, &solver.layout);
        let direction = solver.composed_direction(&self.state, &mut self.composed.stiffest);
        let found = direction.and_then(|direction| {
            let accepted_step = self.carry_along(solver, interactions, &direction)?;
            Some((direction, accepted_step))
        });
        self.composed.note(found.is_none());
        if found.is_none() {
            solver.assemble(interactions, &self.state, &self.here.loads);
        }
        found
    }

    fn carry_along(
        &mut self,
        solver: &mut Solver,
        interactions: &[Box<dyn Interaction>],
        direction: &Direction,
    ) -> Option<AcceptedStep> {
        let part = (direction.extent.strain / self.options.largest_strain)
            .max(direction.extent.displacement / self.farthest);
        let mut fraction = if part > 1.0 { 1.0 / part } else { 1.0 };
        let velocities = solver.layout.velocities(&self.state, &direction.step);
        for _ in 0..ATTEMPTS {
            self.trial.clone_from(&self.state);
            let layout = &solver.layout;
            layout.apply(&mut self.trial, &direction.step, fraction);
            let chain = solver.assembly.chain();
            chain.carry(&self.state, &velocities, fraction, &mut self.trial);
            self.there.follow(interactions, (&self.state, &self.trial));
            solver.work.evaluations += 1;
            match self.judge(solver, direction, fraction) {
                Some(Verdict::Decrease) => {
                    self.accept();
                    return Some(accepted_step(direction, fraction, Verdict::Decrease));
                }
                Some(_) => return None,
                None => {}
            }
            fraction *= self.next_factor(direction, fraction).max(SHORTEN);
        }
        None
    }
}

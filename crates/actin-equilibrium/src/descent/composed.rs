//! Steps in which bodies carry one another along, with the second derivatives that belong to them.
//!
//! A long filament that is floppy at rest is far from its equilibrium: its end moves along an arc, and
//! thousands of neighbours give way to one side or the other. Steps along straight lines see neither. Here a
//! step is a Newton step in the chart of [`Chain::carry`](crate::chain::Chain::carry), in which strains are linear
//! however far the whole moves. Where the stiffness is not positive definite, ties are stiffened by as much as
//! their own stiffness across is negative, times one factor for all and that as small as it may be: a multiple
//! of the unit matrix would hold back what moves far, and one stiffness for all ties those that need none.
//!
//! Where ends meet again, as in a filament held at both or linked to another, what is carried along does not
//! arrive, and straight steps are better.
//!
//! Each step lowers the energy. One that does not, however short, is left to the other way, which then has
//! some steps to itself.

use super::{Descent, Taken, taken};
use crate::chain::is_open;
use crate::direction::{Direction, Solver};
use crate::history::Verdict;
use crate::options::NewtonOptions;
use actin_mechanics::Interaction;

/// Starts of fewer bodies and groups than this are near enough.
const FEWEST: usize = 400;
/// Directions without stiffness, as a share of bodies, that make a start floppy.
const FLOPPY: f64 = 1.0 / 16.0;
/// How often a step may be shortened.
const ATTEMPTS: usize = 4;
/// The least factor by which a step is shortened.
const SHORTEN: f64 = 0.1;
/// Steps left to the other way after a failure in a row of them; doubled by each.
const REST: usize = 1;

/// Whether bodies carry one another along, and how the last such step went.
#[derive(Debug)]
pub(super) struct Composed {
    /// Whether these steps are taken at all; unknown until the first stiffness is factorised.
    is_used: Option<bool>,
    /// Failures in a row.
    failures: u32,
    /// Steps that are left to the other way.
    rest: usize,
    /// The largest stiffening of a tie in the last such step (pN/nm).
    stiffest: f64,
    /// Whether they are wanted from starts that are not floppy, too.
    is_wanted: bool,
}

impl Composed {
    pub(super) fn new(options: &NewtonOptions) -> Self {
        // Bodies that are carried go as far as they have to.
        let is_free = options.largest_displacement.is_infinite();
        Self {
            is_used: if is_free { None } else { Some(false) },
            failures: 0,
            rest: 0,
            stiffest: 0.0,
            is_wanted: options.carries_along,
        }
    }

    /// Decides, once, by the stiffness at the start, which has just been factorised; returns whether that has
    /// just been done in favour.
    pub(super) fn begins(&mut self, solver: &Solver) -> bool {
        if self.is_used.is_some() {
            return false;
        }
        let bodies = solver.layout.len();
        let is_floppy = solver.floppy() as f64 >= FLOPPY * bodies as f64;
        let is_used = bodies >= FEWEST
            && (is_floppy || self.is_wanted)
            && solver.layout.groups().is_empty()
            && is_open(&solver.layout, solver.assembly.ties());
        self.is_used = Some(is_used);
        is_used
    }

    /// Whether the next step is one of these.
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
    /// Takes a step in which bodies carry one another along. `None` if none is due or none lowers the energy;
    /// the stiffness is then assembled as it was.
    pub(super) fn compose(
        &mut self,
        solver: &mut Solver,
        interactions: &[Box<dyn Interaction>],
    ) -> Option<(Direction, Taken)> {
        if self.anchor.is_some() || !self.composed.is_due() {
            return None;
        }
        let loads = &self.here.loads;
        solver
            .assembly
            .add_turning(&self.state, loads, &solver.layout);
        let direction = solver.composed_direction(&self.state, &mut self.composed.stiffest);
        let found = direction.and_then(|direction| {
            let taken = self.carry_along(solver, interactions, &direction)?;
            Some((direction, taken))
        });
        self.composed.note(found.is_none());
        if found.is_none() {
            solver.assemble(interactions, &self.state, &self.here.loads);
        }
        found
    }

    /// Goes along a direction, shortened until the energy is lower.
    fn carry_along(
        &mut self,
        solver: &mut Solver,
        interactions: &[Box<dyn Interaction>],
        direction: &Direction,
    ) -> Option<Taken> {
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
                    return Some(taken(direction, fraction, Verdict::Decrease));
                }
                // Where the energy says nothing any more, the other way knows when to end.
                Some(_) => return None,
                None => {}
            }
            fraction *= self.next_factor(direction, fraction).max(SHORTEN);
        }
        None
    }
}

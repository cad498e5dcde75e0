//! Length and acceptance of Newton steps.

mod composed;

use crate::direction::{Direction, Solver};
use crate::evaluation::Evaluation;
use crate::history::Verdict;
use crate::motion::StepSize;
use crate::options::NewtonOptions;
use crate::outcome::SolveError;
use actin_mechanics::{Interaction, State, Vectors};
use composed::ComposedSteps;

/// Sufficient decrease parameter (Armijo).
const ENOUGH: f64 = 1e-4;
/// Relative energy change below which the work of the loads is used instead. The energy of an
/// element is the square of a small strain, with a large relative rounding error.
pub(crate) const ROUND_OFF: f64 = 1e-8;
/// Bounds of the factor that shortens a rejected step.
const SHORTEN: [f64; 2] = [0.05, 0.5];
const SHORTEST: f64 = 1e-12;
/// Fraction of the predicted decrease of a good step.
const GOOD: f64 = 0.5;
/// Maximum displacement relative to the size of the system, to preserve the accuracy of
/// coordinates.
const FARTHEST: f64 = 1e6;
/// Fraction of the predicted decrease below which a step is poor.
const POOR: f64 = 0.25;
/// Stiffening relative to the initial guess below which it is dropped.
const NEGLIGIBLE: f64 = 1e-2;
/// Minimum stiffening with [`MANY`] bodies. Otherwise steps overshoot at some buckling tie and take
/// ten more to return.
const KEPT: f64 = 1.0 / 64.0;
const MANY: usize = 2000;
/// Factor that raises or lowers the stiffening of ties.
const STIFFER: f64 = 4.0;
/// Excess of blocked steps at which a solve ends.
const BLOCKED: usize = 20;
const REACH_GROWTH: f64 = 2.0;

pub(crate) struct AcceptedStep {
    pub(crate) fraction: f64,
    pub(crate) extent: StepSize,
    pub(crate) verdict: Verdict,
}

#[derive(Debug)]
struct Anchor {
    state: State,
    evaluation: Evaluation,
    direction: Direction,
    fraction: f64,
    steps_left: usize,
}

#[derive(Debug)]
pub(crate) struct Descent {
    pub(crate) state: State,
    pub(crate) here: Evaluation,
    trial: State,
    there: Evaluation,
    carried: State,
    beyond: Evaluation,
    anchor: Option<Anchor>,
    pub(crate) size: f64,
    start: Vectors,
    farthest: f64,
    /// Fraction of the step limits in use.
    reach: f64,
    /// Steps before the next excursion.
    rest: usize,
    /// Stiffening per motion (pN/nm^2).
    cubic: f64,
    is_cut: bool,
    /// Twice the blocked steps minus the others.
    blocked: usize,
    composed: ComposedSteps,
    options: NewtonOptions,
}

impl Descent {
    pub(crate) fn new(
        interactions: &[Box<dyn Interaction>],
        state: &State,
        options: &NewtonOptions,
    ) -> Self {
        let here = Evaluation::new(interactions, state);
        let size = size(state);
        Self {
            state: state.clone(),
            start: state.points.position.clone(),
            there: here.clone(),
            carried: state.clone(),
            beyond: here.clone(),
            here,
            trial: state.clone(),
            anchor: None,
            farthest: options
                .largest_displacement
                .min(FARTHEST * size.max(options.turn_length)),
            size,
            reach: 1.0,
            rest: 0,
            cubic: 0.0,
            is_cut: false,
            blocked: 0,
            composed: ComposedSteps::new(options),
            options: *options,
        }
    }

    /// Continues from a state nearby. Bounds of the motion and blocked steps are kept.
    pub(crate) fn restart(&mut self, interactions: &[Box<dyn Interaction>], state: &State) {
        let start = std::mem::take(&mut self.start);
        *self = Self {
            start,
            farthest: self.farthest,
            size: self.size,
            blocked: self.blocked,
            ..Self::new(interactions, state, &self.options)
        };
    }

    /// Returns `true` if the energy must be unbounded.
    pub(crate) fn is_far(&self) -> bool {
        let limit = FARTHEST * self.size.max(self.options.turn_length);
        let positions = self.state.points.position.iter();
        let mut moved = positions.zip(self.start.iter()).map(|(x, from)| x - from);
        moved.any(|moved| moved.norm() > limit)
    }

    pub(crate) fn is_on_excursion(&self) -> bool {
        self.anchor.is_some()
    }

    /// Returns `true` if a recent step was blocked by contact.
    pub(crate) fn is_blocked(&self) -> bool {
        self.blocked > 0
    }

    /// Returns `true` if steps are blocked persistently.
    pub(crate) fn stays_blocked(&self) -> bool {
        self.blocked >= 2 * BLOCKED
    }

    /// Returns `true` on an excursion above its start; the next step then reverts it.
    pub(crate) fn gives_up_excursion(&mut self) -> bool {
        let Some(anchor) = &mut self.anchor else {
            return false;
        };
        let above = self.here.energy_above(&anchor.evaluation);
        let is_lost = above > ROUND_OFF * anchor.evaluation.magnitude.max(self.here.magnitude);
        if is_lost {
            anchor.steps_left = 0;
        }
        is_lost
    }

    pub(crate) fn end_excursion(&mut self) -> bool {
        self.anchor.take().is_some_and(|anchor| {
            self.state = anchor.state;
            self.here = anchor.evaluation;
            true
        })
    }

    /// Takes a step; `None` if none is accepted.
    ///
    /// # Errors
    /// If the stiffness cannot be factorised.
    pub(crate) fn advance(
        &mut self,
        solver: &mut Solver,
        interactions: &[Box<dyn Interaction>],
    ) -> Result<Option<(Direction, AcceptedStep)>, SolveError> {
        self.is_cut = false;
        let found = self.find_step(solver, interactions);
        self.blocked = if self.is_cut {
            self.blocked + 2
        } else {
            self.blocked.saturating_sub(1)
        };
        found
    }

    fn find_step(
        &mut self,
        solver: &mut Solver,
        interactions: &[Box<dyn Interaction>],
    ) -> Result<Option<(Direction, AcceptedStep)>, SolveError> {
        if let Some(found) = self.compose(solver, interactions) {
            return Ok(Some(found));
        }
        let mut plain = solver.factorize(0.0);
        if self.composed.begins(solver) {
            if let Some(found) = self.compose(solver, interactions) {
                return Ok(Some(found));
            }
            plain = solver.factorize(0.0);
        }
        let limits = (self.options.largest_strain, self.cubic);
        let direction = solver.direction(&self.state, plain, limits)?;
        if let Some(accepted_step) = self.attempt(solver, interactions, &direction) {
            return Ok(Some((direction, accepted_step)));
        }
        if let Some(anchor) = &mut self.anchor {
            anchor.steps_left = anchor.steps_left.saturating_sub(1);
            if self.there.is_finite() && anchor.steps_left > 0 {
                self.accept();
                let accepted_step = self.accepted_step(&direction, Verdict::Excursion);
                return Ok(Some((direction, accepted_step)));
            }
            return Ok(self.go_back(solver, interactions));
        }
        let fraction = self.fraction(&direction.extent);
        if self.there.is_finite() && self.options.patience > 0 && self.rest == 0 {
            self.begin_excursion(&direction, fraction);
            let accepted_step = self.accepted_step(&direction, Verdict::Excursion);
            return Ok(Some((direction, accepted_step)));
        }
        self.cubic = (STIFFER * self.cubic).max(solver.least_cubic());
        let accepted_step = self.shorten(solver, interactions, &direction, fraction);
        Ok(accepted_step.map(|accepted_step| (direction, accepted_step)))
    }

    fn attempt(
        &mut self,
        solver: &mut Solver,
        interactions: &[Box<dyn Interaction>],
        direction: &Direction,
    ) -> Option<AcceptedStep> {
        let fraction = self.fraction(&direction.extent);
        self.try_step(solver, interactions, direction, fraction);
        let verdict = self.judge(solver, direction, fraction)?;
        let (reference, promised) = self.reference(direction, fraction);
        let gain = -self.there.energy_above(reference) / promised;
        self.adapt(solver, direction, gain);
        self.accept();
        self.anchor = None;
        self.reach = (self.reach * REACH_GROWTH).min(1.0);
        Some(accepted_step(direction, fraction, verdict))
    }

    fn fraction(&self, extent: &StepSize) -> f64 {
        let part = self.part_of_limits(extent);
        if part > self.reach {
            self.reach / part
        } else {
            1.0
        }
    }

    fn part_of_limits(&self, extent: &StepSize) -> f64 {
        (extent.rotation / self.options.largest_rotation)
            .max(extent.strain / self.options.largest_strain)
            .max(extent.displacement / self.farthest)
    }

    fn accepted_step(&self, direction: &Direction, verdict: Verdict) -> AcceptedStep {
        accepted_step(direction, self.fraction(&direction.extent), verdict)
    }

    fn try_step(
        &mut self,
        solver: &mut Solver,
        interactions: &[Box<dyn Interaction>],
        direction: &Direction,
        fraction: f64,
    ) {
        let layout = &solver.layout;
        self.trial.clone_from(&self.state);
        layout.apply(&mut self.trial, &direction.step, fraction);
        self.there.follow(interactions, (&self.state, &self.trial));
        let velocities = layout.velocities(&self.state, &direction.step);
        self.carried.clone_from(&self.trial);
        let chain = solver.assembly.chain();
        chain.carry(&self.state, &velocities, fraction, &mut self.carried);
        self.beyond
            .follow(interactions, (&self.state, &self.carried));
        solver.work.evaluations += 2;
        if self.beyond.is_finite() && is_lower(&self.beyond, &self.there) {
            std::mem::swap(&mut self.trial, &mut self.carried);
            std::mem::swap(&mut self.there, &mut self.beyond);
        }
        self.is_cut |= self.there.has_passed();
    }

    /// `None` if the trial state is rejected.
    fn judge(&self, solver: &Solver, direction: &Direction, fraction: f64) -> Option<Verdict> {
        if !self.there.is_finite() {
            return None;
        }
        let predicted = predicted_decrease(direction, fraction);
        let (reference, promised) = self.reference(direction, fraction);
        let change = self.there.energy_above(reference);
        if change <= -ENOUGH * promised && change < 0.0 {
            return Some(Verdict::Decrease);
        }
        let magnitude = self.there.magnitude.max(reference.magnitude);
        let hidden = self.anchor.is_none()
            && predicted <= ROUND_OFF * magnitude
            && change.abs() <= ROUND_OFF * magnitude;
        (hidden && self.is_better_in_loads(solver, direction, fraction))
            .then_some(Verdict::RoundOff)
    }

    fn reference(&self, direction: &Direction, fraction: f64) -> (&Evaluation, f64) {
        match &self.anchor {
            Some(anchor) => (
                &anchor.evaluation,
                predicted_decrease(&anchor.direction, anchor.fraction),
            ),
            None => (&self.here, predicted_decrease(direction, fraction)),
        }
    }

    /// Adapts the stiffening to the ratio of actual to predicted decrease.
    fn adapt(&mut self, solver: &Solver, direction: &Direction, gain: f64) {
        let least = solver.least_cubic();
        let present = direction.cubic.max(self.cubic);
        self.cubic = if gain < POOR {
            (STIFFER * present).max(least)
        } else if gain < GOOD {
            present
        } else {
            let is_negligible = present <= NEGLIGIBLE * least;
            let lowered = if is_negligible {
                0.0
            } else {
                present / STIFFER
            };
            let is_kept = solver.layout.len() >= MANY;
            let kept = if is_kept { KEPT * least } else { 0.0 };
            lowered.max(kept.min(present))
        };
    }

    /// The work of the loads is positive (trapezoidal rule), and the loads are smaller at the end.
    fn is_better_in_loads(&self, solver: &Solver, direction: &Direction, fraction: f64) -> bool {
        let there = solver.work_along(&self.there.loads, &direction.step);
        let work = 0.5 * fraction * (direction.slope + there);
        there.abs() <= direction.slope && work >= ENOUGH * predicted_decrease(direction, fraction)
    }

    fn accept(&mut self) {
        let decreased = self.there.energy_above(&self.here) <= 0.0;
        std::mem::swap(&mut self.state, &mut self.trial);
        std::mem::swap(&mut self.here, &mut self.there);
        self.rest = self.rest.saturating_sub(usize::from(decreased));
    }

    fn begin_excursion(&mut self, direction: &Direction, fraction: f64) {
        self.anchor = Some(Anchor {
            state: self.state.clone(),
            evaluation: self.here.clone(),
            direction: direction.clone(),
            fraction,
            steps_left: self.options.patience,
        });
        self.accept();
    }

    fn go_back(
        &mut self,
        solver: &mut Solver,
        interactions: &[Box<dyn Interaction>],
    ) -> Option<(Direction, AcceptedStep)> {
        let anchor = self.anchor.take()?;
        self.state = anchor.state;
        self.here = anchor.evaluation;
        self.rest = self.options.patience;
        let mut accepted_step =
            self.shorten(solver, interactions, &anchor.direction, anchor.fraction)?;
        accepted_step.verdict = Verdict::Return;
        Some((anchor.direction, accepted_step))
    }

    fn shorten(
        &mut self,
        solver: &mut Solver,
        interactions: &[Box<dyn Interaction>],
        direction: &Direction,
        refused: f64,
    ) -> Option<AcceptedStep> {
        let mut fraction = refused;
        let mut factor = SHORTEN[1];
        loop {
            fraction *= factor;
            // Also ends at underflow and NaN.
            let is_worth_trying = fraction > SHORTEST * refused.min(1.0);
            if !is_worth_trying {
                return None;
            }
            self.try_step(solver, interactions, direction, fraction);
            if let Some(verdict) = self.judge(solver, direction, fraction) {
                self.accept();
                let accepted_step = accepted_step(direction, fraction, verdict);
                let part = self.part_of_limits(&accepted_step.extent);
                self.reach = (REACH_GROWTH * part).clamp(SHORTEST, 1.0);
                return Some(accepted_step);
            }
            factor = self.next_factor(direction, fraction);
        }
    }

    /// Minimum of the parabola through both energies and the initial slope.
    fn next_factor(&self, direction: &Direction, fraction: f64) -> f64 {
        let change = self.there.energy_above(&self.here);
        let descent = fraction * direction.slope;
        let factor = 0.5 * descent / (change + descent);
        if factor.is_finite() {
            factor.clamp(SHORTEN[0], SHORTEN[1])
        } else {
            SHORTEN[0]
        }
    }
}

fn is_lower(a: &Evaluation, b: &Evaluation) -> bool {
    let difference = a.energy_above(b);
    difference.is_nan() || difference < 0.0
}

/// Quadratic model.
fn predicted_decrease(direction: &Direction, fraction: f64) -> f64 {
    fraction * (direction.slope - 0.5 * fraction * direction.curvature)
}

/// Largest distance of a point from the first one.
fn size(state: &State) -> f64 {
    let mut positions = state.points.position.iter();
    let Some(first) = positions.next() else {
        return 0.0;
    };
    positions.map(|x| (x - first).norm()).fold(0.0, f64::max)
}

fn accepted_step(direction: &Direction, fraction: f64, verdict: Verdict) -> AcceptedStep {
    AcceptedStep {
        fraction,
        extent: direction.extent.scaled(fraction),
        verdict,
    }
}

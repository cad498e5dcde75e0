//! How far to go along a direction, and whether to accept where it leads.

mod composed;

use crate::direction::{Direction, Solver};
use crate::evaluation::Evaluation;
use crate::history::Verdict;
use crate::motion::StepSize;
use crate::options::NewtonOptions;
use crate::outcome::SolveError;
use actin_mechanics::{Interaction, State, Vectors};
use composed::Composed;

/// Part of the predicted decrease that is enough (Armijo).
const ENOUGH: f64 = 1e-4;
/// Changes of energy below this part of the sum of absolute energies are judged by the work of
/// the loads instead. An element's energy is a square of a small strain, so that its relative
/// round-off is that of the strain: much larger than one rounding.
const ROUND_OFF: f64 = 1e-8;
/// Bounds of the factor by which a refused step is shortened.
const SHORTEN: [f64; 2] = [0.05, 0.5];
/// Steps shortened by more than this are useless.
const SHORTEST: f64 = 1e-12;
/// Part of the predicted decrease that makes a step a good one.
const GOOD: f64 = 0.5;
/// Largest displacement in a step, in sizes of the whole: unconstrained directions must not fly so
/// far that its coordinates lose all digits.
const FARTHEST: f64 = 1e6;
/// Below this part of the predicted decrease a step is a poor one.
const POOR: f64 = 0.25;
/// Stiffening below this part of the first guess is dropped.
const NEGLIGIBLE: f64 = 1e-2;
/// Part of the first guess that is kept where there are [`MANY`] bodies. Among so many some tie is always
/// about to give way far: without stiffening a step overshoots there and takes ten more to come back,
/// all of them steps of the whole. With it steps are still quadratic near the end, since the
/// stiffness of a tie goes with its motion.
const KEPT: f64 = 1.0 / 64.0;
/// So many points, frames and groups are many.
const MANY: usize = 2000;
/// Factor by which the stiffening of ties is raised and lowered.
const STIFFER: f64 = 4.0;
/// A solve ends when of its steps so many more than half of the others are cut short since bodies would
/// pass through each other: on a way around something few are.
const BLOCKED: usize = 20;
/// Growth of the reach after a step that was accepted at once.
const REACH_GROWTH: f64 = 2.0;

/// A step that was taken.
pub(crate) struct Taken {
    pub(crate) fraction: f64,
    pub(crate) extent: StepSize,
    pub(crate) verdict: Verdict,
}

/// Where an excursion began.
#[derive(Debug)]
struct Anchor {
    state: State,
    evaluation: Evaluation,
    direction: Direction,
    fraction: f64,
    steps_left: usize,
}

/// The present state and the search for a lower one.
#[derive(Debug)]
pub(crate) struct Descent {
    pub(crate) state: State,
    pub(crate) here: Evaluation,
    trial: State,
    there: Evaluation,
    /// The trial state in which bodies carry one another along.
    carried: State,
    beyond: Evaluation,
    anchor: Option<Anchor>,
    /// The largest distance of a point from the first one at the start (nm).
    pub(crate) size: f64,
    /// Positions at the start.
    start: Vectors,
    /// Largest displacement in a step (nm).
    farthest: f64,
    /// Part of the step limits that is used at present.
    reach: f64,
    /// Steps during which no excursion is begun, since the last one did not pay.
    rest: usize,
    /// How much ties are stiffened per motion (pN/nm^2).
    cubic: f64,
    /// Whether the present step led bodies through each other and was cut short.
    is_cut: bool,
    /// Twice the steps of which that is so, less those of which it is not.
    blocked: usize,
    /// Steps of a far start.
    composed: Composed,
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
            composed: Composed::new(options),
            options: *options,
        }
    }

    /// Whether a body has gone so far that only a motion without end leads there.
    pub(crate) fn is_far(&self) -> bool {
        let limit = FARTHEST * self.size.max(self.options.turn_length);
        let positions = self.state.points.position.iter();
        let mut moved = positions.zip(self.start.iter()).map(|(x, from)| x - from);
        moved.any(|moved| moved.norm() > limit)
    }

    pub(crate) fn is_on_excursion(&self) -> bool {
        self.anchor.is_some()
    }

    /// Whether one of the last steps was cut short since bodies would have passed through each other.
    pub(crate) fn is_blocked(&self) -> bool {
        self.blocked > 0
    }

    /// Whether this has gone on for so long that it will not end.
    pub(crate) fn stays_blocked(&self) -> bool {
        self.blocked >= 2 * BLOCKED
    }

    /// Whether this is an excursion that is above where it began; if so, its next step goes back.
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

    /// Goes back to where an excursion began, if there is one.
    pub(crate) fn end_excursion(&mut self) -> bool {
        self.anchor.take().is_some_and(|anchor| {
            self.state = anchor.state;
            self.here = anchor.evaluation;
            true
        })
    }

    /// Takes a step from the present state, whose stiffness is assembled; `None` if none helps.
    ///
    /// # Errors
    /// If the stiffness cannot be factorised.
    pub(crate) fn advance(
        &mut self,
        solver: &mut Solver,
        interactions: &[Box<dyn Interaction>],
    ) -> Result<Option<(Direction, Taken)>, SolveError> {
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
    ) -> Result<Option<(Direction, Taken)>, SolveError> {
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
        if let Some(taken) = self.attempt(solver, interactions, &direction) {
            return Ok(Some((direction, taken)));
        }
        if let Some(anchor) = &mut self.anchor {
            anchor.steps_left = anchor.steps_left.saturating_sub(1);
            if self.there.is_finite() && anchor.steps_left > 0 {
                self.accept();
                let taken = self.taken(&direction, Verdict::Excursion);
                return Ok(Some((direction, taken)));
            }
            return Ok(self.go_back(solver, interactions));
        }
        let fraction = self.fraction(&direction.extent);
        if self.there.is_finite() && self.options.patience > 0 && self.rest == 0 {
            self.begin_excursion(&direction, fraction);
            let taken = self.taken(&direction, Verdict::Excursion);
            return Ok(Some((direction, taken)));
        }
        self.cubic = (STIFFER * self.cubic).max(solver.least_cubic());
        let taken = self.shorten(solver, interactions, &direction, fraction);
        Ok(taken.map(|taken| (direction, taken)))
    }

    /// The step along `direction`, within the limits, if it is good enough.
    fn attempt(
        &mut self,
        solver: &mut Solver,
        interactions: &[Box<dyn Interaction>],
        direction: &Direction,
    ) -> Option<Taken> {
        let fraction = self.fraction(&direction.extent);
        self.try_step(solver, interactions, direction, fraction);
        let verdict = self.judge(solver, direction, fraction)?;
        let (reference, promised) = self.reference(direction, fraction);
        let gain = -self.there.energy_above(reference) / promised;
        self.adapt(solver, direction, gain);
        self.accept();
        self.anchor = None;
        self.reach = (self.reach * REACH_GROWTH).min(1.0);
        Some(taken(direction, fraction, verdict))
    }

    /// The part of a step within the limits.
    fn fraction(&self, extent: &StepSize) -> f64 {
        let part = self.part_of_limits(extent);
        if part > self.reach {
            self.reach / part
        } else {
            1.0
        }
    }

    /// The extent of a step relative to the limits.
    fn part_of_limits(&self, extent: &StepSize) -> f64 {
        (extent.rotation / self.options.largest_rotation)
            .max(extent.strain / self.options.largest_strain)
            .max(extent.displacement / self.farthest)
    }

    fn taken(&self, direction: &Direction, verdict: Verdict) -> Taken {
        taken(direction, self.fraction(&direction.extent), verdict)
    }

    /// Evaluates the state at `fraction` of the step: the lower one of that in which each body
    /// goes straight and that in which it is carried along by the one before it.
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

    /// Whether the trial state is good enough, and why.
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

    /// What a step is compared with: where it began, or where the excursion did, and the decrease
    /// that was promised there.
    fn reference(&self, direction: &Direction, fraction: f64) -> (&Evaluation, f64) {
        match &self.anchor {
            Some(anchor) => (
                &anchor.evaluation,
                predicted_decrease(&anchor.direction, anchor.fraction),
            ),
            None => (&self.here, predicted_decrease(direction, fraction)),
        }
    }

    /// Raises or lowers the stiffening of ties by what part of the promised decrease was gained.
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

    /// Whether the loads do work along the step, by the trapezoidal rule, and push less at its
    /// end than at its beginning.
    fn is_better_in_loads(&self, solver: &Solver, direction: &Direction, fraction: f64) -> bool {
        let there = solver.work_along(&self.trial, &self.there.loads, &direction.step);
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

    /// Returns to where the excursion began and takes a shorter step there.
    fn go_back(
        &mut self,
        solver: &mut Solver,
        interactions: &[Box<dyn Interaction>],
    ) -> Option<(Direction, Taken)> {
        let anchor = self.anchor.take()?;
        self.state = anchor.state;
        self.here = anchor.evaluation;
        self.rest = self.options.patience;
        let mut taken = self.shorten(solver, interactions, &anchor.direction, anchor.fraction)?;
        taken.verdict = Verdict::Return;
        Some((anchor.direction, taken))
    }

    /// Shortens a refused step until it is accepted; `None` if it never is.
    fn shorten(
        &mut self,
        solver: &mut Solver,
        interactions: &[Box<dyn Interaction>],
        direction: &Direction,
        refused: f64,
    ) -> Option<Taken> {
        let mut fraction = refused;
        let mut factor = SHORTEN[1];
        loop {
            fraction *= factor;
            // Written so that a fraction that has underflown, or is not a number, ends this too.
            let is_worth_trying = fraction > SHORTEST * refused.min(1.0);
            if !is_worth_trying {
                return None;
            }
            self.try_step(solver, interactions, direction, fraction);
            if let Some(verdict) = self.judge(solver, direction, fraction) {
                self.accept();
                let taken = taken(direction, fraction, verdict);
                let part = self.part_of_limits(&taken.extent);
                self.reach = (REACH_GROWTH * part).clamp(SHORTEST, 1.0);
                return Some(taken);
            }
            factor = self.next_factor(direction, fraction);
        }
    }

    /// The minimum of the parabola through energy and slope here and energy there, in bounds.
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

/// Whether the energy of `a` is below that of `b`; anything is below what is not a number.
fn is_lower(a: &Evaluation, b: &Evaluation) -> bool {
    let difference = a.energy_above(b);
    difference.is_nan() || difference < 0.0
}

/// Decrease of the quadratic model over `fraction` of a step.
fn predicted_decrease(direction: &Direction, fraction: f64) -> f64 {
    fraction * (direction.slope - 0.5 * fraction * direction.curvature)
}

/// The largest distance of a point from the first one.
fn size(state: &State) -> f64 {
    let mut positions = state.points.position.iter();
    let Some(first) = positions.next() else {
        return 0.0;
    };
    positions.map(|x| (x - first).norm()).fold(0.0, f64::max)
}

fn taken(direction: &Direction, fraction: f64, verdict: Verdict) -> Taken {
    Taken {
        fraction,
        extent: direction.extent.scaled(fraction),
        verdict,
    }
}

//! Steps of a path: which ones are accepted, and the length of the next one.

use super::{Set, Walk};
use crate::motion::StepSize;
use crate::outcome::Equilibrium;
use crate::path_observer::Snap;
use crate::path_options::{Jumps, PathOptions, Saddles};
use actin_mechanics::State;

/// Ratio of the motion in a step to the extrapolated motion above which the step is a jump. Before
/// a limit point the ratio is smaller.
const SUDDEN: f64 = 4.0;
/// Motion (rad, or strain) below which a step is not a jump. An example is the sudden but small
/// bending at a critical load.
const SMALL_MOTION: f64 = 0.1;
/// Motion (rad, or strain) below which the direction is not compared with the prediction.
const NEGLIGIBLE_MOTION: f64 = 1e-3;
/// Component of a motion normal to the prediction, as a fraction, above which the step deviates.
pub(super) const UNEXPLAINED: f64 = 0.5;
/// Difference of a refused step and its half in proportion, as a fraction, below which the path is straight.
const STRAIGHT: f64 = 0.15;
/// Ratio of the motion up to a refused step to the extrapolated motion that indicates a snap.
const OUT_OF_PROPORTION: f64 = 2.0;
/// Part of the largest motion that a longer step is expected to make.
const NEARLY: f64 = 0.9;

pub(super) struct Trial {
    pub(super) parameter: f64,
    pub(super) state: State,
    pub(super) equilibrium: Equilibrium,
    pub(super) moved: StepSize,
}

/// Refused trials of a step, each shorter than the one before.
#[derive(Default)]
pub(super) struct Refused {
    /// First trial off course.
    pub(super) off_course: Option<Trial>,
    /// Last trial, unless it is the first one off course.
    later: Option<Trial>,
}

impl Refused {
    fn last(&self) -> Option<&Trial> {
        self.later.as_ref().or(self.off_course.as_ref())
    }

    pub(super) fn push(&mut self, trial: Trial, is_off_course: bool) {
        if is_off_course && self.off_course.is_none() {
            (self.off_course, self.later) = (Some(trial), None);
        } else {
            self.later = Some(trial);
        }
    }
}

impl Walk<'_> {
    /// Deviation of a step from the direction of the last refused step, at least twice as long, if the path is straight
    /// up to there: the difference of that step and this one in proportion, as a fraction. It is 1 if both only cross
    /// the same snap.
    pub(super) fn straightness(
        &self,
        state: &State,
        trial: &Trial,
        refused: &Refused,
    ) -> Option<f64> {
        let larger = refused.last()?;
        let ratio = (larger.parameter - self.at.parameter) / (trial.parameter - self.at.parameter);
        let layout = self.newton.layout();
        let [way, whole] = [trial, larger].map(|to| layout.difference(state, &to.state));
        let squares = whole.iter().zip(&way).zip(&self.newton.solver.metric);
        let [off, all] = squares.fold([0.0; 2], |[off, all], ((whole, way), m)| {
            [
                off + m * (whole - ratio * way).powi(2),
                all + m * whole * whole,
            ]
        });
        let deviation = (off / all.max(f64::MIN_POSITIVE)).sqrt();
        (deviation < STRAIGHT).then_some(deviation)
    }

    /// Sets the snap between an accepted step and a larger refused one, and removes an earlier one that is not ahead.
    pub(super) fn watch_snap(&mut self, trial: &Trial, refused: &Refused, jumped: bool) {
        let known = self.at.snap.filter(|_| !jumped);
        let found = refused.last().filter(|_| !jumped).map(|behind| Snap {
            parameter: behind.parameter,
            motion: motion(&behind.moved),
            is_small: refused.off_course.is_some() || known.is_some_and(|known| known.is_small),
        });
        let moved = motion(&trial.moved);
        let rate = moved / (trial.parameter - self.at.parameter);
        let ahead = |snap: Snap| {
            let (way, left) = (snap.parameter - trial.parameter, snap.motion - moved);
            let is_ahead = way > 0.0 && left > OUT_OF_PROPORTION * rate * way;
            is_ahead.then_some(Snap {
                motion: left,
                ..snap
            })
        };
        self.at.snap = found.and_then(ahead).or_else(|| known.and_then(ahead));
    }

    /// Returns whether a step towards a small snap is within the largest motions: it is too sudden only because it is
    /// short.
    fn is_small_snap(&self, trial: &Trial) -> bool {
        !self.is_too_large(trial) && self.at.snap.is_some_and(|snap| snap.is_small)
    }

    fn is_too_large(&self, trial: &Trial) -> bool {
        trial.moved.rotation > self.options.largest_turn
            || trial.moved.strain > self.options.largest_strain
    }

    pub(super) fn trial(
        &self,
        last: &State,
        parameter: f64,
        state: State,
        equilibrium: Equilibrium,
    ) -> Trial {
        let solver = &self.newton.solver;
        let extent = solver
            .layout
            .step_extent(&solver.layout.difference(last, &state));
        let moved = StepSize {
            strain: solver.assembly.ties().strain_between(last, &state),
            ..extent
        };
        Trial {
            parameter,
            state,
            equilibrium,
            moved,
        }
    }

    pub(super) fn continuation(&self, trial: &Trial, deviation: f64) -> Continuation {
        let is_smallest = self.at.step <= self.options.smallest_step;
        let far = self.is_too_large(trial) || self.is_sudden(trial);
        let unexplained = deviation > UNEXPLAINED;
        let keeps_saddles = self.options.saddles == Saddles::Keep;
        let accepts_jumps = is_smallest && self.options.jumps == Jumps::Accept;
        if accepts_jumps || !far && (!unexplained || is_smallest || keeps_saddles) {
            let jumped = far || unexplained;
            return Continuation::Accepted { jumped };
        }
        if far && !(is_smallest && self.is_small_snap(trial)) {
            Continuation::Far
        } else {
            Continuation::OffCourse
        }
    }

    /// Motion per parameter in the last step, unless it was a jump.
    fn secant(&self, state: &State) -> Option<Vec<f64>> {
        let (previous, before) = self.at.previous.as_ref()?;
        let from = state.in_motion(previous.clone());
        let way = self.newton.layout().difference(&from, state);
        let stretch = self.at.parameter - before;
        Some(way.into_iter().map(|way| way / stretch).collect())
    }

    /// Motion per parameter by linear response; `None` if the stiffness is not positive definite.
    fn linear_response(&mut self, state: &State, set: Set<'_>) -> Option<Vec<f64>> {
        let solver = &mut self.newton.solver;
        solver.prepare(state, self.interactions).ok()?;
        if solver.has_weak_mode() {
            return None;
        }
        let mut moved = state.clone();
        let step = self.options.smallest_step;
        set(&mut moved, self.at.parameter + step);
        let after = self.newton.generalised_loads(&moved, self.interactions);
        let solver = &mut self.newton.solver;
        solver.work.evaluations += 1;
        let loads = after.iter().zip(&solver.reduced);
        let mut rate: Vec<f64> = loads.map(|(a, b)| (a - b) / step).collect();
        solver.factorize(0.0);
        solver.solve(&mut rate);
        Some(rate)
    }

    /// Fraction of the motion that deviates from the secant, or from the linear response without a
    /// secant. Near a limit point the linear response is too large to detect a small snap.
    pub(super) fn deviation(&mut self, state: &State, trial: &Trial, set: Set<'_>) -> f64 {
        if trial.equilibrium.saddles_left > 0 || motion(&trial.moved) <= NEGLIGIBLE_MOTION {
            return 0.0;
        }
        if let Some(secant) = self.secant(state) {
            return self.deviation_from(&secant, state, trial);
        }
        if self.response.is_none() {
            self.response = self.linear_response(state, set);
        }
        let response = self.response.as_deref();
        response.map_or(0.0, |rate| self.deviation_from(rate, state, trial))
    }

    /// Fraction of the motion normal to `rate`.
    fn deviation_from(&self, rate: &[f64], state: &State, trial: &Trial) -> f64 {
        let way = self.newton.layout().difference(state, &trial.state);
        let metric = &self.newton.solver.metric;
        let product = |a: &[f64], b: &[f64]| -> f64 {
            let terms = a.iter().zip(b).zip(metric);
            terms.map(|((a, b), m)| m * a * b).sum()
        };
        let along = product(&way, rate) / product(rate, rate).max(f64::MIN_POSITIVE);
        let along = along.clamp(0.0, SUDDEN * (trial.parameter - self.at.parameter));
        let off: Vec<f64> = way.iter().zip(rate).map(|(w, r)| w - along * r).collect();
        (product(&off, &off) / product(&way, &way).max(f64::MIN_POSITIVE)).sqrt()
    }

    /// Detects snap-through. Motions off a saddle are always large and not tested.
    fn is_sudden(&self, trial: &Trial) -> bool {
        let motion = motion(&trial.moved);
        let stretch = trial.parameter - self.at.parameter;
        let expected = self.at.rate.map(|rate| rate * stretch);
        trial.equilibrium.saddles_left == 0
            && motion > SMALL_MOTION
            && expected.is_some_and(|expected| motion > SUDDEN * expected)
    }

    /// Chooses the next step; along a smooth path the deviation increases with the step. Steps are not expected to
    /// exceed the largest motion, and bisect the distance to a snap.
    pub(super) fn adapt(&mut self, trial: &Trial, deviation: f64) {
        let PathOptions {
            smallest_step: smallest,
            largest_turn,
            largest_strain,
            ..
        } = *self.options;
        let iterations = trial.equilibrium.history.len();
        let at = &mut self.at;
        if iterations <= self.options.easy && deviation < 0.5 * UNEXPLAINED {
            let moved = &trial.moved;
            let room = (largest_turn / moved.rotation).min(largest_strain / moved.strain);
            let stretch = trial.parameter - at.parameter;
            at.step = (2.0 * at.step).min((NEARLY * room * stretch).max(at.step));
        } else if iterations > self.options.hard {
            at.step *= 0.5;
        }
        if let Some(snap) = at.snap {
            at.step = at.step.min(0.5 * (snap.parameter - trial.parameter));
        }
        at.step = at.step.clamp(smallest, self.options.largest_step);
    }
}

pub(super) enum Continuation {
    Accepted { jumped: bool },
    OffCourse,
    Far,
}

/// Maximum of the largest rotation and the largest relative motion of neighbours.
pub(super) fn motion(moved: &StepSize) -> f64 {
    moved.rotation.max(moved.strain)
}

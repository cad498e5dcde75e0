//! Equilibria along a path of controls, with automatic steps.
//!
//! Steps shrink where Newton fails, or where the equilibrium moves too far or otherwise than the path
//! predicts, and grow where iterations are few. At a limit point, beyond which there is no equilibrium near by, the steps shrink to the
//! smallest and the path ends with a report of the last equilibrium.

use crate::evaluation::{Evaluation, passes_through};
use crate::history::SolverWork;
use crate::motion::StepSize;
use crate::newton::Newton;
use crate::options::OptionsError;
use crate::outcome::{Equilibrium, NewtonFailure, SolveError};
use crate::path_observer::{PathCheckpoint, PathObserver, PathPoint};
use crate::path_options::{Jumps, PathOptions, Saddles};
use actin_mechanics::{Interaction, State};
use std::ops::ControlFlow;
use thiserror::Error;

/// Motion over what the last step lets expect that makes a step a jump. Before a limit point
/// motion goes with the square root of the distance, which is less sudden.
const SUDDEN: f64 = 4.0;
/// Motion (rad, or strain of neighbours) below which nothing is a jump: the bend of a filament
/// with a tiny imperfection at its critical load grows suddenly, too, but stays small in a step.
const SMALL_MOTION: f64 = 0.1;
/// Motion (rad, or strain of neighbours) below which it does not matter whether it was predicted.
const NEGLIGIBLE_MOTION: f64 = 1e-3;
/// Share of a motion that is not along the predicted one, above which the motion is unexplained.
const UNEXPLAINED: f64 = 0.5;

/// A path of controls, from parameter 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Path(PathOptions);

/// The end of a path that was followed to parameter 1.
#[derive(Clone, Debug, PartialEq)]
pub struct PathEnd {
    /// The last equilibrium.
    pub equilibrium: Equilibrium,
    /// Equilibria on the path, the first and the last included.
    pub points: usize,
    /// Steps that were tried and made again with a smaller one.
    pub refused: usize,
    /// What all of it took.
    pub work: SolverWork,
}

/// Why a path ended before parameter 1.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum PathError {
    /// No equilibrium was found at the next parameter.
    #[error("{0}")]
    NoEquilibrium(Box<NewtonFailure>),
    /// What is set at the next parameter leads bodies through each other that an interaction keeps apart.
    #[error("what is set there leads through what an interaction keeps away")]
    PassesThrough,
    /// The next equilibrium is a saddle.
    #[error("the equilibrium loses its stability: {negative} negative eigenvalue(s)")]
    Unstable {
        /// Number of negative eigenvalues.
        negative: usize,
    },
    /// The next equilibrium is far away: a limit point, or a branch that ends.
    #[error(
        "the next equilibrium is far away: a body turns by {:.2} rad, neighbours move by {:.2} \
         of their distance", .0.rotation, .0.strain
    )]
    Jump(StepSize),
    /// The observer asked for the end.
    #[error("the observer asked for the end")]
    Interrupted,
}

/// A path that was not followed to its end.
///
/// The state that was passed in is the last equilibrium reached.
#[derive(Clone, Debug, PartialEq, Error)]
#[error(
    "the path ends at {parameter:.6} of 1; at {attempted:.6}: {cause}; the last equilibrium was kept"
)]
pub struct PathFailure {
    /// Parameter of the last equilibrium.
    pub parameter: f64,
    /// Parameter that was tried in vain.
    pub attempted: f64,
    /// The last equilibrium; `None` if there is none even at parameter 0.
    pub equilibrium: Option<Equilibrium>,
    /// Why the path ended.
    pub cause: PathError,
    /// Equilibria on the path.
    pub points: usize,
    /// What all of it took.
    pub work: SolverWork,
}

impl Path {
    /// A path.
    ///
    /// # Errors
    /// If an option makes no sense.
    pub fn new(options: PathOptions) -> Result<Self, OptionsError> {
        options.check()?;
        Ok(Self(options))
    }

    /// Follows the equilibria of `state` from parameter 0 to 1.
    ///
    /// `set` puts controls and held bodies where they belong at a parameter. It is given a state
    /// near the last equilibrium and leaves free bodies alone; of a group that slides it changes
    /// what is prescribed and keeps what is free (the component along the direction, say).
    /// `observe` sees every equilibrium and may end the path.
    ///
    /// # Errors
    /// If the path cannot be followed to its end; `state` is then the last equilibrium.
    pub fn follow(
        &self,
        newton: &mut Newton,
        state: &mut State,
        interactions: &[Box<dyn Interaction>],
        set: &mut dyn FnMut(&mut State, f64),
        observe: &mut dyn FnMut(&PathPoint<'_>) -> ControlFlow<()>,
    ) -> Result<PathEnd, Box<PathFailure>> {
        self.follow_from(None, newton, state, interactions, set, &mut &mut *observe)
    }

    /// The same with a companion who may end the path within a solve, too, and from `waypoint` on
    /// if there is one: `state` is then the equilibrium there, which is not shown again. What
    /// follows is the same to the bit as in the path that was left.
    ///
    /// Work and the number of points count on from the waypoint; `newton` counts from where it
    /// stands (see [`Newton::count_on`]).
    ///
    /// # Errors
    /// If the path cannot be followed to its end; `state` is then the last equilibrium.
    pub fn follow_from(
        &self,
        waypoint: Option<&PathCheckpoint>,
        newton: &mut Newton,
        state: &mut State,
        interactions: &[Box<dyn Interaction>],
        set: &mut dyn FnMut(&mut State, f64),
        companion: &mut dyn PathObserver,
    ) -> Result<PathEnd, Box<PathFailure>> {
        let before = newton.work();
        let mut walk = Walk::new(&self.0, waypoint, newton, interactions);
        let result = walk.finish(state, set, companion);
        let PathCheckpoint {
            points,
            refused,
            parameter,
            ..
        } = walk.at;
        let last = walk.last.take();
        let work = walk.newton.work().since(&before);
        match (result, last) {
            (Ok(()), Some(equilibrium)) => Ok(PathEnd {
                equilibrium,
                points,
                refused,
                work,
            }),
            (Err((attempted, cause)), equilibrium) => Err(Box::new(PathFailure {
                parameter,
                attempted,
                equilibrium,
                cause,
                points,
                work,
            })),
            (Ok(()), None) => unreachable!("a path that was followed has an equilibrium"),
        }
    }
}

type Set<'a> = &'a mut dyn FnMut(&mut State, f64);

/// A path while it is followed.
struct Walk<'a> {
    options: &'a PathOptions,
    newton: &'a mut Newton,
    interactions: &'a [Box<dyn Interaction>],
    at: PathCheckpoint,
    last: Option<Equilibrium>,
    /// Linear response at the last equilibrium, once computed.
    response: Option<Vec<f64>>,
}

/// An equilibrium that may be the next point of a path.
struct Trial {
    parameter: f64,
    state: State,
    equilibrium: Equilibrium,
    /// Distance from the last point.
    moved: StepSize,
}

impl<'a> Walk<'a> {
    fn new(
        options: &'a PathOptions,
        waypoint: Option<&PathCheckpoint>,
        newton: &'a mut Newton,
        interactions: &'a [Box<dyn Interaction>],
    ) -> Self {
        Self {
            options,
            newton,
            interactions,
            at: waypoint.map_or_else(|| PathCheckpoint::start(options), PathCheckpoint::clone),
            last: None,
            response: None,
        }
    }

    fn finish(
        &mut self,
        state: &mut State,
        set: Set<'_>,
        companion: &mut dyn PathObserver,
    ) -> Result<(), (f64, PathError)> {
        if self.at.points == 0 {
            let mut first = state.clone();
            set(&mut first, 0.0);
            let equilibrium = self
                .solve(&mut first, companion)
                .map_err(|cause| (0.0, cause))?;
            let first = self.trial(state, 0.0, first, equilibrium);
            self.arrive(state, first, false, companion)?;
        } else {
            self.settle_order(state);
        }
        while self.at.parameter < 1.0 {
            self.advance(state, set, companion)?;
        }
        Ok(())
    }

    /// Settles the order of unknowns where a path is resumed: differences of states are compared across solves. It
    /// counts no evaluation.
    fn settle_order(&mut self, state: &State) {
        let before = self.newton.work();
        self.newton.settle_order(state, self.interactions);
        self.newton.count_on(SolverWork {
            evaluations: before.evaluations,
            assemblies: before.assemblies,
            ..self.newton.work()
        });
    }

    /// One step, made smaller until it succeeds.
    ///
    /// A step that is near, but that the direction of the path does not explain, is made smaller too. Where this
    /// ends in no equilibrium, the step is taken as it was, and counts as a jump.
    fn advance(
        &mut self,
        state: &mut State,
        set: Set<'_>,
        companion: &mut dyn PathObserver,
    ) -> Result<(), (f64, PathError)> {
        let mut off_course = None;
        loop {
            let next = self.next_parameter();
            let is_smallest = self.at.step <= self.options.smallest_step;
            let cause = match self.attempt(state, next, set, companion) {
                Ok(trial) => {
                    let deviation = self.deviation(state, &trial, set);
                    let cause = PathError::Jump(trial.moved);
                    match self.continuation(&trial, deviation) {
                        Continuation::Accepted { jumped } => {
                            self.adapt(&trial.equilibrium, deviation);
                            return self.arrive(state, trial, jumped, companion);
                        }
                        Continuation::OffCourse if off_course.is_none() => {
                            off_course = Some(trial);
                        }
                        Continuation::OffCourse | Continuation::Far => {}
                    }
                    cause
                }
                Err(cause) => cause,
            };
            if cause == PathError::Interrupted {
                return Err((next, cause));
            }
            if is_smallest {
                let Some(trial) = off_course else {
                    return Err((next, self.lost_stability(state, next, set).unwrap_or(cause)));
                };
                self.at.step = trial.parameter - self.at.parameter;
                self.adapt(&trial.equilibrium, UNEXPLAINED);
                return self.arrive(state, trial, true, companion);
            }
            let at = &mut self.at;
            at.refused += 1;
            at.step = (0.5 * (next - at.parameter)).max(self.options.smallest_step);
        }
    }

    /// Equilibrium at the next parameter.
    fn attempt(
        &mut self,
        state: &State,
        next: f64,
        set: Set<'_>,
        companion: &mut dyn PathObserver,
    ) -> Result<Trial, PathError> {
        let mut trial = self.predict(state, next, set)?;
        let equilibrium = self.solve(&mut trial, companion)?;
        Ok(self.trial(state, next, trial, equilibrium))
    }

    fn trial(&self, last: &State, parameter: f64, state: State, equilibrium: Equilibrium) -> Trial {
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

    /// How the next equilibrium continues the path, from whose direction it deviates.
    fn continuation(&self, trial: &Trial, deviation: f64) -> Continuation {
        let is_smallest = self.at.step <= self.options.smallest_step;
        let far = trial.moved.rotation > self.options.largest_turn
            || trial.moved.strain > self.options.largest_strain
            || self.is_sudden(trial);
        let unexplained = deviation > UNEXPLAINED;
        // From a saddle that is kept, iterations may lead anywhere, however short the step.
        let keeps_saddles = self.options.saddles == Saddles::Keep;
        let accepts_jumps = is_smallest && self.options.jumps == Jumps::Accept;
        if accepts_jumps || !far && (!unexplained || is_smallest || keeps_saddles) {
            let jumped = far || unexplained;
            return Continuation::Accepted { jumped };
        }
        if far {
            Continuation::Far
        } else {
            Continuation::OffCourse
        }
    }

    /// The loss of stability as the cause why no stable equilibrium is near: the path continues, but as a saddle.
    fn lost_stability(&mut self, state: &State, next: f64, set: Set<'_>) -> Option<PathError> {
        let predicted = self.predict(state, next, set).ok()?;
        let nearest = self.newton.nearest(&predicted, self.interactions);
        let negative = nearest.ok().flatten()?.certificate.negative;
        (negative > 0).then_some(PathError::Unstable { negative })
    }

    /// Motion of the unknowns per parameter in the last step, if that was no jump.
    fn secant(&self, state: &State) -> Option<Vec<f64>> {
        let (previous, before) = self.at.previous.as_ref()?;
        let from = state.in_motion(previous.clone());
        let way = self.newton.layout().difference(&from, state);
        let stretch = self.at.parameter - before;
        Some(way.into_iter().map(|way| way / stretch).collect())
    }

    /// Motion of the unknowns per parameter for the smallest step, to first order. `None` if the stiffness is not
    /// positive beyond rounding.
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

    /// Share of the way to a trial that the path does not predict: by the secant or, after the first equilibrium and
    /// after a jump, by the linear response. 0 where neither is known, or the way is short or leads off a saddle.
    ///
    /// Next to a limit point the linear response is so large that it would explain a small snap where the secant
    /// does not.
    fn deviation(&mut self, state: &State, trial: &Trial, set: Set<'_>) -> f64 {
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

    /// Share of the way to a trial that is not along a rate, by up to a few times the motion that it predicts.
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

    /// Whether an equilibrium is much further than the last step lets expect: a snap through.
    ///
    /// Off a saddle the way is always long at first, so that says nothing.
    fn is_sudden(&self, trial: &Trial) -> bool {
        let motion = motion(&trial.moved);
        let stretch = trial.parameter - self.at.parameter;
        let expected = self.at.rate.map(|rate| rate * stretch);
        trial.equilibrium.saddles_left == 0
            && motion > SMALL_MOTION
            && expected.is_some_and(|expected| motion > SUDDEN * expected)
    }

    /// The parameter of the next step; a rest shorter than the smallest step is added to it.
    fn next_parameter(&self) -> f64 {
        let next = self.at.parameter + self.at.step;
        if next > 1.0 - self.options.smallest_step {
            1.0
        } else {
            next
        }
    }

    /// A state at which to begin: with controls set, and extrapolated if that is lower in energy.
    ///
    /// # Errors
    /// If the way to where it is set leads through what an interaction keeps away.
    fn predict(&self, state: &State, next: f64, set: Set<'_>) -> Result<State, PathError> {
        let mut plain = state.clone();
        set(&mut plain, next);
        let passes = |to: &State| passes_through(self.interactions, state, to);
        let is_blocked = passes(&plain);
        let known = self.at.previous.as_ref();
        let Some((previous, before)) = known.filter(|_| self.options.extrapolate) else {
            return if is_blocked {
                Err(PathError::PassesThrough)
            } else {
                Ok(plain)
            };
        };
        let layout = self.newton.layout();
        let motion = layout.difference(&state.in_motion(previous.clone()), state);
        let factor = (next - self.at.parameter) / (self.at.parameter - before);
        let mut extrapolated = plain.clone();
        layout.apply(&mut extrapolated, &motion, factor);
        let is_lower = || {
            let with = Evaluation::new(self.interactions, &extrapolated);
            let without = Evaluation::new(self.interactions, &plain);
            with.energy_above(&without) < 0.0
        };
        match (passes(&extrapolated), is_blocked) {
            (true, true) => Err(PathError::PassesThrough),
            (false, true) => Ok(extrapolated),
            (false, false) if is_lower() => Ok(extrapolated),
            _ => Ok(plain),
        }
    }

    fn solve(
        &mut self,
        state: &mut State,
        companion: &mut dyn PathObserver,
    ) -> Result<Equilibrium, PathError> {
        let attempts = match self.options.saddles {
            Saddles::Leave(attempts) => attempts,
            Saddles::Stop | Saddles::Keep => 0,
        };
        let equilibrium = self
            .newton
            .minimize_observed(state, self.interactions, attempts, &mut |step| {
                companion.iterate(step)
            })
            .map_err(|failure| match failure.cause {
                SolveError::Interrupted => PathError::Interrupted,
                _ => PathError::NoEquilibrium(failure),
            })?;
        match equilibrium.certificate {
            Some(certificate)
                if equilibrium.is_saddle() && self.options.saddles != Saddles::Keep =>
            {
                Err(PathError::Unstable {
                    negative: certificate.negative,
                })
            }
            _ => Ok(equilibrium),
        }
    }

    /// The next step; along a smooth path the deviation grows with it.
    fn adapt(&mut self, equilibrium: &Equilibrium, deviation: f64) {
        let iterations = equilibrium.history.len();
        let step = &mut self.at.step;
        if iterations <= self.options.easy && deviation < 0.5 * UNEXPLAINED {
            *step *= 2.0;
        } else if iterations > self.options.hard {
            *step *= 0.5;
        }
        let (smallest, largest) = (self.options.smallest_step, self.options.largest_step);
        *step = step.clamp(smallest, largest);
    }

    fn arrive(
        &mut self,
        state: &mut State,
        trial: Trial,
        jumped: bool,
        companion: &mut dyn PathObserver,
    ) -> Result<(), (f64, PathError)> {
        let Trial {
            parameter,
            state: next,
            equilibrium,
            moved,
        } = trial;
        let left = std::mem::replace(state, next);
        self.response = None;
        let at = &mut self.at;
        let goes_on = at.points > 0 && !jumped;
        at.rate = goes_on.then(|| motion(&moved) / (parameter - at.parameter));
        // Across a jump there is nothing to extrapolate.
        at.previous = goes_on.then(|| (left.into_motion(), at.parameter));
        at.parameter = parameter;
        at.points += 1;
        let flow = companion.arrive(&PathPoint {
            parameter,
            state,
            equilibrium: &equilibrium,
            moved,
            jumped,
            work: self.newton.work(),
            waypoint: at,
        });
        self.last = Some(equilibrium);
        // At the end there is nothing left to break off.
        if flow.is_break() && parameter < 1.0 {
            return Err((parameter, PathError::Interrupted));
        }
        Ok(())
    }
}

/// How an equilibrium continues a path.
enum Continuation {
    /// As a next point, after a jump or without one.
    Accepted { jumped: bool },
    /// Near, but not in the direction of the path: a shorter step may do better.
    OffCourse,
    /// Too far away for a next point.
    Far,
}

/// The larger of the largest turn and the largest relative motion of neighbours.
fn motion(moved: &StepSize) -> f64 {
    moved.rotation.max(moved.strain)
}

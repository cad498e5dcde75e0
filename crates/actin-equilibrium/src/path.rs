//! Equilibria under changing controls (loads, clamps), with adaptive steps.
//!
//! Steps shrink if Newton's method fails or the equilibrium deviates from the prediction. At a
//! limit point they shrink to the minimum, and the path ends with the last equilibrium.

mod steps;

use crate::evaluation::{Evaluation, passes_through};
use crate::history::SolverWork;
use crate::motion::StepSize;
use crate::newton::Newton;
use crate::options::OptionsError;
use crate::outcome::{Equilibrium, NewtonFailure, SolveError};
use crate::path_observer::{PathCheckpoint, PathObserver, PathPoint};
use crate::path_options::{PathOptions, Saddles};
use actin_mechanics::{Interaction, State};
use std::ops::ControlFlow;
use steps::{Continuation, Refused, Trial, UNEXPLAINED, motion};
use thiserror::Error;

/// Solver of equilibria for a parameter from 0 to 1 that determines the controls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Path(PathOptions);

/// Result of a path followed to parameter 1.
#[derive(Clone, Debug, PartialEq)]
pub struct PathEnd {
    /// Last equilibrium.
    pub equilibrium: Equilibrium,
    /// Number of equilibria on the path, including both ends.
    pub points: usize,
    /// Number of rejected steps, each repeated with a smaller step.
    pub refused: usize,
    /// Total cost.
    pub work: SolverWork,
}

/// Cause of an incomplete path.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum PathError {
    /// Newton's method failed at the next parameter.
    #[error("{0}")]
    NoEquilibrium(Box<NewtonFailure>),
    /// The prescribed controls move bodies through each other.
    #[error("the prescribed motion moves bodies through each other, which an interaction forbids")]
    PassesThrough,
    /// The next equilibrium is a saddle.
    #[error("the equilibrium loses its stability: {negative} negative eigenvalue(s)")]
    Unstable {
        /// Number of negative eigenvalues.
        negative: usize,
    },
    /// The next equilibrium is far away: limit point, or end of a branch.
    #[error(
        "the next equilibrium is far away: a body turns by {:.2} rad, neighbours move by {:.2} \
         of their distance", .0.rotation, .0.strain
    )]
    Jump(StepSize),
    /// The observer interrupted the path.
    #[error("interrupted by the observer")]
    Interrupted,
}

/// Incomplete path. The state passed in is the last equilibrium.
#[derive(Clone, Debug, PartialEq, Error)]
#[error(
    "the path ends at {parameter:.6} of 1; at {attempted:.6}: {cause}; the last equilibrium was kept"
)]
pub struct PathFailure {
    /// Parameter of the last equilibrium.
    pub parameter: f64,
    /// Parameter of the failed step.
    pub attempted: f64,
    /// Last equilibrium; `None` if the first solve failed.
    pub equilibrium: Option<Equilibrium>,
    /// Cause of the failure.
    pub cause: PathError,
    /// Number of equilibria on the path.
    pub points: usize,
    /// Total cost.
    pub work: SolverWork,
}

impl Path {
    /// Creates a path.
    ///
    /// # Errors
    /// If an option is invalid.
    pub fn new(options: PathOptions) -> Result<Self, OptionsError> {
        options.check()?;
        Ok(Self(options))
    }

    /// Follows the equilibria of `state` from parameter 0 to 1.
    ///
    /// `set` sets controls and held bodies for a parameter. It receives a state near the last
    /// equilibrium and must not move free bodies or free components of sliders. `observe` receives
    /// every equilibrium and may interrupt the path.
    ///
    /// # Errors
    /// If the path is incomplete; `state` is then the last equilibrium.
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

    /// As [`follow`](Self::follow), with an observer that may also interrupt a solve. With a
    /// `waypoint`, the path continues from the equilibrium `state`. The results are bitwise
    /// identical to an uninterrupted path.
    ///
    /// Cost and number of points continue from the waypoint; set the counters of `newton` with
    /// [`Newton::set_work`].
    ///
    /// # Errors
    /// If the path is incomplete; `state` is then the last equilibrium.
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
            (Ok(()), None) => unreachable!("a complete path has an equilibrium"),
        }
    }
}

type Set<'a> = &'a mut dyn FnMut(&mut State, f64);

struct Walk<'a> {
    options: &'a PathOptions,
    newton: &'a mut Newton,
    interactions: &'a [Box<dyn Interaction>],
    at: PathCheckpoint,
    last: Option<Equilibrium>,
    response: Option<Vec<f64>>,
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
            self.determine_order(state);
        }
        while self.at.parameter < 1.0 {
            self.advance(state, set, companion)?;
        }
        Ok(())
    }

    /// Fixes the order of unknowns of a continued path.
    fn determine_order(&mut self, state: &State) {
        let before = self.newton.work();
        self.newton.determine_order(state, self.interactions);
        self.newton.set_work(SolverWork {
            evaluations: before.evaluations,
            assemblies: before.assemblies,
            ..self.newton.work()
        });
    }

    /// One step, reduced until it succeeds. Deviating steps are reduced too, until one moves in proportion to the step
    /// refused before it; if no smaller step succeeds, the original one is accepted as a jump.
    fn advance(
        &mut self,
        state: &mut State,
        set: Set<'_>,
        companion: &mut dyn PathObserver,
    ) -> Result<(), (f64, PathError)> {
        let mut refused = Refused::default();
        loop {
            let next = self.next_parameter();
            let is_smallest = self.at.step <= self.options.smallest_step;
            let cause = match self.attempt(state, next, set, companion) {
                Ok(trial) => {
                    let mut deviation = self.deviation(state, &trial, set);
                    if deviation > UNEXPLAINED && !is_smallest {
                        let straight = self.straightness(state, &trial, &refused);
                        deviation = straight.unwrap_or(deviation);
                    }
                    let cause = PathError::Jump(trial.moved);
                    match self.continuation(&trial, deviation) {
                        Continuation::Accepted { jumped } => {
                            self.watch_snap(&trial, &refused, jumped);
                            self.adapt(&trial, deviation);
                            return self.arrive(state, trial, jumped, companion);
                        }
                        Continuation::OffCourse => refused.push(trial, true),
                        Continuation::Far => refused.push(trial, false),
                    }
                    cause
                }
                Err(cause) => cause,
            };
            if cause == PathError::Interrupted {
                return Err((next, cause));
            }
            if is_smallest {
                let Some(trial) = refused.off_course else {
                    return Err((next, self.lost_stability(state, next, set).unwrap_or(cause)));
                };
                (self.at.step, self.at.snap) = (trial.parameter - self.at.parameter, None);
                self.adapt(&trial, UNEXPLAINED);
                return self.arrive(state, trial, true, companion);
            }
            let at = &mut self.at;
            at.refused += 1;
            at.step = (0.5 * (next - at.parameter)).max(self.options.smallest_step);
        }
    }

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

    fn lost_stability(&mut self, state: &State, next: f64, set: Set<'_>) -> Option<PathError> {
        let predicted = self.predict(state, next, set).ok()?;
        let nearest = self.newton.nearest(&predicted, self.interactions);
        let negative = nearest.ok().flatten()?.certificate.negative;
        (negative > 0).then_some(PathError::Unstable { negative })
    }

    /// Next parameter; 1 if less than the smallest step would remain.
    fn next_parameter(&self) -> f64 {
        let next = self.at.parameter + self.at.step;
        if next > 1.0 - self.options.smallest_step {
            1.0
        } else {
            next
        }
    }

    /// Initial guess for the next parameter, extrapolated if extrapolation lowers the energy.
    ///
    /// # Errors
    /// If the prescribed motion moves bodies through each other.
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
        if flow.is_break() && parameter < 1.0 {
            return Err((parameter, PathError::Interrupted));
        }
        Ok(())
    }
}

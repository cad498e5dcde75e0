//! A run: which method, which step, how long. Carrying it out is in `execution`.

use crate::execution::Execution;
use crate::{
    Bath, Checkpoint, Composition, Drag, Observer, RunFailure, RunOutcome, StopRule, advance,
    advance_in,
};
use actin_mechanics::{System, Thermostat};
use thiserror::Error;

/// Steps between two moments shown to observers, unless the caller says otherwise.
pub const DEFAULT_OBSERVE_EVERY: u64 = 1000;

/// Steps between two checks of the state: often enough to catch an explosion early, seldom
/// enough to cost less than a hundredth of the run.
pub const DEFAULT_CHECK_EVERY: u64 = 100;

/// How a system is to be advanced. The system and the observers come with
/// [`execute`](Self::execute).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Run {
    pub(crate) scheme: &'static Composition,
    pub(crate) h: f64,
    pub(crate) steps: u64,
    pub(crate) first_step: u64,
    /// Time of step number 0 (ns).
    pub(crate) time_offset: f64,
    /// Whether stages at the ends of steps are merged.
    pub(crate) merges_steps: bool,
    pub(crate) drag: Drag,
    pub(crate) bath: Option<Bath>,
    pub(crate) observe_every: u64,
    pub(crate) check_every: u64,
    pub(crate) kinetic_limit: f64,
    pub(crate) energy_limit: f64,
    pub(crate) stop: Option<StopRule>,
    pub(crate) stop_from: f64,
}

/// A setting of a run that was refused.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum RunSettingError {
    /// The time step is not positive and finite.
    #[error("the time step must be positive and finite, got {0} ns")]
    Step(f64),
    /// The duration is not positive and finite, or takes more than 2^53 steps.
    #[error("the duration must be positive and at most 2^53 steps, got {0} ns")]
    Duration(f64),
    /// An interval of zero steps.
    #[error("observations and checks must be at least one step apart, got 0")]
    Interval,
    /// The limit of the kinetic energy is not positive.
    #[error("the limit of the kinetic energy must be positive, got {0} pN nm")]
    KineticLimit(f64),
    /// The limit of the energy is no number.
    #[error("the limit of the energy must be a number, got {0} pN nm")]
    EnergyLimit(f64),
    /// A system of one's own, of which no state is known, is to be run with what looks at one.
    #[error("{0} needs the state of a System: it does not work with any other Split")]
    NeedsSystem(&'static str),
}

impl Run {
    /// A run of `steps` steps of `h` (ns), without drag and without a stop rule.
    ///
    /// # Errors
    /// A step that is not positive and finite.
    pub fn new(scheme: &'static Composition, h: f64, steps: u64) -> Result<Self, RunSettingError> {
        if !(h.is_finite() && h > 0.0) {
            return Err(RunSettingError::Step(h));
        }
        Ok(Self {
            scheme,
            h,
            steps,
            first_step: 0,
            time_offset: 0.0,
            merges_steps: true,
            drag: Drag::NONE,
            bath: None,
            observe_every: DEFAULT_OBSERVE_EVERY,
            check_every: DEFAULT_CHECK_EVERY,
            kinetic_limit: f64::INFINITY,
            energy_limit: f64::INFINITY,
            stop: None,
            stop_from: 0.0,
        })
    }

    /// A run over `duration` (ns), in the least number of equal steps that are no longer than
    /// `largest_step` (ns).
    ///
    /// # Errors
    /// A step or a duration that is not positive and finite, or more than 2^53 steps.
    pub fn over(
        scheme: &'static Composition,
        largest_step: f64,
        duration: f64,
    ) -> Result<Self, RunSettingError> {
        Self::new(scheme, largest_step, 0)?;
        // A quotient that is whole up to round-off shall not cost a step more.
        let steps = (duration / largest_step * (1.0 - 1e-12)).ceil();
        if !(duration > 0.0 && steps <= 9_007_199_254_740_992.0) {
            return Err(RunSettingError::Duration(duration));
        }
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "checked above: a whole number from 1 to 2^53"
        )]
        Self::new(scheme, duration / steps, steps as u64)
    }

    /// The same with drag, and without noise.
    #[must_use]
    pub fn with_drag(self, drag: Drag) -> Self {
        Self {
            drag,
            bath: None,
            ..self
        }
    }

    /// The same in a heat bath, with its drag.
    ///
    /// The noise goes by the number of the step, so that a run
    /// [continued](Self::continuing_from) meets what it would have met.
    #[must_use]
    pub fn with_bath(self, bath: Bath) -> Self {
        Self {
            drag: *bath.drag(),
            bath: Some(bath),
            ..self
        }
    }

    /// The same, ending early when `rule` is met at an observation.
    #[must_use]
    pub fn with_stop_rule(self, rule: StopRule) -> Self {
        Self {
            stop: Some(rule),
            ..self
        }
    }

    /// The same, with the stop rule inactive before `time` (ns): while something is still being driven,
    /// a system at rest has not arrived.
    #[must_use]
    pub fn stopping_from(self, time: f64) -> Self {
        Self {
            stop_from: time,
            ..self
        }
    }

    /// The same, shown to observers whenever the step number is a multiple of `steps`, and at
    /// the end.
    ///
    /// # Errors
    /// Zero steps.
    pub fn observing_every(self, steps: u64) -> Result<Self, RunSettingError> {
        let observe_every = at_least_one(steps)?;
        Ok(Self {
            observe_every,
            ..self
        })
    }

    /// The same, with the state checked whenever the step number is a multiple of `steps`, at
    /// powers of two, and at every observation.
    ///
    /// # Errors
    /// Zero steps.
    pub fn checking_every(self, steps: u64) -> Result<Self, RunSettingError> {
        let check_every = at_least_one(steps)?;
        Ok(Self {
            check_every,
            ..self
        })
    }

    /// The same, failing when the kinetic energy exceeds `limit` (pN nm).
    ///
    /// Without a limit, a run whose energy grows slowly fails only when a frame turns by more
    /// than half a turn in one step, or when numbers overflow.
    ///
    /// # Errors
    /// A limit that is not positive.
    pub fn with_kinetic_limit(self, limit: f64) -> Result<Self, RunSettingError> {
        if limit.is_nan() || limit <= 0.0 {
            return Err(RunSettingError::KineticLimit(limit));
        }
        Ok(Self {
            kinetic_limit: limit,
            ..self
        })
    }

    /// The same, failing when the energy, kinetic and of all interactions, is above `limit` (pN nm), or
    /// not a finite number, at the start or an observation.
    ///
    /// The failure names the first step after the last observation at which it is: steps are made
    /// again from there, with a look at the energy at each check. An infinite limit is none.
    ///
    /// Above the stability limit a mode may grow until its frequency has changed, and then stay as it
    /// is for any number of steps: its kinetic energy need not be large.
    ///
    /// # Errors
    /// A limit that is no number.
    pub fn with_energy_limit(self, limit: f64) -> Result<Self, RunSettingError> {
        if limit.is_nan() {
            return Err(RunSettingError::EnergyLimit(limit));
        }
        Ok(Self {
            energy_limit: limit,
            ..self
        })
    }

    /// The same as the continuation of an earlier run that ended at step `first_step`.
    ///
    /// Step numbers and times count on from there. Observations and checks stay at the same step
    /// numbers, so that a run broken off at an observation and continued gives the same bits as
    /// one that was not; the starting state is not shown again.
    #[must_use]
    pub fn continuing_from(self, first_step: u64) -> Self {
        Self { first_step, ..self }
    }

    /// The same with the time (ns) of step number 0, for continuations with another step length.
    #[must_use]
    pub fn with_time_offset(self, time_offset: f64) -> Self {
        Self {
            time_offset,
            ..self
        }
    }

    /// The same without merging the last stage of a step with the first of the next.
    ///
    /// Every step then ends in the same bits, however a run is divided by
    /// [`continuing_from`](Self::continuing_from); it costs one more stage a step.
    #[must_use]
    pub fn without_merged_steps(self) -> Self {
        Self {
            merges_steps: false,
            ..self
        }
    }

    /// The method.
    pub fn scheme(&self) -> &'static Composition {
        self.scheme
    }

    /// The time step (ns).
    pub fn step(&self) -> f64 {
        self.h
    }

    /// The number of steps.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Advances `system` and shows it to `observers` in their order: at step 0, at every multiple
    /// of the observation interval, and at the end.
    ///
    /// # Errors
    /// A state that is not finite or that explodes. `system` is then put back to the last state
    /// that was observed (or to the start).
    pub fn execute(
        &self,
        system: &mut System,
        observers: &mut [&mut dyn Observer],
    ) -> Result<RunOutcome, RunFailure> {
        Execution::new(self, None, system, observers).run()
    }

    /// Goes on from `checkpoint`, which a [`Pause`](crate::Pause) of the same run of an equal system
    /// has given, whatever state `system` is in: what follows is the same to the bit as in the run
    /// that was left, work counts included. The state of the checkpoint is not shown again; if the run
    /// had ended there, it ends there again.
    ///
    /// # Errors
    /// As [`execute`](Self::execute).
    ///
    /// # Panics
    /// If the checkpoint has other numbers of bodies or controls than `system`.
    pub fn resume(
        &self,
        checkpoint: &Checkpoint,
        system: &mut System,
        observers: &mut [&mut dyn Observer],
    ) -> Result<RunOutcome, RunFailure> {
        Execution::resume(self, checkpoint, None, system, observers).run_on()
    }

    /// Advances `system` by `steps` steps, the first of which has the number `first_step`.
    pub(crate) fn advance(&self, system: &mut impl Thermostat, first_step: u64, steps: u64) {
        if self.merges_steps && !system.has_step_end() {
            self.advance_at_once(system, first_step, steps);
            return;
        }
        for step in first_step..first_step + steps {
            self.advance_at_once(system, step, 1);
            system.end_step(step + 1, self.h);
        }
    }

    fn advance_at_once(&self, system: &mut impl Thermostat, first_step: u64, steps: u64) {
        let (scheme, h) = (self.scheme, self.h);
        match &self.bath {
            None => advance(system, scheme, h, steps, &self.drag),
            Some(bath) => advance_in(system, scheme, h, steps, bath, first_step),
        }
    }

    /// Time of a step number (ns).
    pub(crate) fn time(&self, step: u64) -> f64 {
        self.time_offset + step as f64 * self.h
    }
}

fn at_least_one(steps: u64) -> Result<u64, RunSettingError> {
    if steps == 0 {
        return Err(RunSettingError::Interval);
    }
    Ok(steps)
}

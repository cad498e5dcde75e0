mod execution;

use crate::Stepper;
use crate::{
    Bath, Checkpoint, Composition, Drag, Observer, RunFailure, RunOutcome, StopRule, advance,
    advance_in,
};
use actin_mechanics::{System, Thermostat};
use execution::Execution;
use thiserror::Error;

/// Default number of steps between observations.
pub(crate) const DEFAULT_OBSERVE_EVERY: u64 = 1000;

/// Default number of steps between checks of the state, which cost less than 1 % of the run.
pub const DEFAULT_CHECK_EVERY: u64 = 100;

/// Settings of a run. [`execute`](Self::execute) takes the system and the observers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Run {
    pub(crate) scheme: &'static Composition,
    pub(crate) h: f64,
    pub(crate) steps: u64,
    pub(crate) first_step: u64,
    /// Time of step 0 (ns).
    pub(crate) time_offset: f64,
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

/// Invalid setting of a run.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum RunSettingError {
    /// The time step is not positive and finite.
    #[error("the time step must be positive and finite, got {0} ns")]
    Step(f64),
    /// The duration is not positive and finite, or takes more than 2^53 steps.
    #[error("the duration must be positive and at most 2^53 steps, got {0} ns")]
    Duration(f64),
    /// The interval is zero.
    #[error("observations and checks must be at least one step apart, got 0")]
    Interval,
    /// The limit of the kinetic energy is not positive.
    #[error("the limit of the kinetic energy must be positive, got {0} pN nm")]
    KineticLimit(f64),
    /// The limit of the energy is not a number.
    #[error("the limit of the energy must be a number, got {0} pN nm")]
    EnergyLimit(f64),
    /// The setting needs a `System`.
    #[error("{0} requires a `System`; other `Split` systems do not support it")]
    NeedsSystem(&'static str),
}

impl Run {
    /// Creates a run of `steps` steps of `h` (ns), without drag and stop rule.
    ///
    /// # Errors
    /// If the step is not positive and finite.
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

    /// Creates a run over `duration` (ns), with the fewest equal steps of at most `largest_step`
    /// (ns).
    ///
    /// # Errors
    /// If a step or duration is not positive and finite, or more than 2^53 steps are needed.
    pub fn from_duration(
        scheme: &'static Composition,
        largest_step: f64,
        duration: f64,
    ) -> Result<Self, RunSettingError> {
        Self::new(scheme, largest_step, 0)?;
        // Tolerance for rounding errors of integer quotients.
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

    /// Sets drag without noise.
    #[must_use]
    pub fn with_drag(self, drag: Drag) -> Self {
        Self {
            drag,
            bath: None,
            ..self
        }
    }

    /// Sets a heat bath with its drag.
    ///
    /// The noise depends on step numbers, so that [continued](Self::continuing_from) runs have the
    /// same noise.
    #[must_use]
    pub fn with_bath(self, bath: Bath) -> Self {
        Self {
            drag: *bath.drag(),
            bath: Some(bath),
            ..self
        }
    }

    /// Sets a rule that ends the run at an observation.
    #[must_use]
    pub fn with_stop_rule(self, rule: StopRule) -> Self {
        Self {
            stop: Some(rule),
            ..self
        }
    }

    /// Disables the stop rule before `time` (ns), for instance while bodies are driven.
    #[must_use]
    pub fn stopping_from(self, time: f64) -> Self {
        Self {
            stop_from: time,
            ..self
        }
    }

    /// Sets the number of steps between observations. The end is always observed.
    ///
    /// # Errors
    /// If `steps` is zero.
    pub fn observing_every(self, steps: u64) -> Result<Self, RunSettingError> {
        let observe_every = at_least_one(steps)?;
        Ok(Self {
            observe_every,
            ..self
        })
    }

    /// Sets the number of steps between checks of the state. Powers of two and observations are
    /// always checked.
    ///
    /// # Errors
    /// If `steps` is zero.
    pub fn checking_every(self, steps: u64) -> Result<Self, RunSettingError> {
        let check_every = at_least_one(steps)?;
        Ok(Self {
            check_every,
            ..self
        })
    }

    /// Sets an upper limit of the kinetic energy (pN nm).
    ///
    /// Without a limit, slow growth is detected only when a frame rotates by more than half a turn
    /// per step, or when numbers overflow.
    ///
    /// # Errors
    /// If the limit is not positive.
    pub fn with_kinetic_limit(self, limit: f64) -> Result<Self, RunSettingError> {
        if limit.is_nan() || limit <= 0.0 {
            return Err(RunSettingError::KineticLimit(limit));
        }
        Ok(Self {
            kinetic_limit: limit,
            ..self
        })
    }

    /// Sets an upper limit of the total energy (pN nm), which is checked at the start and at
    /// observations.
    ///
    /// A failure reports the first check after the last observation with too much energy, found by
    /// repeating the steps. Above the stability limit a mode can grow until its frequency has
    /// changed and then remain bounded with a small kinetic energy.
    ///
    /// # Errors
    /// If the limit is not a number.
    pub fn with_energy_limit(self, limit: f64) -> Result<Self, RunSettingError> {
        if limit.is_nan() {
            return Err(RunSettingError::EnergyLimit(limit));
        }
        Ok(Self {
            energy_limit: limit,
            ..self
        })
    }

    /// Continues an earlier run that ended at step `first_step`.
    ///
    /// Step numbers, times, observations and checks are continued, so that a run interrupted at an
    /// observation agrees bitwise with an uninterrupted one. The initial state is not observed
    /// again.
    #[must_use]
    pub fn continuing_from(self, first_step: u64) -> Self {
        Self { first_step, ..self }
    }

    /// Sets the time (ns) of step 0, for continuations with another time step.
    #[must_use]
    pub fn with_time_offset(self, time_offset: f64) -> Self {
        Self {
            time_offset,
            ..self
        }
    }

    /// Disables the merging of stages between steps.
    ///
    /// The states after each step are then independent of the division by
    /// [`continuing_from`](Self::continuing_from). This costs one more stage per step.
    #[must_use]
    pub fn without_merged_steps(self) -> Self {
        Self {
            merges_steps: false,
            ..self
        }
    }

    /// Time step (ns).
    pub fn step(&self) -> f64 {
        self.h
    }

    /// Number of steps.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Advances `system` and calls `observers` in order: at step 0, at every multiple of the
    /// observation interval, and at the end.
    ///
    /// # Errors
    /// If a state is not finite or diverges. `system` is then restored to the last observed state,
    /// or to the start.
    pub fn execute(
        &self,
        system: &mut System,
        observers: &mut [&mut dyn Observer],
    ) -> Result<RunOutcome, RunFailure> {
        self.execute_from(None, None, system, observers)
    }

    /// Advances `system` like [`execute`](Self::execute), from a `checkpoint` and with the steps of a `stepper`
    /// if these are given.
    ///
    /// A checkpoint is from a [`Pause`](crate::Pause) of the same run and an equal system. The
    /// present state of `system` is then ignored. Results and counters agree bitwise with the
    /// uninterrupted run. The state of the checkpoint is not observed again. A checkpoint of the end
    /// gives the same outcome.
    ///
    /// With a stepper, the method, drag and heat bath of the run are ignored.
    ///
    /// # Errors
    /// See [`execute`](Self::execute). Also if a step fails.
    ///
    /// # Panics
    /// If the numbers of bodies or controls of the checkpoint differ from those of `system`.
    pub fn execute_from(
        &self,
        checkpoint: Option<&Checkpoint>,
        stepper: Option<&mut dyn Stepper>,
        system: &mut System,
        observers: &mut [&mut dyn Observer],
    ) -> Result<RunOutcome, RunFailure> {
        let execution = Execution::new(self, checkpoint, stepper, system, observers);
        match checkpoint {
            Some(_) => execution.run_on(),
            None => execution.run(),
        }
    }

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

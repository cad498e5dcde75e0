//! A run in progress: advancing, checking, observing, and finding out what broke.

use crate::diagnosis::{Probe, Watch, blame};
use crate::{Body, Moment, Observer, Outcome, Problem, Reason, Residual, Run, RunFailure};
use actin_mechanics::{Split, State, System};

/// A run in progress.
pub(crate) struct Execution<'a, 'o> {
    run: &'a Run,
    system: &'a mut System,
    observers: &'a mut [&'o mut dyn Observer],
    watch: Watch,
    step: u64,
    last_good: (u64, State),
    evaluations_before: u64,
}

impl<'a, 'o> Execution<'a, 'o> {
    pub(crate) fn new(
        run: &'a Run,
        system: &'a mut System,
        observers: &'a mut [&'o mut dyn Observer],
    ) -> Self {
        Self {
            run,
            watch: Watch::new(run.h, run.kinetic_limit),
            step: run.first_step,
            last_good: (run.first_step, system.state().clone()),
            evaluations_before: system.force_evaluations(),
            system,
            observers,
        }
    }

    pub(crate) fn run(mut self) -> Result<Outcome, RunFailure> {
        let end = self.run.first_step + self.run.steps;
        // What the start moves at says nothing about what the loads will do to it.
        if let Some(problem) = self.watch.inspect(self.system.state()) {
            return Err(self.fail(problem));
        }
        let mut ended = if self.run.first_step == 0 || self.run.steps == 0 {
            self.observe(end)
        } else {
            None
        };
        while ended.is_none() {
            self.advance_to(self.next_check(end));
            self.check()?;
            if self.step == end || self.step.is_multiple_of(self.run.observe_every) {
                ended = self.observe(end);
            }
        }
        Ok(self.outcome(ended.unwrap_or(Reason::Completed)))
    }

    /// The next step number at which the state is to be looked at.
    ///
    /// The first checks are at powers of two, so that the growth of a run that explodes from the
    /// start is seen against its first step.
    fn next_check(&self, end: u64) -> u64 {
        let after = |interval: u64| (self.step / interval + 1) * interval;
        end.min(after(self.run.observe_every))
            .min(after(self.run.check_every))
            .min((self.step + 1).next_power_of_two())
    }

    fn advance_to(&mut self, step: u64) {
        self.run.advance(self.system, self.step, step - self.step);
        self.step = step;
    }

    /// Fails if the state is unsound.
    fn check(&mut self) -> Result<(), RunFailure> {
        match self.watch.inspect(self.system.state()) {
            None => {
                self.watch.remember(self.system.state());
                Ok(())
            }
            Some(problem) => Err(self.fail(problem)),
        }
    }

    /// Shows the state to everyone and says whether the run ends here.
    fn observe(&mut self, end: u64) -> Option<Reason> {
        self.last_good = (self.step, self.system.state().clone());
        let mut moment = Moment::new(self.step, self.run.time(self.step), self.system);
        let mut interrupted = false;
        for observer in self.observers.iter_mut() {
            interrupted |= observer.observe(&mut moment).is_break();
        }
        let at_rest = self
            .run
            .stop
            .filter(|_| moment.time >= self.run.stop_from)
            .is_some_and(|rule| rule.is_met(moment.residual(), moment.kinetic_energy()));
        if at_rest {
            Some(Reason::Converged)
        } else if self.step == end {
            Some(Reason::Completed)
        } else {
            interrupted.then_some(Reason::Interrupted)
        }
    }

    fn outcome(self, reason: Reason) -> Outcome {
        let (force, torque) = self.system.residual();
        Outcome {
            reason,
            steps: self.step - self.run.first_step,
            time: self.run.time(self.step),
            force_evaluations: self.system.force_evaluations() - self.evaluations_before,
            residual: Residual { force, torque },
            kinetic: self.system.state().kinetic_energy(),
        }
    }

    /// Finds the step, the body and the term to blame, and puts the last good state back.
    fn fail(&mut self, problem: Problem) -> RunFailure {
        let (problem, before) = self.replay(problem);
        let broken = self.system.state().clone();
        let (body, term) = self
            .probe(&before)
            .unwrap_or_else(|| blame(self.system.interactions(), &broken, &before));
        let (last_good_step, last_good) = &self.last_good;
        self.system.state_mut().clone_from(last_good);
        RunFailure {
            problem,
            step: self.step,
            time: self.run.time(self.step),
            body,
            term,
            last_good_step: *last_good_step,
            last_good_time: self.run.time(*last_good_step),
        }
    }

    /// Repeats the way from the last good state step by step, up to the first unsound state, so
    /// that the report names the step at which it broke. Returns what is wrong and the state one
    /// step before; leaves the system and `self.step` at the break.
    fn replay(&mut self, found: Problem) -> (Problem, State) {
        let (found_step, broken) = (self.step, self.system.state().clone());
        self.step = self.last_good.0;
        self.system.state_mut().clone_from(&self.last_good.1);
        let mut before = self.last_good.1.clone();
        while self.step < found_step {
            before.clone_from(self.system.state());
            self.advance_to(self.step + 1);
            if let Some(problem) = self.watch.inspect(self.system.state()) {
                return (problem, before);
            }
        }
        // Steps made one by one differ by round-off, which may have hidden the break.
        self.system.state_mut().clone_from(&broken);
        (found, before)
    }

    /// Makes one step from `before`, looking for the first load that is not finite.
    fn probe(&mut self, before: &State) -> Option<(Body, &'static str)> {
        self.system.state_mut().clone_from(before);
        let mut probe = Probe {
            system: self.system,
            culprit: None,
        };
        // A start that is unsound has no step before it.
        let step = self.step.saturating_sub(1);
        self.run.advance(&mut probe, step, 1);
        probe.culprit
    }
}

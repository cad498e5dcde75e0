//! A run in progress: advancing, checking, observing, and finding out what broke.

use crate::diagnosis::{Probe, Watch, blame, broken_energy, strongest_term};
use crate::{
    Body, Checkpoint, FailureKind, Moment, Observer, Pause, Reason, Run, RunFailure, RunOutcome,
    Snapshot, StepFailure, Stepper,
};
use actin_mechanics::{Coordinates, Split, State, System};
use std::ops::ControlFlow;

/// A run in progress.
pub(crate) struct Execution<'a, 'o> {
    run: &'a Run,
    /// What makes the steps, if not the method of the run.
    stepper: Option<&'a mut dyn Stepper>,
    system: &'a mut System,
    observers: &'a mut [&'o mut dyn Observer],
    watch: Watch,
    step: u64,
    /// The last state that was observed, or the start.
    last_good: Snapshot,
    /// The state at the last check, from which a failure is retraced.
    sound: (u64, State),
    evaluations_before: u64,
}

impl<'a, 'o> Execution<'a, 'o> {
    pub(crate) fn new(
        run: &'a Run,
        stepper: Option<&'a mut dyn Stepper>,
        system: &'a mut System,
        observers: &'a mut [&'o mut dyn Observer],
    ) -> Self {
        let start = Snapshot::new(run.first_step, system, 0.0);
        let checkpoint = Checkpoint {
            evaluations_before: start.force_evaluations,
            last_good: start.clone(),
            here: start,
        };
        Self::standing(run, &checkpoint, stepper, system, observers)
    }

    /// The run where it was left.
    pub(crate) fn resume(
        run: &'a Run,
        checkpoint: &Checkpoint,
        stepper: Option<&'a mut dyn Stepper>,
        system: &'a mut System,
        observers: &'a mut [&'o mut dyn Observer],
    ) -> Self {
        checkpoint.here.restore(system);
        Self::standing(run, checkpoint, stepper, system, observers)
    }

    fn standing(
        run: &'a Run,
        checkpoint: &Checkpoint,
        stepper: Option<&'a mut dyn Stepper>,
        system: &'a mut System,
        observers: &'a mut [&'o mut dyn Observer],
    ) -> Self {
        let here = &checkpoint.here;
        Self {
            run,
            stepper,
            watch: Watch::new(run.h, run.kinetic_limit, here.largest_kinetic),
            step: here.step,
            last_good: checkpoint.last_good.clone(),
            sound: (here.step, system.state().clone()),
            evaluations_before: checkpoint.evaluations_before,
            system,
            observers,
        }
    }

    pub(crate) fn run(mut self) -> Result<RunOutcome, RunFailure> {
        // What the start moves at says nothing about what the loads will do to it.
        if let Err(problem) = self.inspect(true) {
            return Err(self.fail(problem));
        }
        if (self.run.first_step == 0 || self.run.steps == 0)
            && let Some(reason) = self.observe()
        {
            return Ok(self.outcome(reason));
        }
        if self.pause().is_break() {
            return Ok(self.outcome(Reason::Interrupted));
        }
        let ended = (self.step >= self.end()).then_some(Reason::Completed);
        self.go_on(ended)
    }

    /// Goes on from a checkpoint, which may be that of the end.
    pub(crate) fn run_on(mut self) -> Result<RunOutcome, RunFailure> {
        // The start of a continuation has not been shown, and no stop rule has seen it.
        let is_observed = self.step == self.last_good.step
            && (self.step > self.run.first_step || self.run.first_step == 0);
        // An observer that wanted to go on from here says so again.
        let time = self.run.time(self.step);
        // Loads that are not current are those of a state that was changed since it was observed.
        let ends_at_rest = is_observed
            && self.system.loads_are_current()
            && self.is_at_rest()
            && (self.step >= self.end() || !self.intervene(time, true));
        let ended = if ends_at_rest {
            Some(Reason::Converged)
        } else {
            (self.step >= self.end()).then_some(Reason::Completed)
        };
        self.go_on(ended)
    }

    fn go_on(mut self, mut ended: Option<Reason>) -> Result<RunOutcome, RunFailure> {
        let end = self.end();
        while ended.is_none() {
            if let Err(failure) = self.advance_to(self.next_check(end)) {
                return Err(self.fail_step(failure));
            }
            let is_shown = self.step == end || self.step.is_multiple_of(self.run.observe_every);
            self.check(is_shown)?;
            if is_shown {
                ended = self.observe();
            }
            if ended.is_none() && self.pause().is_break() {
                ended = Some(Reason::Interrupted);
            }
        }
        Ok(self.outcome(ended.unwrap_or(Reason::Completed)))
    }

    fn end(&self) -> u64 {
        self.run.first_step + self.run.steps
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

    fn advance_to(&mut self, step: u64) -> Result<(), StepFailure> {
        let Some(stepper) = &mut self.stepper else {
            self.run.advance(self.system, self.step, step - self.step);
            self.step = step;
            return Ok(());
        };
        while self.step < step {
            stepper.step(self.system, self.step, self.run.h)?;
            self.step += 1;
        }
        Ok(())
    }

    /// Fails if the state is unsound; of one that is `shown`, its whole energy counts.
    fn check(&mut self, is_shown: bool) -> Result<(), RunFailure> {
        let kinetic = match self.inspect(is_shown) {
            Ok(_) if self.passed().is_some() => return Err(self.fail(FailureKind::PassesThrough)),
            Ok(kinetic) => kinetic,
            Err(problem) => return Err(self.fail(problem)),
        };
        self.watch.remember(kinetic);
        self.mark_sound();
        Ok(())
    }

    /// The kinetic energy (pN nm) of the state, or what is wrong with it or, if asked for, with its
    /// `whole` energy. Changes nothing.
    fn inspect(&self, whole: bool) -> Result<f64, FailureKind> {
        let kinetic = self.watch.inspect(self.system.state())?;
        if whole {
            self.inspect_energy()?;
        }
        Ok(kinetic)
    }

    /// A body that has passed through another since the last check, and the term that was to prevent it.
    fn passed(&self) -> Option<(Body, &'static str)> {
        let (before, here) = (&self.sound.1, self.system.state());
        let mut all = self.system.interactions().iter();
        all.find_map(|interaction| {
            let body = match interaction.passes_through(before, here)? {
                Coordinates::Point(i) => Body::Point(i),
                Coordinates::Frame(i) => Body::Frame(i),
            };
            Some((body, interaction.term()))
        })
    }

    /// Whether there is more energy than there can be, or none that is a number.
    fn inspect_energy(&self) -> Result<(), FailureKind> {
        let limit = self.run.energy_limit;
        if limit == f64::INFINITY {
            return Ok(());
        }
        let energy = self.system.total_energy();
        if energy.is_finite() && energy <= limit {
            Ok(())
        } else {
            Err(FailureKind::TooMuchEnergy(energy))
        }
    }

    /// A failure is retraced from here.
    fn mark_sound(&mut self) {
        self.sound.0 = self.step;
        self.sound.1.copy_motion_from(self.system.state());
    }

    /// Shows the state to everyone and says whether the run ends here.
    fn observe(&mut self) -> Option<Reason> {
        let time = self.run.time(self.step);
        let mut moment = Moment::new(self.step, time, self.system);
        let mut interrupted = false;
        for observer in self.observers.iter_mut() {
            interrupted |= observer.observe(&mut moment).is_break();
        }
        let at_rest = self.is_at_rest();
        let goes_on = self.step < self.end() && !interrupted && self.intervene(time, at_rest);
        self.last_good = Snapshot::new(self.step, self.system, self.watch.largest_kinetic);
        if at_rest && !goes_on {
            Some(Reason::Converged)
        } else if self.step == self.end() {
            Some(Reason::Completed)
        } else {
            interrupted.then_some(Reason::Interrupted)
        }
    }

    /// Whether the stop rule is met.
    fn is_at_rest(&mut self) -> bool {
        let mut moment = Moment::new(self.step, self.run.time(self.step), self.system);
        self.run
            .stop
            .filter(|_| moment.time >= self.run.stop_from)
            .is_some_and(|rule| rule.is_met(moment.residual(), moment.kinetic_energy()))
    }

    /// Lets every observer change the state; returns whether one of them wants the run to go on.
    fn intervene(&mut self, time: f64, at_rest: bool) -> bool {
        let mut goes_on = false;
        for observer in self.observers.iter_mut() {
            goes_on |= observer.intervene(time, at_rest, self.system);
        }
        if goes_on {
            self.mark_sound();
        }
        goes_on
    }

    /// Lets everyone keep what is needed to go on from here, or leave.
    fn pause(&mut self) -> ControlFlow<()> {
        let mut flow = ControlFlow::Continue(());
        self.show_pause(|observer, pause| {
            if observer.pause(pause).is_break() {
                flow = ControlFlow::Break(());
            }
        });
        flow
    }

    /// Shows where the run stands to everyone.
    fn show_pause(&mut self, mut show: impl FnMut(&mut dyn Observer, &Pause<'_>)) {
        let pause = Pause {
            step: self.step,
            time: self.run.time(self.step),
            system: self.system,
            largest_kinetic: self.watch.largest_kinetic,
            evaluations_before: self.evaluations_before,
            last_good: &self.last_good,
        };
        for observer in self.observers.iter_mut() {
            show(*observer, &pause);
        }
    }

    fn outcome(mut self, reason: Reason) -> RunOutcome {
        if reason != Reason::Interrupted {
            self.show_pause(|observer, end| observer.finish(end));
        }
        let residual = self.system.residual();
        RunOutcome {
            reason,
            steps: self.step - self.run.first_step,
            time: self.run.time(self.step),
            force_evaluations: self.system.force_evaluations() - self.evaluations_before,
            residual,
            kinetic: self.system.state().kinetic_energy(),
        }
    }

    /// Puts the last good state back after a step that failed, and says what acts where it did.
    fn fail_step(&mut self, failure: StepFailure) -> RunFailure {
        self.step += 1;
        let term = strongest_term(self.system.interactions(), &self.sound.1, failure.body);
        self.put_back(failure.problem, failure.body, term)
    }

    /// Finds the step, the body and the term to blame, and puts the last good state back.
    fn fail(&mut self, problem: FailureKind) -> RunFailure {
        let problem = match problem {
            FailureKind::TooMuchEnergy(_) => self.retrace(problem),
            _ => problem,
        };
        let (problem, before) = self.replay(problem);
        let (body, term) = self.culprit(problem, &before);
        self.put_back(problem, body, term)
    }

    /// Puts the last good state back, and tells observers.
    fn put_back(&mut self, problem: FailureKind, body: Body, term: &'static str) -> RunFailure {
        self.last_good.restore(self.system);
        let last_good = Checkpoint {
            here: self.last_good.clone(),
            last_good: self.last_good.clone(),
            evaluations_before: self.evaluations_before,
        };
        for observer in self.observers.iter_mut() {
            observer.fail(&last_good);
        }
        RunFailure {
            problem,
            step: self.step,
            time: self.run.time(self.step),
            body,
            term,
            last_good_step: self.last_good.step,
            last_good_time: self.run.time(self.last_good.step),
        }
    }

    /// The body and the term to blame for the present state, one step after `before`.
    fn culprit(&mut self, problem: FailureKind, before: &State) -> (Body, &'static str) {
        if problem == FailureKind::PassesThrough
            && let Some(passed) = self.passed()
        {
            return passed;
        }
        let broken = self.system.state().clone();
        self.probe(before)
            .or_else(|| match problem {
                FailureKind::TooMuchEnergy(energy) if !energy.is_finite() => {
                    broken_energy(self.system.interactions(), &broken)
                }
                _ => None,
            })
            .unwrap_or_else(|| blame(self.system.interactions(), &broken, before))
    }

    /// Repeats the way from the last observation, up to the first check with too much energy, which
    /// only observations look for. Returns what is wrong there; `sound` is the check before.
    fn retrace(&mut self, found: FailureKind) -> FailureKind {
        let found_step = self.step;
        self.last_good.restore(self.system);
        self.step = self.last_good.step;
        self.mark_sound();
        while self.step < found_step {
            // It has come this way before, so no step fails.
            let _ = self.advance_to(self.next_check(found_step));
            if let Err(problem) = self.inspect_energy() {
                return problem;
            }
            self.mark_sound();
        }
        found
    }

    /// Repeats the way from the last check step by step, up to the first unsound state, so that
    /// the report names the step at which it broke. Returns what is wrong and the state one
    /// step before; leaves the system and `self.step` at the break.
    fn replay(&mut self, found: FailureKind) -> (FailureKind, State) {
        let (found_step, broken) = (self.step, self.system.state().clone());
        let whole = matches!(found, FailureKind::TooMuchEnergy(_));
        self.step = self.sound.0;
        self.system.state_mut().clone_from(&self.sound.1);
        let mut before = self.sound.1.clone();
        while self.step < found_step {
            before.clone_from(self.system.state());
            let _ = self.advance_to(self.step + 1);
            let broken = match found {
                FailureKind::PassesThrough => self.passed().map(|_| found),
                _ => self.inspect(whole).err(),
            };
            if let Some(problem) = broken {
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
        if self.stepper.is_some() {
            return None;
        }
        // A start that is unsound has no step before it.
        let step = self.step.saturating_sub(1);
        self.run.advance(&mut probe, step, 1);
        probe.culprit
    }
}

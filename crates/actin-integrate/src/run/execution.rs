use crate::diagnosis::{DivergenceMonitor, Probe, blame, broken_energy, strongest_term};
use crate::{
    Body, Checkpoint, FailureKind, Moment, Observer, Pause, Reason, Run, RunFailure, RunOutcome,
    Snapshot, StepFailure, Stepper,
};
use actin_mechanics::{Coordinates, Split, State, System};
use std::ops::ControlFlow;

pub(crate) struct Execution<'a, 's, 'o> {
    run: &'a Run,
    /// Custom steps, if any.
    stepper: Option<&'a mut (dyn Stepper + 's)>,
    system: &'a mut System,
    observers: &'a mut [&'o mut dyn Observer],
    watch: DivergenceMonitor,
    step: u64,
    /// Last observed state, or the start.
    last_good: Snapshot,
    /// State at the last check, for the failure analysis.
    sound: (u64, State),
    evaluations_before: u64,
}

impl<'a, 's, 'o> Execution<'a, 's, 'o> {
    pub(crate) fn new(
        run: &'a Run,
        checkpoint: Option<&Checkpoint>,
        stepper: Option<&'a mut (dyn Stepper + 's)>,
        system: &'a mut System,
        observers: &'a mut [&'o mut dyn Observer],
    ) -> Self {
        if let Some(checkpoint) = checkpoint {
            checkpoint.here.restore(system);
        }
        let start = || {
            let here = Snapshot::new(run.first_step, system, 0.0);
            Checkpoint {
                evaluations_before: here.force_evaluations,
                last_good: here.clone(),
                here,
            }
        };
        let checkpoint = checkpoint.cloned().unwrap_or_else(start);
        let here = &checkpoint.here;
        Self {
            run,
            stepper,
            watch: DivergenceMonitor::new(run.h, run.kinetic_limit, here.largest_kinetic),
            step: here.step,
            sound: (here.step, system.state().clone()),
            last_good: checkpoint.last_good,
            evaluations_before: checkpoint.evaluations_before,
            system,
            observers,
        }
    }

    pub(crate) fn run(mut self) -> Result<RunOutcome, RunFailure> {
        // The kinetic energy of the start is no measure for growth.
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

    pub(crate) fn run_on(mut self) -> Result<RunOutcome, RunFailure> {
        // The start of a continuation has not been observed.
        let is_observed = self.step == self.last_good.step
            && (self.step > self.run.first_step || self.run.first_step == 0);
        // An observer can continue the run again.
        let time = self.run.time(self.step);
        // Loads that are not current belong to a state that was changed after its observation.
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

    /// Step number of the next check.
    ///
    /// The first checks are at powers of two, to detect growth from the start.
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

    /// Kinetic energy (pN nm) of the state, or the kind of its failure. The total energy is checked
    /// if `whole`.
    fn inspect(&self, whole: bool) -> Result<f64, FailureKind> {
        let kinetic = self.watch.inspect(self.system.state())?;
        if whole {
            self.inspect_energy()?;
        }
        Ok(kinetic)
    }

    fn passed(&self) -> Option<(Body, &'static str)> {
        let mut stepper = self.stepper.iter();
        if stepper.any(|stepper| stepper.prevents_crossings()) {
            return None;
        }
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

    fn mark_sound(&mut self) {
        self.sound.0 = self.step;
        self.sound.1.copy_motion_from(self.system.state());
    }

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

    fn is_at_rest(&mut self) -> bool {
        let mut moment = Moment::new(self.step, self.run.time(self.step), self.system);
        self.run
            .stop
            .filter(|_| moment.time >= self.run.stop_from)
            .is_some_and(|rule| rule.is_met(moment.residual(), moment.kinetic_energy()))
    }

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

    fn pause(&mut self) -> ControlFlow<()> {
        let mut flow = ControlFlow::Continue(());
        self.show_pause(|observer, pause| {
            if observer.pause(pause).is_break() {
                flow = ControlFlow::Break(());
            }
        });
        flow
    }

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

    fn fail_step(&mut self, failure: StepFailure) -> RunFailure {
        self.step += 1;
        let term = strongest_term(self.system.interactions(), &self.sound.1, failure.body);
        self.put_back(failure.problem, failure.body, term)
    }

    fn fail(&mut self, problem: FailureKind) -> RunFailure {
        let problem = match problem {
            FailureKind::TooMuchEnergy(_) => self.retrace(problem),
            _ => problem,
        };
        let (problem, before) = self.replay(problem);
        let (body, term) = self.culprit(problem, &before);
        self.put_back(problem, body, term)
    }

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
        }
    }

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

    /// Repeats the run from the last observation to the first check with too much energy. Returns
    /// the kind of the failure; `sound` is the check before.
    fn retrace(&mut self, found: FailureKind) -> FailureKind {
        let found_step = self.step;
        self.last_good.restore(self.system);
        self.step = self.last_good.step;
        self.mark_sound();
        while self.step < found_step {
            // These steps succeeded before.
            let _ = self.advance_to(self.next_check(found_step));
            if let Err(problem) = self.inspect_energy() {
                return problem;
            }
            self.mark_sound();
        }
        found
    }

    /// Repeats the run from the last check step by step to the first unsound state. Returns the
    /// kind of the failure and the state one step before.
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
        // Single steps differ by rounding errors, which can hide the failure.
        self.system.state_mut().clone_from(&broken);
        (found, before)
    }

    fn probe(&mut self, before: &State) -> Option<(Body, &'static str)> {
        self.system.state_mut().clone_from(before);
        let mut probe = Probe {
            system: self.system,
            culprit: None,
        };
        if self.stepper.is_some() {
            return None;
        }
        let step = self.step.saturating_sub(1);
        self.run.advance(&mut probe, step, 1);
        probe.culprit
    }
}

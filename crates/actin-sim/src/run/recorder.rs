//! Observer of a motion: records, checkpoints, lost turns, and perturbation at saddles.

use super::hinge::HingeWatch;
use super::record_stream::RecordStream;
use super::rest::{RestJudge, SaddlePush, is_saddle, saddle};
use super::sink::{Clock, MotionPosition, ResolutionSwitch, SavedRun};
use super::slip::TurnLoss;
use super::step_check::StepCheck;
use super::{
    Estimate, Failure, Outcome, Progress, Record, RecordSummary, Row, RunPosition, Sink, Status,
};
use crate::At;
use crate::scene::{Dynamics, Task};
use crate::{Assembly, LinkerEvent};
use actin_assembly::Log;
use actin_equilibrium::Certificate;
use actin_integrate::{
    Checkpoint, DEFAULT_CHECK_EVERY, Moment, Observer, Pause, Reason, Run, RunFailure, RunOutcome,
    Stepper,
};
use actin_mechanics::{Split, System};
use std::ops::ControlFlow;
use std::sync::{Arc, Mutex, PoisonError};

/// Observer that records a motion and perturbs it at saddles.
pub(super) struct Recorder<'a> {
    records: RecordStream<'a>,
    pushes: Vec<SaddlePush>,
    end_ns: f64,
    /// End of the path (ns); the motion is not checked for rest before.
    rest_from_ns: f64,
    most_pushes: usize,
    clock: Clock,
    judge: Option<RestJudge<'a>>,
    /// Position at which an interrupted run continues.
    position: Option<Checkpoint>,
    /// Checkpoint at the last record after which the motion continued, with the records up to then.
    /// They are unknown if the run was resumed since.
    last_good: Option<(Checkpoint, Option<RecordSummary>)>,
    /// A record was made since `last_good`.
    has_new_record: bool,
    is_interrupted: bool,
    assembly: &'a Assembly,
    /// Log of linker events.
    log: Log,
    hinges: HingeWatch,
    /// Largest kinetic energy at a check (pN nm), set at the end.
    largest_kinetic_pn_nm: f64,
    behind_switch: Option<ResolutionSwitch>,
    /// Comparison with shorter steps.
    pub(super) step_check: Option<StepCheck<'a>>,
    /// Steps between queries whether to leave the motion.
    leave_every: u64,
}

impl<'a> Recorder<'a> {
    /// Creates the recorder of the motion of `assembly`, new or resumed.
    ///
    /// # Panics
    /// If `saved` is a path of equilibria.
    pub(super) fn new(
        assembly: &'a Assembly,
        dynamics: &Dynamics,
        saved: Option<SavedRun>,
        clock: Clock,
        sink: &'a mut dyn Sink,
    ) -> Self {
        let (position, recorded) = saved.map(|s| (s.position, s.recorded)).unzip();
        let motion = position.map(|position| match position {
            RunPosition::Motion(motion) => *motion,
            RunPosition::Path(_) => panic!("the checkpoint belongs to a path of equilibria"),
        });
        let behind_switch = motion.as_ref().and_then(|m| m.behind_switch);
        let (position, pushes, events) = match motion {
            None => (None, Vec::new(), Vec::new()),
            Some(motion) => (Some(motion.checkpoint), motion.pushes, motion.events),
        };
        let hinges = HingeWatch::new(assembly);
        Self {
            records: RecordStream::new(assembly, recorded, sink),
            pushes,
            end_ns: dynamics.duration_ns,
            rest_from_ns: hinges.duration_ns(),
            most_pushes: dynamics.leave_saddles,
            clock,
            judge: RestJudge::new(assembly, dynamics),
            has_new_record: position.is_none(),
            last_good: position.as_ref().map(|checkpoint| {
                let good = Checkpoint {
                    here: checkpoint.last_good.clone(),
                    ..checkpoint.clone()
                };
                (good, None)
            }),
            position,
            is_interrupted: false,
            assembly,
            log: Arc::new(Mutex::new(events)),
            hinges,
            behind_switch,
            leave_every: match assembly.scene.task {
                // Overdamped steps are long.
                Task::Brownian(_) => 1,
                _ => DEFAULT_CHECK_EVERY,
            },
            largest_kinetic_pn_nm: 0.0,
            step_check: None,
        }
    }

    /// Installs the path of the scene as the drive of `system` and returns its duration (ns).
    pub(super) fn drive(&self, system: &mut System) -> f64 {
        if let Some(drive) = self.hinges.to_drive() {
            system.set_drive(drive);
        }
        self.rest_from_ns
    }

    /// Runs the motion of `system`. Without a stepper, the method of `run` makes the steps.
    pub(super) fn run(
        mut self,
        estimate: &Estimate,
        (run, stepper): (&Run, Option<&mut dyn Stepper>),
        mut system: System,
    ) -> (Outcome, Option<Failure>) {
        // Loads have their initial factors. After a switch of cells the initial energy is unknown.
        let is_whole = self.behind_switch.is_none();
        let begun_with_pn_nm = is_whole.then(|| system.total_energy());
        if let Some(kinetics) = &self.assembly.kinetics {
            system.set_step_end(kinetics.event_process(&self.log));
        }
        if let Some(energy_balance) = self.assembly.energy_balance {
            system.track_energy_balance(energy_balance);
        }
        let result = self.execute(run, stepper, &mut system);
        let mut outcome = Outcome {
            force_evaluations: system.force_evaluations(),
            time_step_ns: Some(estimate.time_step_ns),
            begun_with_pn_nm,
            ..Outcome::new(Status::Failed, 0.0)
        };
        let failure = self.end(result, &mut system, &mut outcome);
        outcome.wall_s = self.clock.wall_s();
        outcome.largest_kinetic_pn_nm = self.largest_kinetic_pn_nm;
        outcome.saddles_left = self.pushes.len();
        // Later events belong to no record.
        outcome.events = self.events_until(outcome.steps);
        outcome.pushes = self.pushes;
        let statistics = self.records.recorded.carried;
        (outcome.with_statistics(self.assembly, statistics), failure)
    }

    fn execute(
        &mut self,
        run: &Run,
        stepper: Option<&mut dyn Stepper>,
        system: &mut System,
    ) -> Result<RunOutcome, RunFailure> {
        let checkpoint = self.position.take();
        if let Some(checkpoint) = &checkpoint {
            let mut state = system.state().clone();
            state.set_motion(&checkpoint.here.motion);
            self.hinges.begin(&state);
        }
        run.execute_from(checkpoint.as_ref(), stepper, system, &mut [self])
    }

    fn events_until(&self, step: u64) -> Vec<LinkerEvent> {
        let mut events = self
            .log
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .clone();
        events.retain(|event| event.step <= step);
        events
    }

    pub(super) fn begun_with_pn_nm(&self) -> f64 {
        let built = || self.assembly.system.total_energy();
        self.behind_switch.map_or_else(built, |s| s.energy_pn_nm)
    }

    /// Adds the end of the motion to `outcome`. After lost turns `system` returns to the last good
    /// state. A checkpoint is kept after lost turns and at a saddle.
    fn end(
        &mut self,
        result: Result<RunOutcome, RunFailure>,
        system: &mut System,
        outcome: &mut Outcome,
    ) -> Option<Failure> {
        let end = match result {
            Ok(end) => end,
            Err(failure) => {
                outcome.steps = failure.last_good_step;
                let body = self.assembly.describe(failure.body);
                return Some(Failure::Diverged { failure, body });
            }
        };
        if let Some(lost) = self.records.lost.take() {
            return Some(self.return_to_last_good(lost, system, outcome));
        }
        outcome.steps = end.steps;
        outcome.force_evaluations = end.force_evaluations;
        if self.is_interrupted {
            outcome.status = Status::Interrupted;
            return None;
        }
        outcome.status = match end.reason {
            Reason::Converged => Status::Converged,
            _ => Status::Completed,
        };
        outcome.at_rest = self.certificate(end.reason, system);
        let certificate = outcome.at_rest.filter(is_saddle)?;
        Some(self.end_on_saddle(&certificate))
    }

    fn return_to_last_good(
        &mut self,
        lost: TurnLoss,
        system: &mut System,
        outcome: &mut Outcome,
    ) -> Failure {
        if let Some((good, _)) = self.last_good.take() {
            outcome.steps = good.here.step;
            system.state_mut().set_motion(&good.here.motion);
            // The slipped state was not recorded.
            self.keep(good);
        }
        let place = format!("at {:.4} ns, ", lost.at().value());
        Failure::from_turn_loss(lost, place)
    }

    fn end_on_saddle(&mut self, certificate: &Certificate) -> Failure {
        // The last record ended the run and belongs after the last good state. Without an
        // earlier record since the run was resumed, the existing checkpoint stays.
        if let Some((good, Some(recorded))) = self.last_good.take() {
            let position = self.position_at(good);
            let sink = &mut self.records.sink;
            sink.checkpoint(&position, &recorded, self.clock.wall_s());
        }
        let remedy = match self.most_pushes {
            0 => {
                "with leave_saddles: 1 or more the motion is pushed off saddles and continues; an \
                 imperfection of the filament, such as (amplitude_nm: 0.01, seed: 1), keeps it off them"
            }
            _ => "more pushes or a longer duration_ns may lead off it",
        };
        Failure::Saddle(saddle(certificate, self.most_pushes, remedy))
    }

    fn certificate(&mut self, reason: Reason, system: &System) -> Option<Certificate> {
        let record = self.records.last()?;
        let judge = self
            .judge
            .as_mut()
            .filter(|_| reason != Reason::Interrupted)?;
        let nearest = judge.equilibrium(record, system, reason == Reason::Converged)?;
        Some(nearest.certificate)
    }

    fn check_hinges(&mut self) -> ControlFlow<()> {
        let Some(slip) = self.hinges.slip() else {
            return ControlFlow::Continue(());
        };
        self.records.lost = Some(TurnLoss::Hinge(slip));
        ControlFlow::Break(())
    }

    fn keep(&mut self, checkpoint: Checkpoint) {
        let position = self.position_at(checkpoint);
        self.records.checkpoint(&position, self.clock.wall_s());
    }

    fn position_at(&self, checkpoint: Checkpoint) -> RunPosition {
        RunPosition::Motion(Box::new(MotionPosition {
            events: self.events_until(checkpoint.here.step),
            checkpoint,
            pushes: self.pushes.clone(),
            behind_switch: self.behind_switch,
        }))
    }
}

impl Observer for Recorder<'_> {
    fn observe(&mut self, moment: &mut Moment<'_>) -> ControlFlow<()> {
        self.check_hinges()?;
        if !self.records.take(record(moment)) {
            return ControlFlow::Break(());
        }
        self.has_new_record = true;
        self.records.sink.progress(&Progress {
            at: At::Time(moment.time),
            end: self.end_ns,
            steps: moment.step,
            residual_force_pn: moment.residual().force,
        });
        ControlFlow::Continue(())
    }

    fn intervene(&mut self, time: f64, at_rest: bool, system: &mut System) -> bool {
        if self.most_pushes == 0 || time < self.rest_from_ns {
            return false;
        }
        let (Some(judge), Some(record)) = (&mut self.judge, self.records.last()) else {
            return false;
        };
        let nearest = judge.equilibrium(record, system, at_rest);
        let Some(nearest) = nearest.filter(|n| is_saddle(&n.certificate)) else {
            return false;
        };
        // The motion is still leaving the saddle of the last perturbation.
        let last = self.pushes.last();
        if last.is_some_and(|push| push.led_off(record, &nearest)) {
            return true;
        }
        if self.pushes.len() == self.most_pushes {
            return false;
        }
        let push = judge.push((record, &nearest), system);
        self.pushes.extend(push);
        push.is_some()
    }

    fn pause(&mut self, pause: &Pause<'_>) -> ControlFlow<()> {
        self.check_hinges()?;
        if let Some(check) = &mut self.step_check {
            check.compare(
                pause.state(),
                pause.step,
                &mut self.records.recorded.carried.steps,
            );
        }
        if self.has_new_record {
            // Only saddles are left without their record; a heat bath has none.
            let recorded = self.judge.as_ref().map(|_| self.records.recorded.clone());
            self.last_good = Some((pause.checkpoint(), recorded));
            self.has_new_record = false;
        }
        let may_leave = pause.step.is_multiple_of(self.leave_every);
        self.is_interrupted = may_leave && self.records.sink.is_left(pause.step, pause.state())
            || self.records.sink.is_interrupted();
        if self.is_interrupted || self.records.sink.is_checkpoint_due() {
            self.keep(pause.checkpoint());
        }
        if self.is_interrupted {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }

    fn finish(&mut self, end: &Pause<'_>) {
        let checkpoint = end.checkpoint();
        self.largest_kinetic_pn_nm = checkpoint.here.largest_kinetic;
        self.keep(checkpoint);
    }

    fn fail(&mut self, last_good: &Checkpoint) {
        self.keep(last_good.clone());
    }
}

pub(crate) fn record(moment: &mut Moment<'_>) -> Record {
    let residual = moment.residual();
    let kinetic_pn_nm = moment.kinetic_energy();
    let at = At::Time(moment.time);
    Record {
        row: Row::new(at, kinetic_pn_nm, residual, moment.energies()),
        state: moment.state().clone(),
    }
}

//! Observer of a motion: records, checkpoints, lost turns, and perturbation at saddles.

use super::hinge::HingeWatch;
use super::record_stream::RecordStream;
use super::rest::{RestJudge, SaddlePush, is_saddle};
use super::sink::{Clock, MotionPosition, ResolutionSwitch, SavedRun};
use super::slip::TurnLoss;
use super::step_check::StepCheck;
use super::{Progress, Record, RecordSummary, Row, RunPosition, Sink};
use crate::At;
use crate::scene::{Dynamics, Task};
use crate::{Assembly, EnergyExchange, LinkerEvent};
use actin_assembly::{Log, Ramp};
use actin_equilibrium::Certificate;
use actin_integrate::{
    Checkpoint, DEFAULT_CHECK_EVERY, Moment, Observer, Pause, Reason, Run, RunFailure, RunOutcome,
    Stepper,
};
use actin_mechanics::System;
use std::ops::ControlFlow;
use std::sync::{Arc, Mutex, PoisonError};

/// Observer that records a motion and perturbs it at saddles.
pub(super) struct Recorder<'a> {
    pub(super) taken: RecordStream<'a>,
    pub(super) pushes: Vec<SaddlePush>,
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
    is_behind: bool,
    is_interrupted: bool,
    assembly: &'a Assembly,
    /// Log of linker events.
    log: Log,
    hinges: HingeWatch,
    /// Largest kinetic energy at a check (pN nm), set at the end.
    pub(super) largest_kinetic_pn_nm: f64,
    pub(super) behind_switch: Option<ResolutionSwitch>,
    /// Comparison with shorter steps.
    pub(super) step_check: Option<StepCheck<'a>>,
    /// Steps between queries whether to leave the motion.
    look_every: u64,
}

pub(super) enum Ending {
    /// Interrupted; can be resumed.
    Interrupted(RunOutcome),
    /// Completed, with the certificate of a state at rest.
    Ended(RunOutcome, Option<Certificate>),
    /// Turns were lost; with the step of the last good state.
    Slipped(TurnLoss, u64),
    /// The state diverged.
    Failed(RunFailure),
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
        Self {
            taken: RecordStream::new(assembly, recorded, sink),
            pushes,
            end_ns: dynamics.duration_ns,
            rest_from_ns: Ramp::from_assembly(assembly).map_or(0.0, |ramp| ramp.duration()),
            most_pushes: dynamics.leave_saddles,
            clock,
            judge: RestJudge::new(assembly, dynamics),
            is_behind: position.is_none(),
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
            hinges: HingeWatch::new(assembly),
            behind_switch,
            look_every: match assembly.scene.task {
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
        if let Some(drive) = self.hinges.beside(Ramp::from_assembly(self.assembly)) {
            system.set_drive(drive);
        }
        self.rest_from_ns
    }

    pub(super) fn let_happen(&self, system: &mut System) {
        if let Some(kinetics) = &self.assembly.kinetics {
            system.set_step_end(kinetics.event_process(&self.log));
        }
    }

    pub(super) fn events(&self) -> Vec<LinkerEvent> {
        let log = self.log.lock().unwrap_or_else(PoisonError::into_inner);
        log.clone()
    }

    fn events_until(&self, step: u64) -> Vec<LinkerEvent> {
        let mut events = self.events();
        events.retain(|event| event.step <= step);
        events
    }

    pub(super) fn execute_steps(
        &mut self,
        run: &Run,
        stepper: &mut dyn Stepper,
        system: &mut System,
    ) -> Result<RunOutcome, RunFailure> {
        match self.position.take() {
            None => run.execute_steps(stepper, system, &mut [self]),
            Some(checkpoint) => {
                self.begin_hinges(&checkpoint, system);
                run.resume_steps(&checkpoint, stepper, system, &mut [self])
            }
        }
    }

    pub(super) fn execute(
        &mut self,
        run: &Run,
        system: &mut System,
    ) -> Result<RunOutcome, RunFailure> {
        match self.position.take() {
            None => run.execute(system, &mut [self]),
            Some(checkpoint) => {
                self.begin_hinges(&checkpoint, system);
                run.resume(&checkpoint, system, &mut [self])
            }
        }
    }

    fn begin_hinges(&mut self, checkpoint: &Checkpoint, system: &System) {
        let mut state = system.state().clone();
        state.set_motion(&checkpoint.here.motion);
        self.hinges.begin(&state);
    }

    pub(super) fn begun_with_pn_nm(&self) -> f64 {
        let built = || self.assembly.system.total_energy();
        self.behind_switch.map_or_else(built, |s| s.energy_pn_nm)
    }

    /// Returns `true` if the motion started with the scene and not after a switch of cells.
    pub(super) fn is_whole(&self) -> bool {
        self.behind_switch.is_none()
    }

    pub(super) fn wall_s(&self) -> f64 {
        self.clock.wall_s()
    }

    /// Determines the end of the motion. After lost turns `system` returns to the last good state.
    /// A checkpoint is kept after lost turns and at a saddle.
    pub(super) fn end(
        &mut self,
        outcome: Result<RunOutcome, RunFailure>,
        system: &mut System,
    ) -> Ending {
        let outcome = match outcome {
            Ok(outcome) => outcome,
            Err(failure) => return Ending::Failed(failure),
        };
        if let Some(lost) = self.taken.lost() {
            let step = self.last_good.as_ref().map_or(0, |good| good.0.here.step);
            if let Some((good, _)) = self.last_good.take() {
                system.state_mut().set_motion(&good.here.motion);
                // The slipped state was not recorded.
                self.keep(good);
            }
            return Ending::Slipped(lost, step);
        }
        if self.is_interrupted {
            return Ending::Interrupted(outcome);
        }
        let certificate = self.certificate(outcome.reason, system);
        if certificate.as_ref().is_some_and(is_saddle) {
            // The last record ended the run and belongs after the last good state. Without an
            // earlier record since the run was resumed, the existing checkpoint stays.
            if let Some((good, Some(recorded))) = self.last_good.take() {
                let position = self.position_at(good);
                let wall_s = self.wall_s();
                self.taken.checkpoint_behind(&position, &recorded, wall_s);
            }
        }
        Ending::Ended(outcome, certificate)
    }

    fn certificate(&mut self, reason: Reason, system: &System) -> Option<Certificate> {
        let record = self.taken.last()?;
        let judge = self
            .judge
            .as_mut()
            .filter(|_| reason != Reason::Interrupted)?;
        let nearest = judge.equilibrium(record, system, reason == Reason::Converged)?;
        Some(nearest.certificate)
    }

    fn look_at_hinges(&mut self) -> ControlFlow<()> {
        let Some(slip) = self.hinges.slip() else {
            return ControlFlow::Continue(());
        };
        self.taken.lose(TurnLoss::Hinge(slip));
        ControlFlow::Break(())
    }

    fn keep(&mut self, checkpoint: Checkpoint) {
        let position = self.position_at(checkpoint);
        self.taken.checkpoint(&position, self.clock.wall_s());
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
        self.look_at_hinges()?;
        if !self.taken.take(record(moment)) {
            return ControlFlow::Break(());
        }
        self.is_behind = true;
        self.taken.progress(&progress(moment, self.end_ns));
        ControlFlow::Continue(())
    }

    fn intervene(&mut self, time: f64, at_rest: bool, system: &mut System) -> bool {
        if self.most_pushes == 0 || time < self.rest_from_ns {
            return false;
        }
        let (Some(judge), Some(record)) = (&mut self.judge, self.taken.last()) else {
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
        self.look_at_hinges()?;
        if let Some(check) = &mut self.step_check {
            check.compare(pause.state(), pause.step, self.taken.step_comparisons());
        }
        if self.is_behind {
            // Only saddles are left without their record; a heat bath has none.
            let recorded = self.judge.as_ref().map(|_| self.taken.recorded().clone());
            self.last_good = Some((pause.checkpoint(), recorded));
            self.is_behind = false;
        }
        let is_look = pause.step.is_multiple_of(self.look_every);
        self.is_interrupted = is_look && self.taken.sink.is_left(pause.step, pause.state())
            || self.taken.sink.is_interrupted();
        if self.is_interrupted || self.taken.sink.is_checkpoint_due() {
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

fn progress(moment: &mut Moment<'_>, end_ns: f64) -> Progress {
    Progress {
        at: At::Time(moment.time),
        end: end_ns,
        steps: moment.step,
        residual_force_pn: moment.residual().force,
    }
}

pub(crate) fn record(moment: &mut Moment<'_>) -> Record {
    let residual = moment.residual();
    let row = Row {
        at: At::Time(moment.time),
        kinetic_pn_nm: moment.kinetic_energy(),
        residual_force_pn: residual.force,
        residual_torque_pn_nm: residual.torque,
        booked: EnergyExchange::default(),
        energies_pn_nm: moment.energies(),
        observed: Vec::new(),
    };
    Record {
        row,
        state: moment.state().clone(),
    }
}

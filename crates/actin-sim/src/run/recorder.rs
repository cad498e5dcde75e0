//! Watching a motion: records, checkpoints, twist that slips, and pushes off saddles.

use super::keep::{Clock, Keeper, Kept, MotionStanding, Standing};
use super::rest::{RestJudge, SaddlePush, is_saddle};
use super::slip::{LinkWatch, Slip};
use super::{Progress, Record, Trajectory};
use crate::Assembly;
use crate::assembly::Ramp;
use crate::scene::Dynamics;
use actin_equilibrium::Certificate;
use actin_integrate::{Checkpoint, Moment, Observer, Outcome, Pause, Reason, Run, RunFailure};
use actin_mechanics::System;
use std::ops::ControlFlow;

/// Records what is observed and lets the keeper keep it.
pub(super) struct Recorder<'a> {
    pub(super) trajectory: Trajectory,
    pub(super) pushes: Vec<SaddlePush>,
    assembly: &'a Assembly,
    end_ns: f64,
    /// When the path is over (ns): before that nothing is at rest.
    rest_from_ns: f64,
    most_pushes: usize,
    clock: Clock,
    judge: Option<RestJudge<'a>>,
    links: LinkWatch,
    slip: Option<Slip>,
    /// Where the run stood at the last record from which it went on.
    last_good: Option<Checkpoint>,
    /// Whether there has been a record since.
    is_behind: bool,
    is_left: bool,
    keeper: &'a mut dyn Keeper,
    watch: Watch<'a>,
}

type Watch<'a> = &'a mut dyn FnMut(Progress) -> ControlFlow<()>;

/// How a motion ended.
pub(super) enum Ending {
    /// Left, to be taken up again.
    Left(Outcome),
    /// At its end, with what the stiffness says if it is at rest.
    Ended(Outcome, Option<Certificate>),
    /// Twist was lost; the step of the last good state.
    Slipped(Slip, u64),
    /// The state became unsound.
    Failed(RunFailure),
}

impl<'a> Recorder<'a> {
    /// A recorder of the motion of `system`, which has been taken out of `assembly`.
    pub(super) fn new(
        assembly: &'a Assembly,
        dynamics: &Dynamics,
        system: &System,
        (keeper, watch): (&'a mut dyn Keeper, Watch<'a>),
        clock: Clock,
    ) -> Self {
        Self {
            trajectory: Trajectory::default(),
            pushes: Vec::new(),
            assembly,
            end_ns: dynamics.duration_ns,
            rest_from_ns: Ramp::of(assembly).map_or(0.0, |ramp| ramp.duration()),
            most_pushes: dynamics.leave_saddles,
            clock,
            judge: RestJudge::new(assembly, dynamics),
            links: LinkWatch::new(assembly, system.state()),
            slip: None,
            last_good: None,
            is_behind: true,
            is_left: false,
            keeper,
            watch,
        }
    }

    /// Executes the plan, from where it was left if it was.
    pub(super) fn execute(
        &mut self,
        plan: &Run,
        system: &mut System,
        kept: Option<Kept>,
    ) -> Result<Outcome, RunFailure> {
        let Some(kept) = kept else {
            return plan.execute(system, &mut [self]);
        };
        let Standing::Motion(standing) = kept.standing else {
            panic!("a path of equilibria is no motion in time");
        };
        let MotionStanding { checkpoint, pushes } = *standing;
        self.trajectory = kept.trajectory;
        self.links.follow(self.assembly, &self.trajectory.records);
        self.pushes = pushes;
        self.is_behind = false;
        self.last_good = Some(Checkpoint {
            here: checkpoint.last_good.clone(),
            ..checkpoint.clone()
        });
        plan.resume(&checkpoint, system, &mut [self])
    }

    /// What became of the motion. Where it lost twist, `system` is put back to the last good state.
    /// Where it lost twist or ended on a saddle, that state is kept.
    pub(super) fn end(
        &mut self,
        outcome: Result<Outcome, RunFailure>,
        system: &mut System,
    ) -> Ending {
        let outcome = match outcome {
            Ok(outcome) => outcome,
            Err(failure) => return Ending::Failed(failure),
        };
        if let Some(slip) = self.slip.take() {
            let step = self.last_good.as_ref().map_or(0, |good| good.here.step);
            if let Some(good) = &self.last_good {
                system.state_mut().copy_motion_from(&good.here.state);
            }
            self.keep_last_good(self.trajectory.records.len());
            return Ending::Slipped(slip, step);
        }
        if self.is_left {
            return Ending::Left(outcome);
        }
        let certificate = self.certificate(outcome.reason, system);
        if certificate.as_ref().is_some_and(is_saddle) {
            // The last record ended the run: it belongs to what comes after the last good state.
            self.keep_last_good(self.trajectory.records.len() - 1);
        }
        Ending::Ended(outcome, certificate)
    }

    /// What the stiffness says of the state in which the motion has come to rest, if it has.
    fn certificate(&mut self, reason: Reason, system: &System) -> Option<Certificate> {
        let record = self.trajectory.records.last()?;
        let judge = self
            .judge
            .as_mut()
            .filter(|_| reason != Reason::Interrupted)?;
        let nearest = judge.equilibrium(record, system, reason == Reason::Converged)?;
        Some(nearest.certificate)
    }

    fn keep(&mut self, checkpoint: Checkpoint, records: usize) {
        let standing = Standing::Motion(Box::new(MotionStanding {
            checkpoint,
            pushes: self.pushes.clone(),
        }));
        let records = &self.trajectory.records[..records];
        self.keeper.keep(&standing, records, self.clock.wall_s());
    }

    fn keep_last_good(&mut self, records: usize) {
        if let Some(good) = self.last_good.clone() {
            self.keep(good, records);
        }
    }
}

impl Observer for Recorder<'_> {
    fn observe(&mut self, moment: &mut Moment<'_>) -> ControlFlow<()> {
        let record = record(moment);
        let before = self.trajectory.records.last().map(|record| &record.state);
        let here = (&record.state, record.time_ns);
        self.slip = self.links.slip(self.assembly, here, before);
        if self.slip.is_some() {
            return ControlFlow::Break(());
        }
        self.trajectory.records.push(record);
        self.is_behind = true;
        (self.watch)(progress(moment, self.end_ns))
    }

    fn intervene(&mut self, time: f64, at_rest: bool, system: &mut System) -> bool {
        if self.most_pushes == 0 || time < self.rest_from_ns {
            return false;
        }
        let (Some(judge), Some(record)) = (&mut self.judge, self.trajectory.records.last()) else {
            return false;
        };
        let nearest = judge.equilibrium(record, system, at_rest);
        let Some(nearest) = nearest.filter(|n| is_saddle(&n.certificate)) else {
            return false;
        };
        // On its way down from where the last push led it off, it needs no other.
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
        if self.is_behind {
            self.last_good = Some(pause.checkpoint());
            self.is_behind = false;
        }
        self.is_left = self.keeper.is_interrupted();
        if self.is_left || self.keeper.is_due() {
            self.keep(pause.checkpoint(), self.trajectory.records.len());
        }
        if self.is_left {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }

    fn finish(&mut self, end: &Pause<'_>) {
        self.keep(end.checkpoint(), self.trajectory.records.len());
    }

    fn fail(&mut self, last_good: &Checkpoint) {
        self.keep(last_good.clone(), self.trajectory.records.len());
    }
}

fn progress(moment: &mut Moment<'_>, end_ns: f64) -> Progress {
    Progress {
        time_ns: moment.time,
        end_ns,
        steps: moment.step,
        residual_force_pn: moment.residual().force,
    }
}

fn record(moment: &mut Moment<'_>) -> Record {
    let residual = moment.residual();
    Record {
        time_ns: moment.time,
        state: moment.state().clone(),
        energies_pn_nm: moment.energies(),
        kinetic_pn_nm: moment.kinetic_energy(),
        residual_force_pn: residual.force,
        residual_torque_pn_nm: residual.torque,
    }
}

//! Motion in time: the time step, the run loop and the records.

use super::bound::kinetic_limit;
use super::keep::{Clock, Keeper, Kept, Standing};
use super::steps::Steps;
use super::{Progress, Record, RunError, RunReport, Trajectory};
use crate::Assembly;
use crate::assembly::Ramp;
use crate::scene::{Dynamics, Integrator, Problem, RodLaw, StopRule, Task};
use actin_integrate::{
    Bath, Checkpoint, Composition, Drag, Moment, Observer, Outcome, Pause, Reason, Run, RunFailure,
};
use actin_mechanics::{Split, System};
use std::ops::ControlFlow;

/// Most states of bodies that a run may record: at about 100 bytes each, beyond it memory runs out.
const MOST_RECORDED: f64 = 1e8;

/// What a scene will cost, known before it runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Largest frequency of the built filament (rad/ns); where shear stiffens its rods, at least
    /// that with constant rigidities.
    pub largest_frequency_rad_per_ns: f64,
    /// Largest stable time step of the chosen integrator (ns).
    pub stability_limit_ns: f64,
    /// Time step that will be taken (ns).
    pub time_step_ns: f64,
    /// Steps, if the stop rule does not end the run before.
    pub steps: u64,
    /// Steps between two records.
    pub steps_between_records: u64,
    /// Time between two records (ns).
    pub record_every_ns: f64,
    /// Load evaluations in these steps.
    pub force_evaluations: u64,
}

impl Integrator {
    /// The coefficient table of the integrator.
    pub fn composition(self) -> &'static Composition {
        match self {
            Self::PositionVerlet => &actin_integrate::POSITION_VERLET,
            Self::Pefrl => &actin_integrate::PEFRL,
            Self::Vefrl => &actin_integrate::VEFRL,
            Self::ForestRuth => &actin_integrate::FOREST_RUTH,
            Self::Suzuki => &actin_integrate::SUZUKI,
        }
    }
}

/// What the scene of `assembly` will cost: its time step and the number of steps; `None` of an
/// equilibrium, which takes no time steps.
///
/// # Errors
/// A time step above the stability limit that the scene does not explicitly allow, a turn that its
/// segments cannot follow, and more steps or records than can be counted or kept.
pub fn estimate(assembly: &Assembly) -> Result<Option<Estimate>, Problem> {
    match &assembly.scene.task {
        Task::Dynamics(dynamics) => estimate_of(assembly, dynamics).map(Some),
        Task::Equilibrium(_) => Ok(None),
    }
}

fn estimate_of(assembly: &Assembly, dynamics: &Dynamics) -> Result<Estimate, Problem> {
    assembly.check_slip()?;
    let scheme = dynamics.integrator.composition();
    let refused = |what: String| Problem::new("filament", what, "has no stable time step");
    let frequency_of = |assembly: &Assembly| {
        actin_integrate::largest_frequency(&assembly.system)
            .map_err(|error| refused(error.to_string()))
    };
    let mut frequency = frequency_of(assembly)?;
    if let Some(constant) = with_constant_rods(assembly)? {
        frequency = frequency.max(frequency_of(&constant)?);
    }
    let limit = actin_integrate::stable_step(scheme, frequency, 1.0)
        .map_err(|error| refused(error.to_string()))?;
    let wanted = dynamics
        .time_step_ns
        .unwrap_or(limit * dynamics.step_safety);
    if wanted > limit && !dynamics.allow_unstable_step {
        return Err(unstable(scheme, wanted, limit, frequency));
    }
    let steps = Steps::of(dynamics, wanted)?;
    check_records(assembly, dynamics, &steps)?;
    Ok(Estimate {
        largest_frequency_rad_per_ns: frequency,
        stability_limit_ns: limit,
        time_step_ns: steps.length_ns,
        steps: steps.count,
        steps_between_records: steps.between_records,
        record_every_ns: steps.record_every_ns,
        force_evaluations: steps.count * scheme.force_evaluations_per_step() as u64,
    })
}

/// A time step (ns) above the limit (ns) at a frequency (rad/ns).
fn unstable(scheme: &Composition, wanted: f64, limit: f64, frequency: f64) -> Problem {
    Problem::new(
        "task.time_step_ns",
        format!("{wanted:?}"),
        format!(
            "above the stability limit of {limit:.4e} ns ({} at the largest frequency, \
             {frequency:.1} rad/ns); allow_unstable_step: true runs it all the same",
            scheme.name()
        ),
    )
}

/// Refuses records that would not fit into memory.
fn check_records(assembly: &Assembly, dynamics: &Dynamics, steps: &Steps) -> Result<(), Problem> {
    let records = steps.count / steps.between_records + 1;
    let bodies = assembly.points.len() + assembly.frames.len();
    if records as f64 * bodies as f64 <= MOST_RECORDED {
        return Ok(());
    }
    Err(Problem::new(
        "task.record_every_ns",
        format!(
            "{:?}",
            dynamics.record_every_ns.unwrap_or(steps.record_every_ns)
        ),
        format!(
            "{records:.2e} records of {bodies} bodies, at most {MOST_RECORDED:e} states of bodies \
             are kept",
            records = records as f64
        ),
    ))
}

/// The same filaments with rods of constant rigidities, where rods resist shear only once they
/// are sheared: what they show at rest is not what a motion meets.
fn with_constant_rods(assembly: &Assembly) -> Result<Option<Assembly>, Problem> {
    let shears_softly = |law: &RodLaw| match law {
        RodLaw::Constant | RodLaw::PublishedExtension | RodLaw::CouplingEnergy => false,
        RodLaw::Fitted => true,
        RodLaw::Laws(laws) => laws.shear.is_some(),
    };
    let mut scene = assembly.scene.clone();
    let mut changes = false;
    for (i, filament) in scene.filaments_mut().enumerate() {
        if shears_softly(&filament.rod.law) && assembly.counts_of(i).segments > 0 {
            filament.rod.law = RodLaw::Constant;
            changes = true;
        }
    }
    if !changes {
        return Ok(None);
    }
    Assembly::build(&scene).map(Some)
}

/// Runs the motion.
pub(super) fn run(
    assembly: &mut Assembly,
    dynamics: &Dynamics,
    kept: Option<Kept>,
    keeper: &mut dyn Keeper,
    watch: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Result<(Trajectory, RunReport), RunError> {
    let (estimate, plan) = prepare(assembly, dynamics)?;
    let clock = Clock::new(kept.as_ref());
    let mut recorder = Recorder {
        trajectory: Trajectory::default(),
        end_ns: dynamics.duration_ns,
        clock,
        is_left: false,
        keeper,
        watch,
    };
    let outcome = recorder.execute(&plan, &mut assembly.system, kept);
    let report = |steps, force_evaluations| RunReport {
        interrupted: recorder.is_left,
        steps,
        force_evaluations,
        ..estimate.report(clock)
    };
    let evaluations = assembly.system.force_evaluations();
    match outcome {
        Ok(end) => {
            let report = RunReport {
                converged: end.reason == Reason::Converged,
                ..report(end.steps, end.force_evaluations)
            };
            Ok((recorder.trajectory, report))
        }
        Err(failure) => Err(RunError::Failed {
            report: Box::new(RunReport {
                failed: true,
                ..report(failure.last_good_step, evaluations)
            }),
            body: assembly.describe(failure.body),
            failure: Box::new(failure),
            trajectory: Box::new(recorder.trajectory),
        }),
    }
}

/// The run that the scene asks for; the scene is resolved and its path set going.
fn prepare(assembly: &mut Assembly, dynamics: &Dynamics) -> Result<(Estimate, Run), Problem> {
    let estimate = estimate_of(assembly, dynamics)?;
    let limit = kinetic_limit(assembly);
    let plan = plan(dynamics, &estimate)?
        .stopping_from(drive(assembly))
        .with_kinetic_limit(limit)
        .expect("the limit is positive");
    // The bound is that of all energy. In a bath it is not: strain has heat of its own.
    let plan = match dynamics.thermal {
        Some(_) => plan,
        None => plan
            .with_energy_limit(limit)
            .expect("the limit is a number"),
    };
    assembly.resolve(&estimate);
    Ok((estimate, plan))
}

/// Records what is observed and lets the keeper keep it.
struct Recorder<'a> {
    trajectory: Trajectory,
    end_ns: f64,
    clock: Clock,
    is_left: bool,
    keeper: &'a mut dyn Keeper,
    watch: &'a mut dyn FnMut(Progress) -> ControlFlow<()>,
}

impl Recorder<'_> {
    /// Executes the plan, from where it was left if it was.
    fn execute(
        &mut self,
        plan: &Run,
        system: &mut System,
        kept: Option<Kept>,
    ) -> Result<Outcome, RunFailure> {
        let Some(kept) = kept else {
            return plan.execute(system, &mut [self]);
        };
        let Standing::Motion(checkpoint) = kept.standing else {
            panic!("a path of equilibria is no motion in time");
        };
        self.trajectory = kept.trajectory;
        plan.resume(&checkpoint, system, &mut [self])
    }

    fn keep(&mut self, checkpoint: Checkpoint) {
        let standing = Standing::Motion(Box::new(checkpoint));
        let records = &self.trajectory.records;
        self.keeper.keep(&standing, records, self.clock.wall_s());
    }
}

impl Observer for Recorder<'_> {
    fn observe(&mut self, moment: &mut Moment<'_>) -> ControlFlow<()> {
        self.trajectory.records.push(record(moment));
        (self.watch)(progress(moment, self.end_ns))
    }

    fn pause(&mut self, pause: &Pause<'_>) -> ControlFlow<()> {
        self.is_left = self.keeper.is_interrupted();
        if self.is_left || self.keeper.is_due() {
            self.keep(pause.checkpoint());
        }
        if self.is_left {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }

    fn fail(&mut self, last_good: &Checkpoint) {
        self.keep(last_good.clone());
    }
}

impl Estimate {
    /// The report of a run that has taken the time of `clock` and has counted nothing yet.
    fn report(&self, clock: Clock) -> RunReport {
        RunReport {
            converged: false,
            failed: false,
            interrupted: false,
            steps: 0,
            force_evaluations: 0,
            time_step_ns: Some(self.time_step_ns),
            largest_frequency_rad_per_ns: Some(self.largest_frequency_rad_per_ns),
            equilibrium: None,
            wall_s: clock.wall_s(),
        }
    }
}

/// Sets the path of the scene going, if there is one, and returns the time that it takes (ns).
fn drive(assembly: &mut Assembly) -> f64 {
    let Some(ramp) = Ramp::of(assembly) else {
        return 0.0;
    };
    let duration = ramp.duration();
    assembly.system.set_drive(Box::new(ramp));
    duration
}

/// The run that the scene asks for. Its numbers were validated with the scene.
fn plan(dynamics: &Dynamics, estimate: &Estimate) -> Result<Run, Problem> {
    let refused = |key: &str, error: &dyn std::error::Error| {
        Problem::new(format!("task.{key}"), "", error.to_string())
    };
    let drag = Drag::new(
        dynamics.drag.translational_per_ns,
        dynamics.drag.rotational_per_ns,
    )
    .map_err(|error| refused("drag", &error))?;
    let step = estimate.time_step_ns;
    let scheme = dynamics.integrator.composition();
    let run = Run::new(scheme, step, estimate.steps)
        .and_then(|run| run.observing_every(estimate.steps_between_records))
        .map_err(|error| refused("time_step_ns", &error))?;
    let run = match &dynamics.thermal {
        None => run.with_drag(drag),
        Some(thermal) => Bath::new(drag, thermal.energy_pn_nm(), thermal.seed)
            .map(|bath| run.with_bath(bath))
            .map_err(|error| refused("thermal.temperature_k", &error))?,
    };
    let Some(StopRule {
        force_pn,
        torque_pn_nm,
        kinetic_pn_nm,
    }) = dynamics.stop
    else {
        return Ok(run);
    };
    actin_integrate::StopRule::new(force_pn, torque_pn_nm, kinetic_pn_nm)
        .map(|rule| run.with_stop_rule(rule))
        .map_err(|error| refused("stop", &error))
}

impl Assembly {
    /// Writes the time step and the interval of records that a motion will have into the scene.
    pub fn resolve(&mut self, estimate: &Estimate) {
        let Task::Dynamics(dynamics) = &mut self.scene.task else {
            return;
        };
        dynamics.time_step_ns = Some(estimate.time_step_ns);
        dynamics.record_every_ns = Some(estimate.record_every_ns);
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

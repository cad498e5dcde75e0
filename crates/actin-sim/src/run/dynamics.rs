//! Motion in time: the time step, the run loop and the records.

use super::bound::kinetic_limit;
use super::{Progress, Record, RunError, RunReport, Trajectory};
use crate::Assembly;
use crate::assembly::Ramp;
use crate::scene::{Dynamics, Integrator, Problem, RodLaw, StopRule, Task};
use actin_integrate::{Composition, Drag, Moment, Reason, Run};
use actin_mechanics::Split;
use std::ops::ControlFlow;
use std::time::Instant;

/// Records of a run, unless the scene says otherwise.
const DEFAULT_RECORDS: f64 = 100.0;

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
    let run = Run::over(scheme, wanted, dynamics.duration_ns).map_err(|_| {
        Problem::new(
            "task.duration_ns",
            format!("{:?}", dynamics.duration_ns),
            format!("takes more steps of {wanted:.4e} ns than can be counted, 2^53"),
        )
    })?;
    check_records(assembly, dynamics, &run)?;
    Ok(Estimate {
        largest_frequency_rad_per_ns: frequency,
        stability_limit_ns: limit,
        time_step_ns: run.step(),
        steps: run.steps(),
        force_evaluations: run.steps() * scheme.force_evaluations_per_step() as u64,
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
            scheme.name
        ),
    )
}

/// Refuses records that would not fit into memory.
fn check_records(assembly: &Assembly, dynamics: &Dynamics, run: &Run) -> Result<(), Problem> {
    let between = steps_between_records(dynamics, run.step());
    let records = run.steps() / between + 1;
    let bodies = assembly.points.len() + assembly.frames.len();
    if records as f64 * bodies as f64 <= MOST_RECORDED {
        return Ok(());
    }
    let every = between as f64 * run.step();
    Err(Problem::new(
        "task.record_every_ns",
        format!("{:?}", dynamics.record_every_ns.unwrap_or(every)),
        format!(
            "{records:.2e} records of {bodies} bodies, at most {MOST_RECORDED:e} states of bodies \
             are kept",
            records = records as f64
        ),
    ))
}

/// The same filament with rods of constant rigidities, where its rods resist shear only once they
/// are sheared: what they show at rest is not what a motion meets.
fn with_constant_rods(assembly: &Assembly) -> Result<Option<Assembly>, Problem> {
    let rod = &assembly.scene.filament.rod;
    let shears_softly = match &rod.law {
        RodLaw::Constant | RodLaw::PublishedExtension | RodLaw::CouplingEnergy => false,
        RodLaw::Fitted => true,
        RodLaw::Laws(laws) => laws.shear.is_some(),
    };
    if !shears_softly || assembly.counts().segments == 0 {
        return Ok(None);
    }
    let mut scene = assembly.scene.clone();
    scene.filament.rod.law = RodLaw::Constant;
    Assembly::build(&scene).map(Some)
}

/// Runs the motion.
pub(super) fn run(
    assembly: &mut Assembly,
    dynamics: &Dynamics,
    watch: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Result<(Trajectory, RunReport), RunError> {
    let estimate = estimate_of(assembly, dynamics)?;
    let plan = plan(dynamics, &estimate)?
        .stopping_from(drive(assembly))
        .with_kinetic_limit(kinetic_limit(assembly))
        .expect("the limit is positive");
    assembly.resolve(&estimate);
    let started = Instant::now();
    let mut trajectory = Trajectory::default();
    let mut observer = |moment: &mut Moment<'_>| {
        trajectory.records.push(record(moment));
        watch(progress(moment, dynamics))
    };
    let outcome = plan.execute(&mut assembly.system, &mut [&mut observer]);
    let report = |converged, steps, force_evaluations| RunReport {
        converged,
        steps,
        force_evaluations,
        ..estimate.report(started)
    };
    let evaluations = assembly.system.force_evaluations();
    match outcome {
        Ok(end) => {
            let converged = end.reason == Reason::Converged;
            Ok((
                trajectory,
                report(converged, end.steps, end.force_evaluations),
            ))
        }
        Err(failure) => Err(RunError::Failed {
            report: Box::new(RunReport {
                failed: true,
                ..report(false, failure.last_good_step, evaluations)
            }),
            body: assembly.describe(failure.body),
            failure: Box::new(failure),
            trajectory: Box::new(trajectory),
        }),
    }
}

impl Estimate {
    /// The report of a run that began at `started` and has counted nothing yet.
    fn report(&self, started: Instant) -> RunReport {
        RunReport {
            converged: false,
            failed: false,
            steps: 0,
            force_evaluations: 0,
            time_step_ns: Some(self.time_step_ns),
            largest_frequency_rad_per_ns: Some(self.largest_frequency_rad_per_ns),
            equilibrium: None,
            wall_s: started.elapsed().as_secs_f64(),
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
        .and_then(|run| run.observing_every(steps_between_records(dynamics, step)))
        .map_err(|error| refused("time_step_ns", &error))?
        .with_drag(drag);
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

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a positive quotient; the conversion saturates"
)]
fn steps_between_records(dynamics: &Dynamics, step_ns: f64) -> u64 {
    let every = dynamics
        .record_every_ns
        .unwrap_or(dynamics.duration_ns / DEFAULT_RECORDS);
    ((every / step_ns).round() as u64).max(1)
}

impl Assembly {
    /// Writes the time step and the interval of records that a motion will have into the scene.
    pub fn resolve(&mut self, estimate: &Estimate) {
        let Task::Dynamics(dynamics) = &mut self.scene.task else {
            return;
        };
        let step = estimate.time_step_ns;
        let between_records = steps_between_records(dynamics, step) as f64 * step;
        dynamics.time_step_ns = Some(step);
        dynamics.record_every_ns = Some(between_records);
    }
}

fn progress(moment: &mut Moment<'_>, dynamics: &Dynamics) -> Progress {
    Progress {
        time_ns: moment.time,
        end_ns: dynamics.duration_ns,
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

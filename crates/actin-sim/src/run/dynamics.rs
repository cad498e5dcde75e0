//! Motion in time: the time step, the run loop and the records.

use super::bound::kinetic_limit;
use super::keep::{Clock, Keeper, Kept};
use super::points::check_points;
use super::recorder::{Ending, Recorder};
use super::rest::{is_saddle, saddle};
use super::steps::Steps;
use super::{Progress, RunError, RunReport, Trajectory};
use crate::assembly::Ramp;
use crate::scene::{Dynamics, Integrator, Problem, RodLaw, StopRule, Task};
use crate::{Assembly, memory};
use actin_integrate::{Bath, Composition, Drag, Reason, Run};
use actin_mechanics::{Split, State, System};
use std::ops::ControlFlow;

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
/// segments cannot follow, more steps than can be counted, and more records, of either task, than
/// memory holds.
pub fn estimate(assembly: &Assembly) -> Result<Option<Estimate>, Problem> {
    match &assembly.scene.task {
        Task::Dynamics(dynamics) => estimate_of(assembly, dynamics).map(Some),
        Task::Equilibrium(settings) => {
            assembly.check_slip()?;
            check_points(assembly, settings).map(|()| None)
        }
    }
}

fn estimate_of(assembly: &Assembly, dynamics: &Dynamics) -> Result<Estimate, Problem> {
    assembly.check_slip()?;
    let mut frequency = frequency_of(assembly)?;
    if let Some(constant) = with_constant_rods(assembly)? {
        frequency = frequency.max(frequency_of(&constant)?);
    }
    estimate_at(assembly, dynamics, frequency)
}

/// The largest frequency of an assembly as it stands (rad/ns).
fn frequency_of(assembly: &Assembly) -> Result<f64, Problem> {
    actin_integrate::largest_frequency(&assembly.system).map_err(|error| no_step(&error))
}

/// What leaves a filament without a time step.
fn no_step(error: &dyn std::error::Error) -> Problem {
    Problem::new("filament", error, "has no stable time step")
}

/// The same at a largest frequency (rad/ns) that is known: it is that of the filaments, whatever is
/// asked of them.
pub(crate) fn estimate_at(
    assembly: &Assembly,
    dynamics: &Dynamics,
    frequency: f64,
) -> Result<Estimate, Problem> {
    let scheme = dynamics.integrator.composition();
    let limit =
        actin_integrate::stable_step(scheme, frequency, 1.0).map_err(|error| no_step(&error))?;
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
    let records = number_of_records(steps.count, steps.between_records);
    let value = format!(
        "{:?}",
        dynamics.record_every_ns.unwrap_or(steps.record_every_ns)
    );
    let state = assembly.system.state();
    let bytes = assembly.bytes + records * memory::of_record(state, assembly.terms.len());
    memory::check(bytes, ("task.record_every_ns", value), || {
        let bodies = assembly.points.len() + assembly.frames.len();
        format!("{records:.2e} records of {bodies} bodies need")
    })
}

/// Records of a motion of so many steps, the first and the last included.
fn number_of_records(steps: u64, between_records: u64) -> f64 {
    (steps / between_records + 1) as f64
}

impl Estimate {
    /// Records that the motion makes, if the stop rule does not end it before.
    pub(crate) fn records(&self) -> f64 {
        number_of_records(self.steps, self.steps_between_records)
    }
}

/// The same filaments with rods of constant rigidities, where rods resist shear only once they
/// are sheared: what they show at rest is not what a motion meets.
fn with_constant_rods(assembly: &Assembly) -> Result<Option<Assembly>, Problem> {
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

/// Whether rods under a law resist shear only once they are sheared.
pub(crate) fn shears_softly(law: &RodLaw) -> bool {
    match law {
        RodLaw::Constant | RodLaw::PublishedExtension | RodLaw::CouplingEnergy => false,
        RodLaw::Fitted => true,
        RodLaw::Laws(laws) => laws.shear.is_some(),
    }
}

/// Runs the motion.
pub(super) fn run(
    assembly: &mut Assembly,
    (dynamics, estimate): (&Dynamics, Option<&Estimate>),
    kept: Option<Kept>,
    keeper: &mut dyn Keeper,
    watch: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Result<(Trajectory, RunReport), RunError> {
    let (estimate, plan) = prepare(assembly, dynamics, estimate)?;
    let clock = Clock::new(kept.as_ref());
    // Observers see the rest of the assembly while its system moves.
    let nothing = System::new(State::default(), Vec::new());
    let mut system = std::mem::replace(&mut assembly.system, nothing);
    let mut recorder = Recorder::new(assembly, dynamics, &system, (keeper, watch), clock);
    let outcome = recorder.execute(&plan, &mut system, kept);
    let ending = recorder.end(outcome, &mut system);
    let Recorder {
        trajectory, pushes, ..
    } = recorder;
    assembly.system = system;
    let report = RunReport {
        saddles_left: pushes.len(),
        pushes,
        ..estimate.report(clock)
    };
    conclude(assembly, dynamics, ending, (trajectory, report))
}

/// The results of a motion, by how it ended.
fn conclude(
    assembly: &Assembly,
    dynamics: &Dynamics,
    ending: Ending,
    (trajectory, report): (Trajectory, RunReport),
) -> Result<(Trajectory, RunReport), RunError> {
    let evaluations = assembly.system.force_evaluations();
    let failed = |report: RunReport, steps| RunReport {
        failed: true,
        ..report.counting(steps, evaluations)
    };
    match ending {
        Ending::Left(end) => {
            let mut report = report.counting(end.steps, end.force_evaluations);
            report.interrupted = true;
            Ok((trajectory, report))
        }
        Ending::Ended(end, at_rest) => {
            let report = RunReport {
                converged: end.reason == Reason::Converged,
                failed: at_rest.as_ref().is_some_and(is_saddle),
                at_rest,
                ..report.counting(end.steps, end.force_evaluations)
            };
            let Some(certificate) = at_rest.filter(is_saddle) else {
                return Ok((trajectory, report));
            };
            let problem = saddle(&certificate, dynamics.leave_saddles, way_off(dynamics));
            Err(RunError::saddle(problem, trajectory, report))
        }
        Ending::Slipped(slip, step) => {
            let at = format!("at {:.4} ns, ", slip.time_ns);
            Err(RunError::slipped(
                (at, slip),
                trajectory,
                failed(report, step),
            ))
        }
        Ending::Failed(failure) => Err(RunError::Failed {
            report: Box::new(failed(report, failure.last_good_step)),
            body: assembly.describe(failure.body),
            failure: Box::new(failure),
            trajectory: Box::new(trajectory),
        }),
    }
}

/// What leads a motion off a saddle, or would have.
fn way_off(dynamics: &Dynamics) -> &'static str {
    match dynamics.leave_saddles {
        0 => {
            "with leave_saddles: 1 or more the motion is pushed off saddles and goes on; an \
             imperfection of the filament, such as (amplitude_nm: 0.01, seed: 1), keeps it off them"
        }
        _ => "more pushes or a longer duration_ns may lead off it",
    }
}

/// The run that the scene asks for; the scene is resolved and its path set going.
fn prepare(
    assembly: &mut Assembly,
    dynamics: &Dynamics,
    estimate: Option<&Estimate>,
) -> Result<(Estimate, Run), Problem> {
    let estimate = match estimate {
        Some(known) => *known,
        None => estimate_of(assembly, dynamics)?,
    };
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
            at_rest: None,
            saddles_left: 0,
            pushes: Vec::new(),
            jumps: 0,
            beyond_use: Vec::new(),
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

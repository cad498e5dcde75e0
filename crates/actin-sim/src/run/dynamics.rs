//! Motion in time: time step, run and end of the run.

use super::bound::kinetic_limit;
use super::estimate::{Estimate, composition_of};
use super::recorder::{Ending, Recorder};
use super::rest::{is_saddle, saddle};
use super::sink::{Clock, SavedRun, Sink};
use super::steps::Steps;
use super::unknowns::layout;
use super::{Failure, Outcome, Status};
use crate::scene::{Dynamics, Filament, Fluid, RodLaw, SceneProblem, StopTolerances};
use crate::{Assembly, memory};
use actin_brownian::Langevin;
use actin_integrate::{Bath, Composition, Drag, Reason, Run};
use actin_mechanics::{Split, System};

pub(super) fn estimate(assembly: &Assembly, dynamics: &Dynamics) -> Result<Estimate, SceneProblem> {
    assembly.check_slip()?;
    let mut frequency = frequency_of(assembly)?;
    if let Some(constant) = with_constant_rods(assembly)? {
        frequency = frequency.max(frequency_of(&constant)?);
    }
    estimate_at(assembly, dynamics, assembly.with_contact(frequency)?)
}

fn frequency_of(assembly: &Assembly) -> Result<f64, SceneProblem> {
    let system = &assembly.system;
    let found = match &assembly.kinetics {
        None => actin_integrate::largest_frequency(system),
        Some(kinetics) => {
            let bound = system.in_state(kinetics.all_bound(system.state()));
            actin_integrate::largest_frequency(&bound)
        }
    };
    found.map_err(|error| no_step(&error))
}

fn no_step(error: &dyn std::error::Error) -> SceneProblem {
    SceneProblem::new("filament", error, "has no stable time step")
}

fn estimate_at(
    assembly: &Assembly,
    dynamics: &Dynamics,
    frequency: f64,
) -> Result<Estimate, SceneProblem> {
    let scheme = composition_of(dynamics);
    let limit =
        actin_integrate::stable_step(scheme, frequency, 1.0).map_err(|error| no_step(&error))?;
    let share = dynamics.step_safety * share_of_laws(assembly, dynamics);
    let wanted = dynamics.time_step_ns.unwrap_or(limit * share);
    if wanted > limit && !dynamics.allow_unstable_step {
        return Err(unstable(scheme, wanted, limit, frequency));
    }
    let steps = Steps::new(dynamics, wanted)?;
    check_records(assembly, dynamics, &steps)?;
    assembly.check_rates(steps.length_ns)?;
    Ok(Estimate {
        largest_frequency_rad_per_ns: frequency,
        stability_limit_ns: limit,
        time_step_ns: steps.length_ns,
        steps: steps.count,
        steps_between_records: steps.between_records,
        record_every_ns: steps.record_every_ns,
        force_evaluations: steps.count * scheme.force_evaluations_per_step() as u64,
        longest_sound_step: None,
    })
}

/// Drag rate (1/ns) above which drag dissipates the energy that steps across compression generate.
const DRAGGED: f64 = 0.1;

/// Viscosity (mPa s) with a transverse drag rate of about 1/ns at the density of monomers.
const THICK: f64 = 0.01;

/// Reduction of the default step by the laws of the rods.
///
/// `Homogenised` at zero temperature softens abruptly in compression. An undamped motion across
/// this kink gains energy at half the limit of other laws (all of it in 200 ns). At a quarter of
/// the limit, a rod of 160 nm gains 0.4 % in 600 ns. The law at 298 K needs no reduction. With drag
/// of at least `DRAGGED`, compressed rods and mixed filaments gain less than 1e-5 of the work at
/// nine tenths of the limit.
fn share_of_laws(assembly: &Assembly, dynamics: &Dynamics) -> f64 {
    let rates = dynamics.drag.rates();
    let slowest = rates.translational_per_ns.min(rates.rotational_per_ns);
    let is_heated = assembly.scene.thermal().is_some();
    let is_thick = |fluid: &Fluid| {
        let Fluid::Water(water) = fluid;
        water.viscosity_mpa_s >= THICK
    };
    let is_dragged = slowest >= DRAGGED || dynamics.drag.fluid().is_some_and(is_thick);
    if !is_heated && is_dragged {
        return 1.0;
    }
    let gives_way = |law: &RodLaw| match law {
        RodLaw::Homogenised => !is_heated,
        law => *law == RodLaw::HomogenisedAthermal,
    };
    let mut rods = assembly.scene.filaments().flat_map(Filament::rod_models);
    if rods.any(|rod| gives_way(&rod.law)) {
        0.5
    } else {
        1.0
    }
}

fn unstable(scheme: &Composition, wanted: f64, limit: f64, frequency: f64) -> SceneProblem {
    SceneProblem::new(
        "task.time_step_ns",
        format!("{wanted:?}"),
        format!(
            "above the stability limit of {limit:.4e} ns ({} at the largest frequency, \
             {frequency:.1} rad/ns): shorten the time step, or set allow_unstable_step: true",
            scheme.name()
        ),
    )
}

pub(super) fn check_records(
    assembly: &Assembly,
    dynamics: &Dynamics,
    steps: &Steps,
) -> Result<(), SceneProblem> {
    let records = number_of_records(steps.count, steps.between_records);
    let value = format!(
        "{:?}",
        dynamics.record_every_ns.unwrap_or(steps.record_every_ns)
    );
    let bytes = assembly.bytes + records * memory::of_kept_record(assembly);
    actin_assembly::memory::check(bytes, ("task.record_every_ns", value), || {
        let bodies = assembly.points.len() + assembly.frames.len();
        format!("{records:.2e} records of {bodies} bodies need")
    })
}

/// Number of records of a motion, including the first and the last.
fn number_of_records(steps: u64, between_records: u64) -> f64 {
    (steps / between_records + 1) as f64
}

/// Returns the same filaments with rods of constant rigidities, if rods resist shear only after
/// finite shear. Their frequency at rest is not representative of the motion.
fn with_constant_rods(assembly: &Assembly) -> Result<Option<Assembly>, SceneProblem> {
    let mut scene = assembly.scene.clone();
    let mut changes = false;
    for filament in scene.filaments_mut() {
        let is_soft = filament.rod_models().any(|rod| rod.law.has_soft_shear());
        changes |= is_soft;
        let sections = filament.sections.iter_mut();
        let of_sections = sections.filter_map(|s| s.altered_rod_mut()?.law.as_mut());
        let laws = of_sections.chain([&mut filament.rod.law]);
        for law in laws.filter(|law| law.has_soft_shear()) {
            *law = RodLaw::Constant;
        }
    }
    if !changes {
        return Ok(None);
    }
    Assembly::build(&scene).map(Some)
}

pub(super) fn run(
    assembly: &Assembly,
    dynamics: &Dynamics,
    estimate: &Estimate,
    saved: Option<SavedRun>,
    clock: Clock,
    sink: &mut dyn Sink,
) -> Result<(Outcome, Option<Failure>), SceneProblem> {
    let mut system = assembly.system.in_state(assembly.system.state().clone());
    let mut recorder = Recorder::new(assembly, dynamics, saved, clock, sink);
    let run = prepare((assembly, dynamics), &recorder, &mut system, estimate)?;
    // Loads have their initial factors.
    let begun = recorder.is_whole().then(|| system.total_energy());
    recorder.let_happen(&mut system);
    if let Some(energy_balance) = assembly.energy_balance {
        system.track_energy_balance(energy_balance);
    }
    let ending = match dynamics.drag.fluid() {
        None => recorder.execute(&run, &mut system),
        Some(fluid) => {
            let mut stepper = langevin(assembly, dynamics, fluid)?;
            recorder.execute_steps(&run, &mut stepper, &mut system)
        }
    };
    let ending = recorder.end(ending, &mut system);
    let wall_s = recorder.wall_s();
    let outcome = Outcome {
        force_evaluations: system.force_evaluations(),
        time_step_ns: Some(estimate.time_step_ns),
        largest_frequency_rad_per_ns: Some(estimate.largest_frequency_rad_per_ns),
        begun_with_pn_nm: begun,
        largest_kinetic_pn_nm: recorder.largest_kinetic_pn_nm,
        saddles_left: recorder.pushes.len(),
        events: recorder.events(),
        pushes: recorder.pushes,
        ..Outcome::new(Status::Failed, wall_s)
    }
    .with(recorder.taken.into_remarks());
    Ok(conclude(assembly, dynamics, ending, outcome))
}

pub(super) fn conclude(
    assembly: &Assembly,
    dynamics: &Dynamics,
    ending: Ending,
    outcome: Outcome,
) -> (Outcome, Option<Failure>) {
    let (mut outcome, failure) = ended(assembly, dynamics, ending, outcome);
    // Later events belong to no record.
    let steps = outcome.steps;
    outcome.events.retain(|event| event.step <= steps);
    (outcome, failure)
}

fn ended(
    assembly: &Assembly,
    dynamics: &Dynamics,
    ending: Ending,
    mut outcome: Outcome,
) -> (Outcome, Option<Failure>) {
    let failure = match ending {
        Ending::Interrupted(end) => {
            outcome.status = Status::Interrupted;
            outcome.steps = end.steps;
            outcome.force_evaluations = end.force_evaluations;
            None
        }
        Ending::Ended(end, at_rest) => {
            outcome.status = match end.reason {
                Reason::Converged => Status::Converged,
                _ => Status::Completed,
            };
            outcome.steps = end.steps;
            outcome.force_evaluations = end.force_evaluations;
            outcome.at_rest = at_rest;
            let certificate = at_rest.filter(is_saddle);
            let attempts = dynamics.leave_saddles;
            certificate.map(|c| Failure::Saddle(saddle(&c, attempts, way_off(dynamics))))
        }
        Ending::Slipped(lost, step) => {
            outcome.steps = step;
            let place = format!("at {:.4} ns, ", lost.at().value());
            Some(Failure::from_turn_loss(lost, place))
        }
        Ending::Failed(failure) => {
            outcome.steps = failure.last_good_step;
            let body = assembly.describe(failure.body);
            Some(Failure::Diverged { failure, body })
        }
    };
    (outcome, failure)
}

fn way_off(dynamics: &Dynamics) -> &'static str {
    match dynamics.leave_saddles {
        0 => {
            "with leave_saddles: 1 or more the motion is pushed off saddles and continues; an \
             imperfection of the filament, such as (amplitude_nm: 0.01, seed: 1), keeps it off them"
        }
        _ => "more pushes or a longer duration_ns may lead off it",
    }
}

fn prepare(
    (assembly, dynamics): (&Assembly, &Dynamics),
    recorder: &Recorder<'_>,
    system: &mut System,
    estimate: &Estimate,
) -> Result<Run, SceneProblem> {
    let limit = kinetic_limit(assembly, recorder.begun_with_pn_nm());
    let run = plan(dynamics, estimate)?
        .stopping_from(recorder.drive(system))
        .with_kinetic_limit(limit)
        .expect("the limit is positive");
    // The bound limits the total energy. In a bath strain has additional thermal energy.
    Ok(match dynamics.thermal {
        Some(_) => run,
        None => run.with_energy_limit(limit).expect("the limit is a number"),
    })
}

fn plan(dynamics: &Dynamics, estimate: &Estimate) -> Result<Run, SceneProblem> {
    let refused = |key: &str, error: &dyn std::error::Error| {
        SceneProblem::new(format!("task.{key}"), "", error.to_string())
    };
    let rates = dynamics.drag.rates();
    let drag = Drag::new(rates.translational_per_ns, rates.rotational_per_ns)
        .map_err(|error| refused("drag", &error))?;
    let step = estimate.time_step_ns;
    let scheme = composition_of(dynamics);
    let run = Run::new(scheme, step, estimate.steps)
        .and_then(|run| run.observing_every(estimate.steps_between_records))
        .map_err(|error| refused("time_step_ns", &error))?;
    // Steps in a fluid include their own noise.
    let bath = (dynamics.thermal.as_ref()).filter(|_| dynamics.drag.fluid().is_none());
    let run = match bath {
        None => run.with_drag(drag),
        Some(thermal) => Bath::new(drag, thermal.energy_pn_nm(), thermal.seed)
            .map(|bath| run.with_bath(bath))
            .map_err(|error| refused("thermal.temperature_k", &error))?,
    };
    let Some(StopTolerances {
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

fn langevin(
    assembly: &Assembly,
    dynamics: &Dynamics,
    fluid: &Fluid,
) -> Result<Langevin, SceneProblem> {
    let thermal = dynamics.thermal;
    let noise = thermal.map_or((0.0, 0), |t| (t.energy_pn_nm(), t.seed));
    let friction = assembly.friction(fluid)?;
    Langevin::new(&assembly.system, layout(assembly)?, friction, noise)
        .map_err(|error| SceneProblem::new("task", "", error.to_string()))
}

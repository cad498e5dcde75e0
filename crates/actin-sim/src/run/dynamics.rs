//! Motion in time: time step, run and end of the run.

use super::estimate::{Estimate, composition_of};
use super::recorder::Recorder;
use super::unknowns::layout;
use super::{Failure, Outcome};
use crate::scene::{
    Dynamics, Filament, Fluid, FreeTranslation, Load, Resultant, RodLaw, SceneProblem,
    StopTolerances,
};
use crate::{Assembly, memory};
use actin_assembly::problem_at;
use actin_brownian::Langevin;
use actin_integrate::{Bath, Composition, Drag, Run, Stepper};

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
    let estimate = Estimate::in_steps(dynamics, wanted)?;
    check_records(assembly, dynamics, &estimate)?;
    assembly.check_rates(estimate.time_step_ns)?;
    Ok(Estimate {
        largest_frequency_rad_per_ns: frequency,
        stability_limit_ns: limit,
        force_evaluations: estimate.steps * scheme.force_evaluations_per_step() as u64,
        ..estimate
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
    estimate: &Estimate,
) -> Result<(), SceneProblem> {
    let records = estimate.records() as f64;
    let every_ns = dynamics.record_every_ns.unwrap_or(estimate.record_every_ns);
    let key = ("task.record_every_ns", format!("{every_ns:?}"));
    memory::check_records(assembly, records, key, |bodies| {
        format!("{records:.2e} records of {bodies} bodies need")
    })
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
    recorder: Recorder<'_>,
) -> Result<(Outcome, Option<Failure>), SceneProblem> {
    let mut system = assembly.system.in_state(assembly.system.state().clone());
    let limit = kinetic_limit(assembly, recorder.begun_with_pn_nm());
    let run = plan(dynamics, estimate)?
        .stopping_from(recorder.drive(&mut system))
        .with_kinetic_limit(limit)
        .expect("the limit is positive");
    // The bound limits the total energy. In a bath strain has additional thermal energy.
    let run = match dynamics.thermal {
        Some(_) => run,
        None => run.with_energy_limit(limit).expect("the limit is a number"),
    };
    let fluid = dynamics.drag.fluid();
    let mut stepper = fluid
        .map(|fluid| langevin(assembly, dynamics, fluid))
        .transpose()?;
    let stepper = stepper.as_mut().map(|stepper| stepper as &mut dyn Stepper);
    let (outcome, failure) = recorder.run(estimate, (&run, stepper), system);
    let outcome = Outcome {
        largest_frequency_rad_per_ns: Some(estimate.largest_frequency_rad_per_ns),
        ..outcome
    };
    Ok((outcome, failure))
}

/// Safety factor for integrator errors near the stability limit and for nonconservative loads.
const ROOM: f64 = 2.0;

/// Absolute margin (pN nm) above round-off in filaments without loads, about 1e-20.
const LEAST: f64 = 1.0;

/// Margin above the mean thermal kinetic energy of a filament, in units of kT. The probability
/// falls by a factor e per unit.
const THERMAL_EXCESS: f64 = 50.0;

/// Upper bound of the kinetic energy (pN nm) of a motion with initial energy `begun_with` (pN nm);
/// infinite if unknown.
///
/// With constant controls, the energy is at most the initial energy plus the work of the loads. On
/// a clamped filament each load does at most the work `2 L |F|`, because no point moves by more
/// than twice the length. A heat bath adds `kT / 2` per degree of freedom and `THERMAL_EXCESS` kT
/// in total.
fn kinetic_limit(assembly: &Assembly, begun_with: f64) -> f64 {
    let scene = &assembly.scene;
    let is_fast = |filament: usize| {
        let mut clamps = assembly.clamps.iter();
        clamps.any(|clamp| clamp.filament == filament && clamp.slides == FreeTranslation::Nowhere)
    };
    let work_of = |load: &Load| match load.resultant(scene) {
        Resultant::Force(force) if stays(load) && is_fast(load.filament()) => {
            2.0 * (force.norm() * assembly.length_of(load.filament()))
        }
        _ => f64::INFINITY,
    };
    let work: f64 = scene.loads.iter().map(work_of).sum();
    // Linkers that form in a stretched state add energy.
    if !scene.path.is_empty() || work.is_infinite() || assembly.kinetics.is_some() {
        return f64::INFINITY;
    }
    let heat = assembly.scene.thermal_energy_pn_nm()
        * (0.5 * assembly.counts().dofs as f64 + THERMAL_EXCESS);
    let limit = ROOM * (begun_with + work + heat) + LEAST;
    if limit.is_nan() { f64::INFINITY } else { limit }
}

/// Returns `true` if a load is constant in time and space and keeps its resultant.
fn stays(load: &Load) -> bool {
    !load.follows() && load.factor().is_constant() && !matches!(load, Load::Acceleration(_))
}

fn plan(dynamics: &Dynamics, estimate: &Estimate) -> Result<Run, SceneProblem> {
    let rates = dynamics.drag.rates();
    let drag = Drag::new(rates.translational_per_ns, rates.rotational_per_ns)
        .map_err(problem_at("task.drag"))?;
    let step = estimate.time_step_ns;
    let scheme = composition_of(dynamics);
    let run = Run::new(scheme, step, estimate.steps)
        .and_then(|run| run.observing_every(estimate.steps_between_records))
        .map_err(problem_at("task.time_step_ns"))?;
    // Steps in a fluid include their own noise.
    let bath = (dynamics.thermal.as_ref()).filter(|_| dynamics.drag.fluid().is_none());
    let run = match bath {
        None => run.with_drag(drag),
        Some(thermal) => Bath::new(drag, thermal.energy_pn_nm(), thermal.seed)
            .map(|bath| run.with_bath(bath))
            .map_err(problem_at("task.thermal.temperature_k"))?,
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
        .map_err(problem_at("task.stop"))
}

fn langevin(
    assembly: &Assembly,
    dynamics: &Dynamics,
    fluid: &Fluid,
) -> Result<Langevin, SceneProblem> {
    let thermal = dynamics.thermal;
    let noise = thermal.map_or((0.0, 0), |t| (t.energy_pn_nm(), t.seed));
    let friction = assembly.friction(fluid)?;
    Langevin::new(&assembly.system, layout(assembly)?, friction, noise).map_err(problem_at("task"))
}

#[cfg(test)]
mod tests {
    use super::kinetic_limit;
    use crate::{Assembly, Scene};

    const FORCE: &str = "EndForce(end: End, force_pn: (3.0, 0.0, 4.0))";

    fn limit_of(clamps: &str, loads: &str) -> f64 {
        limit_in(clamps, loads, "duration_ns: 1.0")
    }

    fn limit_in(clamps: &str, loads: &str, task: &str) -> f64 {
        let text = format!(
            "Scene(
                filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 30.0)], rod: RodModel(law: Constant)),
                clamps: [{clamps}],
                loads: [{loads}],
                task: Dynamics({task}),
            )"
        );
        let scene = Scene::from_ron(&text).unwrap();
        let assembly = Assembly::build(&scene).unwrap();
        kinetic_limit(&assembly, assembly.system.total_energy())
    }

    /// Twice 60 nm times 5 pN, plus 1. Without a clamp the work is unbounded.
    #[test]
    fn the_work_of_the_loads_is_bounded_where_an_end_is_fast() {
        assert!((limit_of("Clamp(end: Start)", FORCE) - 601.0).abs() < 1e-9);
        assert!(limit_of("", FORCE).is_infinite());
        assert!((limit_of("", "") - 1.0).abs() < 1e-9);
    }

    /// 18 degrees of freedom (three nodes, three frames) at 300 K add 2 (9 + 50) kT.
    #[test]
    fn heat_counts() {
        let task = "duration_ns: 1.0, thermal: (temperature_k: 300.0, seed: 1), \
                    drag: (translational_per_ns: 1.0, rotational_per_ns: 1.0)";
        let heat =
            limit_in("Clamp(end: Start)", FORCE, task) - limit_of("Clamp(end: Start)", FORCE);
        assert!((heat - 118.0 * 300.0 * 0.013_806_49).abs() < 1e-9);
    }
}

//! Overdamped motion: friction, time step and run.

use super::dynamics::check_records;
use super::estimate::LongestStep;
use super::recorder::Recorder;
use super::step_check::StepCheck;
use super::unknowns::layout;
use super::{Estimate, Failure, Outcome, long_steps, spins};
use crate::Assembly;
use crate::scene::{Brownian as Task, Flow, Fluid, SceneProblem, Task as AnyTask, unit_vector};
use actin_assembly::problem_at;
use actin_brownian::{Brownian, Layout, Relaxation};
use actin_integrate::{POSITION_VERLET, Run};
use actin_mechanics::{System, Vector3};

/// Approximate iterations of a step with midpoints and with random stress.
const ITERATIONS: [u64; 2] = [4, 6];

/// Approximate iterations of a step without noise, over its three stages.
const ITERATIONS_WITHOUT_NOISE: u64 = 8;

/// Largest midpoint step over the fastest relaxation time. Longer steps overheat the strains.
const OF_FASTEST: f64 = 50.0;

/// Largest step of bonds with noise over the default step.
///
/// Of eight runs of 60 nm over 20 ns (four clamped, four free), none diverges at 1.4 times the
/// default step, one at 1.7, four at 2.0 and all at 2.6.
const OF_BONDS: f64 = 1.5;

/// Number of slow modes computed. Each free filament has up to six zero-stiffness modes.
const SLOWEST: usize = 24;

/// Largest number of degrees of freedom for relaxation times, at a cost of a few tenths of a
/// second.
const MOST_DOFS: usize = 5000;

/// Relative rate below which a mode has zero stiffness.
const UNRESISTED: f64 = 1e-12;

/// Relaxation times of small displacements from the state as built.
#[derive(Clone, Debug, PartialEq)]
pub struct RelaxationTimes {
    /// Shortest time (ns).
    pub fastest_ns: f64,
    /// Longest times (ns) in descending order; degenerate times are listed once.
    pub slowest_ns: Vec<f64>,
    /// Number of slow modes with zero or negative stiffness.
    pub unresisted: usize,
}

impl RelaxationTimes {
    fn new(relaxation: &mut Relaxation) -> Self {
        let highest = relaxation.highest_rate();
        let rates = relaxation.lowest_rates(SLOWEST);
        let (unresisted, resisted): (Vec<f64>, Vec<f64>) = rates
            .iter()
            .partition(|rate| **rate <= UNRESISTED * highest);
        let mut slowest_ns: Vec<f64> = resisted.iter().map(|rate| 1.0 / rate).collect();
        // Bending modes come in pairs.
        slowest_ns.dedup_by(|next, kept| *next > 0.99 * *kept);
        Self {
            fastest_ns: 1.0 / highest,
            slowest_ns,
            unresisted: unresisted.len(),
        }
    }
}

/// Relaxation times in the fluid of the task; `None` for tasks without a fluid.
pub(super) fn relaxation_times(
    assembly: &Assembly,
    task: &AnyTask,
) -> Option<Result<RelaxationTimes, SceneProblem>> {
    let fluid = match task {
        AnyTask::Brownian(task) => &task.drag,
        AnyTask::Dynamics(dynamics) => dynamics.drag.fluid()?,
        AnyTask::Equilibrium(_) => return None,
    };
    let dofs = assembly.counts().dofs;
    if dofs > MOST_DOFS {
        let rule = format!(
            "relaxation times are limited to {MOST_DOFS} degrees of freedom; this scene has {dofs}"
        );
        return Some(Err(SceneProblem::new("filament", "", rule)));
    }
    let relaxation = relaxation(assembly, fluid, |layout| layout);
    Some(relaxation.map(|mut relaxation| RelaxationTimes::new(&mut relaxation)))
}

fn relaxation(
    assembly: &Assembly,
    fluid: &Fluid,
    with_method: impl Fn(Layout) -> Layout,
) -> Result<Relaxation, SceneProblem> {
    let friction = assembly.friction(fluid)?;
    let layout = with_method(layout(assembly)?);
    Relaxation::new(&assembly.system, layout, &friction).map_err(problem_at("task"))
}

/// Highest rate of relaxation (1/ns), found without factors of the whole stiffness of linked filaments.
fn highest_rate(assembly: &Assembly, fluid: &Fluid) -> Result<f64, SceneProblem> {
    Ok(relaxation(assembly, fluid, Layout::with_conjugate_gradients)?.highest_rate())
}

pub(super) fn estimate(assembly: &Assembly, task: &Task) -> Result<Estimate, SceneProblem> {
    assembly.check_slip()?;
    let motion = task.to_dynamics();
    let of_midpoints = OF_FASTEST / highest_rate(assembly, &task.drag)?;
    let is_stiff = of_midpoints.is_finite() && of_midpoints > 0.0;
    if !is_stiff && task.time_step_ns.is_none() {
        let rule = "has no stiffness that could set a time step: write time_step_ns";
        return Err(SceneProblem::new("filament", "", rule));
    }
    let default = match long_steps::longest(assembly, task)? {
        None => of_midpoints,
        Some(ns) if motion.thermal.is_none() => ns,
        Some(ns) => ns.max(of_midpoints),
    };
    let wanted = task.time_step_ns.unwrap_or(default);
    let mut estimate = Estimate::in_steps(&motion, wanted.min(motion.duration_ns))?;
    task.flow.check_step(estimate.time_step_ns)?;
    check_records(assembly, &motion, &estimate)?;
    assembly.check_rates(estimate.time_step_ns)?;
    estimate.longest_sound_step = motion.thermal.map(|_| LongestStep {
        ns: default,
        of_midpoints_ns: of_midpoints,
        has_bonds: assembly.counts().bonds > 0,
    });
    check_length(wanted, estimate.longest_sound_step.as_ref())?;
    estimate.approach_nm = long_steps::approach_of_contacts(assembly, task, estimate.time_step_ns)?;
    let iterations = match motion.thermal {
        None => ITERATIONS_WITHOUT_NOISE,
        Some(_) => ITERATIONS[usize::from(estimate.has_random_stress())],
    };
    estimate.force_evaluations = estimate.steps * iterations;
    Ok(estimate)
}

/// Refuses time steps (ns) at which bonds with noise diverge.
fn check_length(wanted: f64, longest: Option<&LongestStep>) -> Result<(), SceneProblem> {
    match longest {
        Some(longest) if longest.has_bonds && wanted > OF_BONDS * longest.ns => {
            let rule = format!(
                "above {OF_BONDS} times the default step of {:.4e} ns, at which bonds of monomers diverge in thermal noise; leave \
                 it out, or take longer steps with interfaces: QuasiHarmonic()",
                longest.ns
            );
            let value = format!("{wanted:?}");
            Err(SceneProblem::new("task.time_step_ns", value, rule))
        }
        _ => Ok(()),
    }
}

impl Estimate {
    /// Creates the stepper of overdamped motion of the bodies of `assembly` with the interactions of
    /// `system`, or `None` for other tasks.
    ///
    /// # Errors
    /// If an interaction has no second derivatives.
    pub fn overdamped_stepper(
        &self,
        assembly: &Assembly,
        system: &System,
    ) -> Option<Result<Brownian, SceneProblem>> {
        let AnyTask::Brownian(task) = &assembly.scene.task else {
            return None;
        };
        let layout = layout(assembly).map(Layout::with_links);
        let stepper = layout.and_then(|l| self.stepper((assembly, task), system, l));
        Some(stepper.map(|stepper| stepper.in_flow(flow(assembly, task))))
    }

    /// Creates the stepper of overdamped motion for the free bodies of `layout` in a fluid at rest.
    ///
    /// # Errors
    /// If an interaction has no second derivatives.
    pub(crate) fn stepper(
        &self,
        (assembly, task): (&Assembly, &Task),
        system: &System,
        layout: Layout,
    ) -> Result<Brownian, SceneProblem> {
        let friction = assembly.friction(&task.drag)?;
        let noise = task.thermal();
        let noise = noise.map_or((0.0, 0), |t| (t.energy_pn_nm(), t.seed));
        let stepper = Brownian::new(system, layout, friction, noise).map_err(problem_at("task"))?;
        Ok(if self.has_random_stress() {
            let coupled = spins::are_coupled(assembly);
            stepper
                .with_spinning_frames(system, |frame| !coupled[assembly.filament_of_frame(frame)])
        } else {
            stepper.with_midpoint_steps()
        })
    }
}

/// Flow of the fluid, including the shear of a periodic box.
fn flow(assembly: &Assembly, task: &Task) -> actin_brownian::Flow {
    let driven = assembly.cell.map(|cell| {
        let gradient = Vector3::x() * Vector3::z().transpose() * cell.strain;
        (cell.factor, gradient)
    });
    actin_brownian::Flow {
        driven,
        ..physical_flow(&task.flow)
    }
}

/// The flow of a scene in nm and ns.
fn physical_flow(flow: &Flow) -> actin_brownian::Flow {
    const UM_PER_S: f64 = 1e-6;
    const PER_S: f64 = 1e-9;
    match *flow {
        Flow::AtRest => actin_brownian::Flow::default(),
        Flow::Stream { velocity_um_per_s } => {
            actin_brownian::Flow::stream(Vector3::from(velocity_um_per_s) * UM_PER_S)
        }
        Flow::Shear {
            rate_per_s,
            along,
            across,
        } => {
            let [along, across] = [along, across].map(unit_vector);
            actin_brownian::Flow::shear(rate_per_s * PER_S, along, across)
        }
    }
}

/// Runs the motion.
pub(super) fn run<'a>(
    assembly: &'a Assembly,
    task: &Task,
    estimate: &Estimate,
    mut recorder: Recorder<'a>,
) -> Result<(Outcome, Option<Failure>), SceneProblem> {
    let mut system = assembly.system.in_state(assembly.system.state().clone());
    // The order of unknowns follows the state as built, also for a resumed run.
    let new_stepper = |system: &System| {
        let stepper = estimate.stepper((assembly, task), system, layout(assembly)?)?;
        Ok::<_, SceneProblem>(stepper.in_flow(flow(assembly, task)))
    };
    let mut stepper = new_stepper(&system)?;
    let mut compared = system.in_state(system.state().clone());
    recorder.drive(&mut compared);
    let compared = (compared, new_stepper(&system)?);
    recorder.step_check = Some(StepCheck::new(assembly, estimate, compared));
    // The stepper makes the steps instead of this method.
    let run = Run::new(&POSITION_VERLET, estimate.time_step_ns, estimate.steps)
        .and_then(|run| run.observing_every(estimate.steps_between_records))
        // Long steps could let filaments pass through each other within a few steps.
        .and_then(|run| run.checking_every(1))
        .map_err(problem_at("task"))?
        .stopping_from(recorder.drive(&mut system));
    Ok(recorder.run(estimate, (&run, Some(&mut stepper)), system))
}

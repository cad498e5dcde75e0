//! Equilibria of a study's settings: what they look like and what they cost.

use super::observe::Observed;
use super::study::Study;
use crate::run::run_to_end;
use actin_sim::advice::FilamentSetting;
use actin_sim::cost::Evaluated;
use actin_sim::{Anchors, Assembly, Counts, Dynamics, Integrator, Plan, Scene, Task};
use rayon::prelude::*;

/// Two motions between which time is taken (ns), how long they are repeated (s) and how often: the least counts.
const TIMED_NS: [f64; 2] = [1.0, 11.0];
const TIMED_S: f64 = 0.3;
const TIMED: [usize; 2] = [2, 40];

/// An equilibrium that was found.
#[derive(Clone, Debug)]
pub(super) struct Solved {
    pub observed: Observed,
    /// Newton steps and evaluations, over all starts.
    pub newton_steps: u64,
    pub evaluations: u64,
    /// Time of Newton's method (s).
    pub wall_s: f64,
    /// Energies that are not positive beyond doubt.
    pub doubtful: usize,
    potential: f64,
}

/// What one setting evaluates and how far one evaluation brings a motion.
#[derive(Clone, Copy, Debug)]
pub(super) struct MotionCost {
    pub counts: Counts,
    pub work: Evaluated,
    /// Evaluations for a ns at the default step of the default integrator.
    pub evaluations_per_ns: f64,
    /// Bonds and elements evaluated in a ns.
    pub counted_per_ns: f64,
}

/// The scene of a study in one setting, at one of the azimuths of the lattice.
pub(super) fn scene(study: &Study, setting: &FilamentSetting, azimuth: u64) -> Scene {
    let mut scene = setting.apply(&study.scene);
    if study.turned {
        scene.filament.monomers.azimuth_deg = azimuth as f64 * 360.0 / study.azimuths as f64;
    }
    scene
}

/// A filament on its way to an equilibrium: that, or why there is none.
pub(super) type Attempt = Result<Solved, String>;

/// Equilibria of filaments with every monomer resolved that differ in the sampling of their bonds, and
/// in azimuth where the study turns them.
pub(super) fn drawn(study: &Study) -> Vec<Attempt> {
    let of_sampling = |seed| {
        lowest(study, &with_drawn_bonds(study, seed))
            .map_err(|e| format!("{}, seed {seed}: {e}", study.name))
    };
    (0..study.samplings)
        .into_par_iter()
        .map(of_sampling)
        .collect()
}

/// A filament with every monomer resolved and drawn bonds.
fn with_drawn_bonds(study: &Study, seed: u64) -> Scene {
    let setting = FilamentSetting {
        bonds: Anchors::Independent.usual_bonds(),
        ..study.settings[0].2.clone()
    };
    let mut turned = study.clone();
    turned.azimuths = study.samplings;
    let mut scene = scene(&turned, &setting, seed);
    scene.filament.monomers.anchors = Anchors::Independent;
    scene.filament.monomers.seed = seed;
    scene
}

/// Equilibria of every setting and azimuth, by setting.
pub(super) fn all(study: &Study) -> Vec<Vec<Attempt>> {
    let solve_one = |setting, azimuth| equilibrium(study, setting, azimuth);
    study
        .settings
        .par_iter()
        .map(|(_, _, setting)| {
            let azimuths = (0..study.azimuths).into_par_iter();
            azimuths
                .map(|azimuth| solve_one(setting, azimuth))
                .collect()
        })
        .collect()
}

/// The lowest equilibrium over the starts of the study.
pub(super) fn equilibrium(study: &Study, setting: &FilamentSetting, azimuth: u64) -> Attempt {
    let scene = scene(study, setting, azimuth);
    lowest(study, &scene).map_err(|e| format!("{}, azimuth {azimuth}: {e}", study.name))
}

/// The lowest equilibrium of a scene over the starts of the study.
fn lowest(study: &Study, scene: &Scene) -> Attempt {
    let mut lowest: Option<Solved> = None;
    let (mut steps, mut evaluations, mut wall_s) = (0, 0, 0.0);
    for &start in study.starts_deg {
        let found = from(study, scene, start)?;
        steps += found.newton_steps;
        evaluations += found.evaluations;
        wall_s += found.wall_s;
        if lowest
            .as_ref()
            .is_none_or(|low| found.potential < low.potential)
        {
            lowest = Some(found);
        }
    }
    lowest
        .map(|low| Solved {
            newton_steps: steps,
            evaluations,
            wall_s,
            ..low
        })
        .ok_or_else(|| "no start".to_owned())
}

/// The equilibrium from one start.
fn from(study: &Study, scene: &Scene, start_deg: f64) -> Result<Solved, String> {
    let mut assembly = Assembly::build(scene).map_err(|e| e.to_string())?;
    if start_deg != 0.0 {
        assembly.roll(start_deg.to_radians());
    }
    let (trajectory, report) = run_to_end(&mut assembly).map_err(|e| e.to_string())?;
    let last = trajectory.records.last().ok_or("no record")?;
    let found = report.equilibrium.ok_or("no certificate")?;
    Ok(Solved {
        potential: last.potential_pn_nm(),
        observed: Observed::of(study, &mut assembly),
        newton_steps: found.newton_iterations,
        evaluations: report.force_evaluations,
        wall_s: report.wall_s,
        doubtful: found.certificate.negative + found.certificate.unresolved,
    })
}

/// Time that a motion takes per ns (s), at the first azimuth; what a run does once is left out.
pub(super) fn motion_seconds_per_ns(
    study: &Study,
    setting: &FilamentSetting,
) -> Result<f64, String> {
    seconds_per_ns(scene(study, setting, 0))
}

/// The same of every monomer with drawn bonds.
pub(super) fn drawn_motion_seconds_per_ns(study: &Study) -> Result<f64, String> {
    seconds_per_ns(with_drawn_bonds(study, 0))
}

fn seconds_per_ns(mut scene: Scene) -> Result<f64, String> {
    scene.path.clear();
    let (mut least, mut spent, mut repeats) = ([f64::INFINITY; 2], 0.0, 0);
    while repeats < TIMED[0] || (repeats < TIMED[1] && spent < TIMED_S) {
        for (least, duration) in least.iter_mut().zip(TIMED_NS) {
            scene.task = Task::Dynamics(motion(duration, Integrator::default(), None));
            let mut assembly = Assembly::build(&scene).map_err(|e| e.to_string())?;
            let (_, report) = run_to_end(&mut assembly).map_err(|e| e.to_string())?;
            *least = least.min(report.wall_s);
            spent += report.wall_s;
        }
        repeats += 1;
    }
    Ok((least[1] - least[0]) / (TIMED_NS[1] - TIMED_NS[0]))
}

/// What a motion of the scene costs in one setting.
pub(super) fn motion_cost(study: &Study, setting: &FilamentSetting) -> Result<MotionCost, String> {
    let mut scene = scene(study, setting, 0);
    scene.path.clear();
    scene.task = Task::Dynamics(motion(1.0, Integrator::default(), None));
    let assembly = Assembly::build(&scene).map_err(|e| e.to_string())?;
    let plan = Plan::new(&assembly).map_err(|e| e.to_string())?;
    let estimate = plan.estimate().ok_or("a motion has an estimate")?;
    let cost = plan.cost();
    let duration = estimate.steps as f64 * estimate.time_step_ns;
    Ok(MotionCost {
        counts: assembly.counts(),
        work: cost.work,
        evaluations_per_ns: cost.evaluations as f64 / duration,
        counted_per_ns: (cost.bond_evaluations() + cost.element_evaluations()) / duration,
    })
}

/// A motion without drag, recorded at its end alone.
pub(super) fn motion(
    duration_ns: f64,
    integrator: Integrator,
    time_step_ns: Option<f64>,
) -> Dynamics {
    Dynamics {
        duration_ns,
        integrator,
        time_step_ns,
        step_safety: 0.5,
        allow_unstable_step: false,
        drag: actin_sim::DragModel::default(),
        thermal: None,
        stop: None,
        leave_saddles: 0,
        record_every_ns: Some(duration_ns),
    }
}

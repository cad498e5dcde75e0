//! Equilibria of a study's settings: what they look like and what they cost.

use super::observe::Observed;
use super::study::Study;
use actin_sim::advice::Setting;
use actin_sim::cost::{Cost, Work};
use actin_sim::{Assembly, Counts, Dynamics, Integrator, Scene, Task};
use rayon::prelude::*;
use std::ops::ControlFlow;

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
    pub work: Work,
    /// Evaluations for a ns at the default step of the default integrator.
    pub evaluations_per_ns: f64,
    /// Estimated seconds for a ns.
    pub seconds_per_ns: f64,
}

/// The scene of a study in one setting, with a sampling of the bonds.
pub(super) fn scene(study: &Study, setting: &Setting, seed: u64) -> Scene {
    let mut scene = setting.apply(&study.scene);
    scene.filament.monomers.seed = seed;
    scene
}

/// Equilibria of every setting and sampling, by setting.
pub(super) fn all(study: &Study) -> Result<Vec<Vec<Solved>>, String> {
    let settings = study.settings.len();
    let jobs: Vec<(usize, u64)> = (0..settings)
        .flat_map(|i| (0..study.seeds).map(move |seed| (i, seed)))
        .collect();
    let solved: Result<Vec<Solved>, String> = jobs
        .par_iter()
        .map(|&(i, seed)| equilibrium(study, &study.settings[i].2, seed))
        .collect();
    let solved = solved?;
    let seeds = usize::try_from(study.seeds).map_err(|e| e.to_string())?;
    Ok(solved.chunks(seeds).map(<[Solved]>::to_vec).collect())
}

/// The lowest equilibrium over the starts of the study.
pub(super) fn equilibrium(study: &Study, setting: &Setting, seed: u64) -> Result<Solved, String> {
    let scene = scene(study, setting, seed);
    let mut lowest: Option<Solved> = None;
    let (mut steps, mut evaluations, mut wall_s) = (0, 0, 0.0);
    for &start in study.starts_deg {
        let found = from(study, &scene, start)
            .map_err(|e| format!("{}, {setting:?}, seed {seed}: {e}", study.name))?;
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
        .ok_or_else(|| format!("{}: no start", study.name))
}

/// The equilibrium from one start.
fn from(study: &Study, scene: &Scene, start_deg: f64) -> Result<Solved, String> {
    let mut assembly = Assembly::build(scene).map_err(|e| e.to_string())?;
    if start_deg != 0.0 {
        assembly.roll(start_deg.to_radians());
    }
    let watch = &mut |_| ControlFlow::Continue(());
    let (trajectory, report) = actin_sim::run(&mut assembly, watch).map_err(|e| e.to_string())?;
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

/// What a motion of the scene costs in one setting.
pub(super) fn motion_cost(study: &Study, setting: &Setting) -> Result<MotionCost, String> {
    let mut scene = scene(study, setting, 0);
    scene.path.clear();
    scene.task = Task::Dynamics(motion(1.0, Integrator::default(), None));
    let assembly = Assembly::build(&scene).map_err(|e| e.to_string())?;
    let estimate = actin_sim::estimate(&assembly)
        .map_err(|e| e.to_string())?
        .ok_or("a motion has an estimate")?;
    let cost = Cost::of(&assembly, Some(&estimate));
    let duration = estimate.steps as f64 * estimate.time_step_ns;
    Ok(MotionCost {
        counts: assembly.counts(),
        work: cost.work,
        evaluations_per_ns: cost.evaluations as f64 / duration,
        seconds_per_ns: cost.seconds / duration,
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
        drag: actin_sim::Drag::default(),
        stop: None,
        record_every_ns: Some(duration_ns),
    }
}

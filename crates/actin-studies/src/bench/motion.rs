//! Rates of time steps.

use super::cases::{Filament, Motion};
use super::{Timings, median};
use actin_integrate::Run;
use actin_sim::{Assembly, Integrator, Plan, Scene, Task};
use std::time::Instant;

/// Element-steps of a batch, about 3 ms, so that some batches are not interrupted by other processes.
const BATCH: usize = 200_000;
/// Bonds of a batch; bonds are several times faster than segments.
const BOND_BATCH: usize = 1_200_000;
/// Smallest number of steps of a batch, so that the overhead at its end is negligible.
const FEWEST_STEPS: u64 = 150;
/// Time of a case (s).
const SECONDS: f64 = 4.0;
/// Rise of a monomer (nm).
const RISE_NM: f64 = 71.2 / 26.0;

pub(super) fn measure(motion: &Motion) -> Result<Timings, String> {
    let mut all = assemble(motion)?;
    let elements = elements(&all);
    let batch = match motion.filament {
        Filament::Rod { .. } => BATCH,
        Filament::Monomers { .. } | Filament::Mixed => BOND_BATCH,
    };
    let steps = ((batch / elements) as u64).max(FEWEST_STEPS);
    let runs: Vec<Run> = all
        .iter()
        .map(|assembly| plan(assembly, steps))
        .collect::<Result<_, _>>()?;
    let mut rates = Vec::new();
    let mut first_step = 0;
    let all_started = Instant::now();
    while all_started.elapsed().as_secs_f64() < SECONDS {
        first_step += steps;
        let started = Instant::now();
        for (assembly, run) in all.iter_mut().zip(&runs) {
            // Continues one run, since the first steps of a run are checked more often.
            run.continuing_from(first_step)
                .execute(&mut assembly.system, &mut [])
                .map_err(|failure| failure.to_string())?;
        }
        let work = elements as f64 * steps as f64;
        rates.push(work / started.elapsed().as_secs_f64());
    }
    Ok(Timings {
        best: rates.iter().copied().fold(0.0, f64::max),
        median: median(rates),
        note: format!("{steps} steps of {:.2e} ns a batch", runs[0].step()),
    })
}

pub(super) fn assemble(motion: &Motion) -> Result<Vec<Assembly>, String> {
    let scene = Scene::from_ron(&scene(motion)).map_err(|error| error.to_string())?;
    let build = |_| Assembly::build(&scene).map_err(|error| error.to_string());
    (0..motion.copies).map(build).collect()
}

pub(super) fn elements(all: &[Assembly]) -> usize {
    let of = |assembly: &Assembly| {
        let counts = assembly.counts();
        counts.segments + counts.bonds
    };
    all.iter().map(of).sum()
}

fn plan(assembly: &Assembly, steps: u64) -> Result<Run, String> {
    let plan = Plan::new(assembly).map_err(|error| error.to_string())?;
    let estimate = plan.estimate().ok_or("a motion has time steps")?;
    let scheme = actin_sim::composition(integrator(assembly)?);
    let run = Run::new(scheme, estimate.time_step_ns, steps);
    run.and_then(|run| run.observing_every(steps))
        .map_err(|error| error.to_string())
}

fn integrator(assembly: &Assembly) -> Result<Integrator, String> {
    match &assembly.scene.task {
        Task::Dynamics(dynamics) => Ok(dynamics.integrator),
        Task::Equilibrium(_) | Task::Brownian(_) => Err("the task has no integrator".to_owned()),
    }
}

fn scene(motion: &Motion) -> String {
    let mut force_pn = 2.0;
    let filament = match motion.filament {
        Filament::Rod { segments, law } => format!(
            "sections: [Rod(from_nm: 0.0, to_nm: 160.0, segments: {segments})],
             rod: RodModel(law: {law})"
        ),
        Filament::Monomers { count } => {
            // Two monomers are clamped, the inner one at arc length 0. The tip is the midpoint of the last two
            // monomers.
            let length = (count as f64 - 2.5) * RISE_NM;
            format!(
                "sections: [Ellipsoids(from_nm: 0.0, to_nm: {length:?})],
                 monomers: (anchors: Independent, lateral_bonds: 10, longitudinal_bonds: 10)"
            )
        }
        Filament::Mixed => {
            // The same tip angle for a filament ten times as long.
            force_pn = 0.02;
            "sections: [
                 Ellipsoids(from_nm: 0.0, to_nm: 40.0),
                 Rod(from_nm: 40.0, to_nm: 1600.0, segments: 78),
             ],
             rod: RodModel(law: Fitted)"
                .to_owned()
        }
    };
    let integrator = motion.integrator;
    format!(
        "Scene(
            filament: Filament({filament}),
            clamps: [Clamp(end: Start)],
            loads: [EndForce(end: End, force_pn: (-{force_pn:?}, 0.0, 0.0))],
            task: Dynamics(duration_ns: 1.0, integrator: {integrator}),
        )"
    )
}

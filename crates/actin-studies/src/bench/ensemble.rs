//! Speed-up of replicas on two threads over one.

use super::cases::Replicated;
use super::{Timings, median};
use actin_sim::{Ensemble, Scene, SimError};
use std::num::NonZeroUsize;
use std::time::Instant;

/// Number of replicas, sufficient to balance the threads within a few per cent.
const REPLICAS: usize = 48;
const THREADS: NonZeroUsize = NonZeroUsize::new(2).unwrap();
/// Time of a case (s), and smallest number of pairs of runs.
const SECONDS: f64 = 12.0;
const PAIRS: usize = 5;

/// Measures the ratio of run times on one and on two threads. Runs alternate, so that other load on the machine
/// affects both. The best value is the ratio of the shortest times, the median is taken over pairs.
pub(super) fn measure(of: Replicated) -> Result<Timings, String> {
    let load = load();
    let (mut least, mut ratios) = ([f64::INFINITY; 2], Vec::new());
    let started = Instant::now();
    while ratios.len() < PAIRS || started.elapsed().as_secs_f64() < SECONDS {
        let one = seconds(of, REPLICAS, NonZeroUsize::MIN).map_err(|e| e.to_string())?;
        let two = seconds(of, REPLICAS, THREADS).map_err(|e| e.to_string())?;
        least = [least[0].min(one), least[1].min(two)];
        ratios.push(one / two);
    }
    let pairs = ratios.len();
    Ok(Timings {
        best: least[0] / least[1],
        median: median(ratios),
        note: format!(
            "{REPLICAS} replicas, {:.3} s on one, {:.3} s on two; {pairs} pairs; load {load} before",
            least[0], least[1]
        ),
    })
}

/// Returns the run time (s) of a number of replicas, including assembly.
pub(super) fn seconds(
    of: Replicated,
    replicas: usize,
    threads: NonZeroUsize,
) -> Result<f64, SimError> {
    let scene = Scene::from_ron(&scene(of))?;
    let ensemble = Ensemble::new(&scene, replicas)?.on_threads(threads);
    let started = Instant::now();
    ensemble.run(|replica| replica.outcome.steps)?;
    Ok(started.elapsed().as_secs_f64())
}

/// Returns the load average of the last minute, or "unknown".
fn load() -> String {
    let text = std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
    text.split(' ').next().unwrap_or("unknown").to_owned()
}

fn scene(of: Replicated) -> String {
    let sections = match of {
        Replicated::Rod => "Rod(from_nm: 0.0, to_nm: 160.0, segments: 64)",
        Replicated::Monomers | Replicated::Equilibria => "Ellipsoids(from_nm: 0.0, to_nm: 160.0)",
        Replicated::Mixed => {
            "Ellipsoids(from_nm: 0.0, to_nm: 40.0), Rod(from_nm: 40.0, to_nm: 160.0, segments: 12)"
        }
    };
    let (anchors, task) = match of {
        Replicated::Equilibria => ("Independent", "Equilibrium()"),
        _ => (
            "Cubature",
            "Dynamics(
                duration_ns: 0.5,
                record_every_ns: 0.1,
                drag: (translational_per_ns: 5.0, rotational_per_ns: 5.0),
                thermal: Thermal(temperature_k: 298.0, seed: 1),
            )",
        ),
    };
    format!(
        "Scene(
            filament: Filament(sections: [{sections}], monomers: Monomers(anchors: {anchors}), rod: RodModel(law: Constant)),
            clamps: [Clamp(end: Start)],
            loads: [EndForce(end: End, force_pn: (-2.0, 0.0, 0.0))],
            task: {task},
        )"
    )
}

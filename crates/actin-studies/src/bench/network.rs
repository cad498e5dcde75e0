//! Linked filaments in water: seconds per simulated millisecond, and thermal energies.

use super::cases::{Couplings, Network};
use super::{Timings, median};
use actin_sim::{Assembly, Plan, Scene, SimError};
use std::collections::BTreeMap;
use std::time::Instant;

/// Numbers of steps; the difference of their times excludes the set-up.
const STEPS: [u32; 2] = [5, 25];
const REPEATS: usize = 3;
/// Edge of the box of 500 filaments (nm). Smaller networks have the same density.
const EDGE_NM: f64 = 2000.0;

/// Measures the time on one core per simulated time. The note lists the energy of each term per filament.
pub(super) fn measure(network: Network) -> Result<Timings, String> {
    let mut times = Vec::new();
    let mut note = String::new();
    for _ in 0..REPEATS {
        let [short, long] = STEPS.map(|steps| run(network, steps));
        let (short, _) = short.map_err(|error| error.to_string())?;
        let (long, energies) = long.map_err(|error| error.to_string())?;
        let simulated_ms = 1e-6 * network.step_ns * f64::from(STEPS[1] - STEPS[0]);
        times.push((long - short) / simulated_ms);
        note = energies
            .iter()
            .map(|(term, energy)| format!("{term} {energy:.3} kT"))
            .collect::<Vec<_>>()
            .join(", ");
    }
    Ok(Timings {
        best: times.iter().copied().fold(f64::INFINITY, f64::min),
        median: median(times),
        note: format!("per filament at the end: {note}"),
    })
}

/// Time (s) of a run without its assembly, and the mean energies per filament (kT) at the end.
pub(super) fn run(
    network: Network,
    steps: u32,
) -> Result<(f64, BTreeMap<&'static str, f64>), SimError> {
    let scene = Scene::from_ron(&scene(network, steps))?;
    let assembly = Assembly::build(&scene)?;
    let plan = Plan::new(&assembly)?;
    let started = Instant::now();
    let (trajectory, _) = plan.run()?;
    let seconds = started.elapsed().as_secs_f64();
    let scale = network.filaments as f64 * scene.thermal_energy_pn_nm();
    let mut energies = BTreeMap::new();
    if let Some(last) = trajectory.records.last() {
        let interactions = assembly.system.interactions().iter();
        for (interaction, energy) in interactions.zip(&last.energies_pn_nm) {
            *energies.entry(interaction.term()).or_insert(0.0) += energy / scale;
        }
    }
    Ok((seconds, energies))
}

fn scene(network: Network, steps: u32) -> String {
    let Network {
        filaments,
        law,
        step_ns: step,
        ..
    } = network;
    let edge = EDGE_NM * (filaments as f64 / 500.0).cbrt();
    let linkers = "linker_sets: [LinkersBetween(per_filament: 2.5, reach_nm: 100.0, stiffness_pn_per_nm: 0.2, seed: 2)],";
    let couplings = match network.couplings {
        Couplings::Linkers => linkers.to_owned(),
        Couplings::LinkersAndContacts => format!("{linkers} repulsion: Repulsion(),"),
        Couplings::Crosslinkers => format!(
            "crosslinkers: [Crosslinkers(count: {}, stiffness_pn_per_nm: 0.2, rest_length_nm: 20.0,
                attach_per_ns: 1e-5, bind_per_ns: 5e-6, unbinds: Breaking(rate_per_ns: 1e-8, force_pn: 5.0), seed: 3)],",
            5 * filaments / 2
        ),
    };
    format!(
        "Scene(
            arrangements: [Random(
                filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 1000.0, segments: 10)], rod: (law: {law})),
                count: {filaments}, box_nm: ({edge:?}, {edge:?}, {edge:?}), apart_nm: 7.4, seed: 1,
            )],
            {couplings}
            task: Brownian(duration_ms: {:?}, temperature_k: 298.0, time_step_ns: {step:?},
                record_every_ns: {:?}, seed: 7),
        )",
        1e-6 * step * f64::from(steps),
        step * f64::from(steps)
    )
}

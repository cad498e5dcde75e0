//! Networks on several threads.

use actin_sim::{Assembly, Plan, Scene};

/// Enough unknowns for several tasks of loads, matrices and factors.
const NETWORK: &str = "Scene(
    arrangements: [Random(
        filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 1000.0, segments: 10)]),
        count: 100, box_nm: (855.0, 855.0, 855.0), seed: 1,
    )],
    linker_sets: [
        LinkersBetween(per_filament: 2.5, reach_nm: 100.0, stiffness_pn_per_nm: 0.2, seed: 2),
    ],
    task: Brownian(
        duration_ms: 0.02, temperature_k: 298.0, time_step_ns: 5000.0, record_every_ns: 5000.0, seed: 3,
    ),
)";

#[test]
fn networks_have_the_same_bits_for_any_number_of_threads() {
    let assembly = Assembly::build(&Scene::from_ron(NETWORK).unwrap()).unwrap();
    let plan = Plan::new(&assembly).unwrap();
    let runs = [1, 2, 3].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let run = pool.build().unwrap().install(|| plan.run().unwrap());
        run.0.records
    });
    assert_eq!(runs[0].len(), 5);
    for other in &runs[1..] {
        for (one, other) in runs[0].iter().zip(other) {
            assert_eq!(one.state, other.state);
        }
    }
}

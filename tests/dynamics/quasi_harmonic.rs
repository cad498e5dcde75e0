//! Quasi-harmonic interfaces against bonds, and in mixed filaments.

use super::filaments::KBT;
use actin_sim::ellipsoid::{Fluctuations, Monomers};
use actin_sim::{Assembly, Plan, Scene, Solution, Solve};

fn scene(sections: &str, task: &str) -> Scene {
    let text = format!(
        "Scene(
            filament: Filament(sections: [{sections}], rod: (law: Constant)),
            task: {task},
        )"
    );
    Scene::from_ron(&text).unwrap()
}

fn quasi_harmonic(duration_ms: f64, step_ns: f64) -> String {
    format!(
        "Brownian(duration_ms: {duration_ms:?}, temperature_k: 298.0, seed: 1, time_step_ns: {step_ns:?},
            record_every_ns: {step_ns:?}, interfaces: QuasiHarmonic())"
    )
}

fn fluctuations(scene: &Scene) -> Fluctuations {
    let assembly = Assembly::build(scene).unwrap();
    let monomers = Monomers {
        first_point: 0,
        first_frame: 0,
        first_index: 0,
        count: assembly.counts().monomers,
    };
    let (trajectory, _) = Plan::new(&assembly).unwrap().run().unwrap();
    let mut found = Fluctuations::new(&monomers, &assembly.rest);
    let warm = trajectory.records.len() / 50;
    let records = trajectory.records.iter().skip(warm);
    records.for_each(|record| found.add(&record.state));
    found
}

/// Overdamped steps of 20 ns and inertial motion with bonds give the same strains. The variances
/// have errors of 2.2 % (4000 independent states) and 1.7 % (400 ns with bonds).
#[test]
fn strains_agree_with_bonds() {
    let section = "Ellipsoids(from_nm: 0.0, to_nm: 32.9)";
    let bonds =
        "Dynamics(duration_ns: 400.0, drag: (translational_per_ns: 5.0, rotational_per_ns: 5.0),
        thermal: Thermal(temperature_k: 298.0, seed: 7), record_every_ns: 0.05)";
    let long_steps = fluctuations(&scene(section, &quasi_harmonic(0.08, 20.0)));
    let chain = long_steps.chain(KBT).unwrap();
    let distance = fluctuations(&scene(section, bonds)).distance_from(&chain, KBT);
    assert!(distance < 0.05, "{distance}");
}

/// Mean energy of interfaces over 3 kT each, and of all bodies over kT/2 per degree of freedom
/// without rigid motions: two rods of 80 nm with monomers between them.
fn warmth(attached: usize) -> [f64; 2] {
    let sections =
        "Rod(from_nm: 0.0, to_nm: 80.0, segments: 2), Ellipsoids(from_nm: 80.0, to_nm: 120.0),
        Rod(from_nm: 120.0, to_nm: 200.0, segments: 2)";
    let mut scene = scene(sections, &quasi_harmonic(0.3, 100.0));
    scene.filament.junction.attached_monomers = attached;
    let Solution {
        assembly,
        trajectory,
        ..
    } = scene.solve().unwrap();
    let records = &trajectory.records[trajectory.records.len() / 50..];
    let mut sums = [0.0; 2];
    for record in records {
        for (term, energy) in assembly.terms.iter().zip(&record.energies_pn_nm) {
            sums[0] += if term.name == "bonds" { *energy } else { 0.0 };
            sums[1] += energy;
        }
    }
    let counts = assembly.counts();
    let (interfaces, dofs) = (counts.monomers - 1, counts.dofs - 6);
    let per = [3.0 * interfaces as f64, 0.5 * dofs as f64].map(|n| n * KBT * records.len() as f64);
    [sums[0] / per[0], sums[1] / per[1]]
}

/// Every strain of an open filament has kT/2. Two monomers attached to one rod form a loop with
/// dependent strains.
#[test]
fn energy_agrees_with_the_temperature() {
    let (open, loops) = (warmth(1), warmth(2));
    for warmth in [open[0], open[1], loops[1]] {
        assert!((warmth - 1.0).abs() < 0.02, "{open:?}, {loops:?}");
    }
}

fn stretched(sections: &str) -> f64 {
    let assembly = Assembly::build(&scene(sections, &quasi_harmonic(1e-3, 100.0))).unwrap();
    let mut state = assembly.rest.clone();
    for i in 0..state.points.len() {
        let x = state.points.position.get(i);
        state.points.position.set(i, x * 1.001);
    }
    let interactions = assembly.system.interactions();
    interactions.iter().map(|i| i.energy(&state)).sum()
}

#[test]
fn neighbouring_sections_are_one_chain() {
    let one = stretched("Ellipsoids(from_nm: 0.0, to_nm: 41.0)");
    let two = stretched(
        "Ellipsoids(from_nm: 0.0, to_nm: 20.0),
         Ellipsoids(from_nm: 20.0, to_nm: 41.0, altered: Altered(mass_factor: 1.000001))",
    );
    // Sampling error of the stiffness over 400 ns.
    assert!((two / one - 1.0).abs() < 0.02, "{one}, {two}");
}

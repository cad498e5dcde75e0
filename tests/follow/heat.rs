//! A thousand switches in a heat bath.

use super::{KT, Recorded, mean_square_angle, records, scene, to_and_fro};
use actin_sim::Scene;
use actin_sim::follow::AdaptiveMotion;

fn thermal(duration_ns: f64) -> Scene {
    let rest = format!(
        "task: Dynamics(
            duration_ns: {duration_ns:?},
            time_step_ns: 0.0025,
            record_every_ns: 0.25,
            drag: (translational_per_ns: 5.0, rotational_per_ns: 5.0),
            thermal: (temperature_k: 298.0, seed: 7),
        ),"
    );
    scene(108.0, 0.25, &rest)
}

/// Records after the first 10 ns.
fn warm(run: &AdaptiveMotion) -> impl Iterator<Item = Recorded<'_>> {
    records(run).filter(|(_, record)| record.at.value() >= 10.0)
}

/// Mean temperature over the bath temperature, weighted by degrees of freedom.
fn temperature(run: &AdaptiveMotion) -> f64 {
    let (mut found, mut expected) = (0.0, 0.0);
    for (assembly, record) in warm(run) {
        found += record.kinetic_pn_nm;
        expected += 0.5 * assembly.counts().dofs as f64 * KT;
    }
    found / expected
}

#[test]
fn a_thousand_switches_neither_heat_nor_cool() {
    let run = to_and_fro(&thermal(501.0), 0.5);
    let switches: Vec<_> = run.switches().collect();
    assert!(switches.len() >= 1000);
    let temperature = temperature(&run);
    let booked: f64 = switches.iter().map(|s| s.energy_pn_nm).sum();
    let sizes: f64 = switches.iter().map(|s| s.energy_pn_nm.abs()).sum();
    let momentum = switches.iter().map(|s| s.momentum_change);
    let momentum: f64 = momentum.fold(0.0, f64::max);
    let angle = mean_square_angle(warm(&run));
    let length = run.stretches[0].stretch.assembly.length_nm();
    // Two directions of bending, persistence length of 11 um.
    let expected = 2.0 * length / 11_000.0;
    println!(
        "{} switches: temperature {temperature:.4}, booked {booked:.0} of {sizes:.0} pN nm, momentum {momentum:.1e}, \
         angle {angle:.4} of {expected:.4} rad^2",
        switches.len()
    );
    // 2000 records of 165 degrees of freedom with a correlation of 0.1 ns: 0.25 % twice over.
    assert!((temperature - 1.0).abs() < 0.01);
    assert!(booked.abs() < 0.1 * sizes);
    assert!(momentum < 1e-12);
    // About 400 independent shapes: 5 %, and 5 % from the ends.
    assert!((angle / expected - 1.0).abs() < 0.2);
}

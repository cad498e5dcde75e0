//! A thousand switches in a heat bath.

use super::{scene, to_and_fro};
use actin_sim::Scene;
use actin_sim::follow::AdaptiveMotion;
use actin_sim::shape::Ribbon;

const KT: f64 = 0.013_806_49 * 298.0;

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

/// Mean temperature over the bath temperature, weighted by degrees of freedom, after `from_ns`.
fn temperature(run: &AdaptiveMotion, from_ns: f64) -> f64 {
    let (mut found, mut expected) = (0.0, 0.0);
    for ran in &run.stretches {
        let dofs = ran.stretch.assembly.counts().dofs as f64;
        for record in &ran.trajectory.records {
            if record.at.value() >= from_ns {
                found += record.kinetic_pn_nm;
                expected += 0.5 * dofs * KT;
            }
        }
    }
    found / expected
}

/// Mean squared angle between the tangents at the ends (rad^2) after `from_ns`.
fn mean_square_angle(run: &AdaptiveMotion, from_ns: f64) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for ran in &run.stretches {
        let records = ran.trajectory.records.iter();
        for record in records.filter(|r| r.at.value() >= from_ns) {
            let tangents = Ribbon::new(&ran.stretch.assembly, &record.state).tangents();
            let angle = tangents[0].angle(&tangents[tangents.len() - 1]);
            sum += angle * angle;
            count += 1.0;
        }
    }
    sum / count
}

#[test]
fn a_thousand_switches_neither_heat_nor_cool() {
    let run = to_and_fro(&thermal(501.0), 0.5);
    let switches: Vec<_> = run.switches().collect();
    assert!(switches.len() >= 1000);
    let temperature = temperature(&run, 10.0);
    let booked: f64 = switches.iter().map(|s| s.energy_pn_nm).sum();
    let sizes: f64 = switches.iter().map(|s| s.energy_pn_nm.abs()).sum();
    let momentum = switches.iter().map(|s| s.momentum_change);
    let momentum: f64 = momentum.fold(0.0, f64::max);
    let angle = mean_square_angle(&run, 10.0);
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

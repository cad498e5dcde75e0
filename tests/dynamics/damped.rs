//! Damped motion of filaments from zero drag to drag far beyond the resolution of a step.

use super::modes::Modes;
use crate::common::ran;
use actin_mechanics::{State, Vector3, rotation};
use actin_sim::End;

const RATES: [f64; 6] = [0.0, 1.0, 10.0, 100.0, 1e3, 1e4];

fn drag(translational: f64, rotational: f64) -> String {
    format!("drag: (translational_per_ns: {translational:?}, rotational_per_ns: {rotational:?}),")
}

/// Displacement of an oscillator of frequency `omega` at time `t` under a unit load from time 0:
/// `(1 - s(t))/omega^2`, with `s` the free motion from 1 at rest.
fn displaced(gamma: f64, omega: f64, t: f64) -> f64 {
    let half = 0.5 * gamma;
    let gap = half * half - omega * omega;
    let free = if gap > 0.0 {
        let root = gap.sqrt();
        let (fast, slow) = (half + root, omega * omega / (half + root));
        (fast * (-slow * t).exp() - slow * (-fast * t).exp()) / (2.0 * root)
    } else {
        let root = (-gap).sqrt();
        (-half * t).exp() * ((root * t).cos() + half * (root * t).sin() / root)
    };
    (1.0 - free) / (omega * omega)
}

/// A cantilever under a small force follows the sum of its modes at any drag.
#[test]
fn a_cantilever_creeps_as_its_modes_do() {
    let (segments, force) = (4, 1e-3);
    for integrator in ["Pefrl", "PositionVerlet"] {
        for rate in RATES {
            let (assembly, trajectory, _) = ran(&format!(
                "Scene(
                    filament: Filament(sections: [
                        Rod(from_nm: 0.0, to_nm: 40.0, segments: {segments}),
                    ], rod: RodModel(law: Constant)),
                    clamps: [Clamp(end: Start)],
                    loads: [EndForce(end: End, force_pn: ({force:?}, 0.0, 0.0))],
                    task: Dynamics(
                        duration_ns: 5.0, record_every_ns: 0.5, integrator: {integrator}, {}
                    ),
                )",
                drag(rate, rate)
            ));
            let mut start = assembly.system;
            *start.state_mut() = assembly.rest.clone();
            let modes = Modes::new(&start);
            let tip = 3 * (assembly.points.len() - 1);
            let x = |state: &State| state.points.position.get(segments).x;
            let rest = modes.response(tip, (tip, force), |omega| 1.0 / (omega * omega));
            let mut largest: f64 = 0.0;
            for record in &trajectory.records[1..] {
                let answer = |omega| displaced(rate, omega, record.at.value());
                let expected = modes.response(tip, (tip, force), answer);
                let error = (x(&record.state) - expected) / expected.abs().max(1e-3 * rest);
                largest = largest.max(error.abs());
            }
            // Relaxing modes: h/2T with T = 0.5 ns and h up to 0.003 ns. Oscillating modes: phase
            // errors of the fastest modes, which hardly move the tip.
            assert!(largest < 3e-3, "{integrator}, {rate}: {largest:e}");
        }
    }
}

const FREE: [(&str, &str); 3] = [
    ("rod", "Rod(from_nm: 0.0, to_nm: 30.0, segments: 3)"),
    ("monomers", "Ellipsoids(from_nm: 0.0, to_nm: 30.0)"),
    (
        "mixed",
        "Ellipsoids(from_nm: 0.0, to_nm: 15.0), Rod(from_nm: 15.0, to_nm: 35.0, segments: 2)",
    ),
];

/// Torque of drag about the centre of mass between two states at times `t` apart:
/// `sum g_t m r x v + sum g_r I w`.
fn torque_of_drag(before: &State, after: &State, t: f64, rates: (f64, f64)) -> Vector3 {
    let masses: Vec<f64> = before
        .points
        .inverse_mass()
        .iter()
        .map(|m| 1.0 / m)
        .collect();
    let places = || before.points.position.iter().zip(&masses);
    let middle = places().map(|(x, m)| *m * x).sum::<Vector3>() / masses.iter().sum::<f64>();
    let of_points = places().enumerate().map(|(i, (x, m))| {
        let velocity = (after.points.position.get(i) - x) / t;
        (x - middle).cross(&velocity) * *m
    });
    let of_frames = (0..before.frames.len()).map(|i| {
        let q = before.frames.orientation.get(i);
        let spin = rotation::log(q.inverse() * after.frames.orientation.get(i)) / t;
        q * spin.component_div(&before.frames.inverse_moments(i))
    });
    of_points.sum::<Vector3>() * rates.0 + of_frames.sum::<Vector3>() * rates.1
}

/// A free filament under a couple rotates so that drag balances it: `sum g_t m r x v + sum g_r I w
/// = T`.
#[test]
fn a_free_filament_turns_as_the_couple_says() {
    for (model, sections) in FREE {
        for (translational, rotational) in [(100.0, 100.0), (1e3, 1e3), (1e4, 1e4), (1e3, 1e4)] {
            // Eighteen relaxation times of the slowest bending mode, about 30 rad/ns; rotations stay
            // small.
            let duration = (0.02f64 * translational).max(4.0);
            let force = 1e-6 * translational / duration;
            let (assembly, trajectory, _) = ran(&format!(
                "Scene(
                    filament: Filament(
                        sections: [{sections}],
                        monomers: (anchors: Independent, lateral_bonds: 16, longitudinal_bonds: 16),
                        rod: RodModel(law: Constant),
                    ),
                    loads: [
                        EndForce(end: End, force_pn: (0.0, {force:?}, 0.0)),
                        EndForce(end: Start, force_pn: (0.0, {:?}, 0.0)),
                    ],
                    task: Dynamics(duration_ns: {duration:?}, record_every_ns: {:?}, {}),
                )",
                -force,
                0.25 * duration,
                drag(translational, rotational)
            ));
            let [.., before, after] = &trajectory.records[..] else {
                panic!("two records");
            };
            let ends = [End::End, End::Start].map(|end| assembly.tip_nm(&before.state, end));
            let expected = (ends[0] - ends[1]).cross(&(Vector3::y() * force));
            let rates = (translational, rotational);
            let time = after.at.value() - before.at.value();
            let found = torque_of_drag(&before.state, &after.state, time, rates);
            let share = found.dot(&expected) / expected.norm_squared();
            assert!((share - 1.0).abs() < 1e-5, "{model}, {rates:?}: {share}");
        }
    }
}

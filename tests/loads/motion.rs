//! Motion under time-dependent loads and following loads.

use super::common::{BEND, DENSITY, LENGTH, SHEAR, cantilever, run};
use actin_sim::{Assembly, End, Trajectory};
use nalgebra::Complex;
use std::f64::consts::TAU;

fn tips(assembly: &Assembly, trajectory: &Trajectory) -> Vec<(f64, f64)> {
    let records = trajectory.records.iter();
    records
        .map(|r| (r.at.value(), assembly.tip_nm(&r.state, End::End).x))
        .collect()
}

/// Tip receptance of a cantilever (nm/pN): Euler-Bernoulli beam with a drag rate (1/ns). With
/// `beta^4 = m (Omega^2 - i gamma Omega) L^4 / B` it is `L^3/B (cos b sinh b - sin b cosh b) / (b^3
/// (1 + cos b cosh b))`, up to its sign.
fn receptance(omega: f64, drag: f64) -> Complex<f64> {
    let fourth = Complex::new(omega * omega, -drag * omega) * (DENSITY * LENGTH.powi(4) / BEND);
    let b = fourth.powf(0.25);
    let (c, s, ch, sh) = (b.cos(), b.sin(), b.cosh(), b.sinh());
    (s * ch - c * sh) / (b.powu(3) * (c * ch + 1.0)) * (LENGTH.powi(3) / BEND)
}

/// Complex amplitude at a known frequency over the last `periods` of a motion.
fn harmonic(tips: &[(f64, f64)], omega: f64, periods: f64) -> Complex<f64> {
    let end = tips[tips.len() - 1].0;
    let from = end - periods * TAU / omega;
    // With 40 records per period the sum over whole periods is exact for a sine.
    let last = tips.iter().filter(|(t, _)| *t > from + 1e-9);
    let (mut sum, mut count) = (Complex::new(0.0, 0.0), 0.0);
    for (t, x) in last {
        sum += Complex::new(0.0, -omega * t).exp() * *x;
        count += 1.0;
    }
    sum * Complex::new(0.0, 2.0) / count
}

/// Amplitude and phase below, at and above the first resonance (0.170 rad/ns) against beam theory
/// with the same drag.
#[test]
fn a_sine_drives_a_cantilever_as_beam_theory_says() {
    let (first, drag, force) = (0.17_f64, 0.15, 1e-3);
    for share in [0.5, 1.0, 1.8] {
        let omega = share * first;
        let period = TAU / omega;
        // Transients decay by exp(-drag t / 2), to 1e-6 in 185 ns.
        let periods = (190.0 / period).ceil() + 2.0;
        let exact = receptance(omega, drag) * force;
        let answers = [8, 16, 32].map(|segments| {
            let load = format!(
                "Force(end: End, force_pn: ({force:?}, 0.0, 0.0), factor: Sine(period_ns: {period:?}))"
            );
            let task = format!(
                "task: Dynamics(duration_ns: {:?}, record_every_ns: {:?},
                    drag: (translational_per_ns: {drag:?}, rotational_per_ns: {drag:?})),",
                periods * period,
                period / 40.0
            );
            // Shear adds 3 B / S L^2 = 3e-4 of the deflection.
            let (assembly, trajectory) = run(&cantilever(segments, 1.6e4, &load, &task));
            harmonic(&tips(&assembly, &trajectory), omega, 2.0)
        });
        let what = format!("sine at {share} of the resonance");
        // Differences of meshes exclude shear and rotary inertia, which beam theory neglects.
        let order = ((answers[0] - answers[1]).norm() / (answers[1] - answers[2]).norm()).log2();
        let limit = (answers[2] * 4.0 - answers[1]) / 3.0 / exact - 1.0;
        assert!((order - 2.0).abs() < 0.25, "{what}: {order}");
        assert!(limit.norm() < 2e-3, "{what}: {limit:e}");
        let phase = (answers[2] / exact).arg();
        assert!(phase.abs() < 5e-3, "{what}: {phase}");
    }
}

#[test]
fn a_sine_keeps_the_order_of_the_method() {
    let state = |steps: u32| {
        let load = "Force(at_nm: 90.0, force_pn: (30.0, 0.0, 0.0), factor: Sine(period_ns: 0.11, phase_deg: 40.0)),
            Couple(end: End, couple_pn_nm: (0.0, 40.0, 0.0), factor: Ramp(duration_ns: 0.1))";
        let step = 0.1 / f64::from(steps);
        let task = format!(
            "task: Dynamics(duration_ns: 0.1, time_step_ns: {step:?}, record_every_ns: 0.1),"
        );
        let (assembly, _) = run(&cantilever(4, 1e4, load, &task));
        assembly.system.state().points.position.clone()
    };
    let reference = state(1600);
    let error = |steps| {
        let found = state(steps);
        let off = found
            .iter()
            .zip(reference.iter())
            .map(|(a, b)| (a - b).norm());
        off.fold(0.0, f64::max)
    };
    let errors = [50, 100, 200].map(error);
    let orders = [errors[0] / errors[1], errors[1] / errors[2]].map(f64::log2);
    assert!(
        orders.iter().all(|order| (order - 4.0).abs() < 0.3),
        "{orders:?}"
    );
}

#[test]
fn the_stop_rule_waits_for_changing_loads() {
    let load = "Force(end: End, force_pn: (0.01, 0.0, 0.0),
        factor: Table(time_ns: [20.0, 30.0, 40.0], factor: [0.0, 2.0, 1.0]))";
    let task = "task: Dynamics(duration_ns: 600.0, record_every_ns: 5.0,
        drag: (translational_per_ns: 0.4, rotational_per_ns: 0.4),
        stop: (force_pn: 1e-7, torque_pn_nm: 1e-6, kinetic_pn_nm: 1e-12)),";
    let (assembly, trajectory) = run(&cantilever(16, 1.6e4, load, task));
    let all = tips(&assembly, &trajectory);
    let (end, tip) = all[all.len() - 1];
    let exact = 0.01 * LENGTH.powi(3) / (3.0 * BEND);
    assert!(end > 40.0 && end < 600.0, "{end}");
    assert!(
        all.iter()
            .filter(|(t, _)| *t <= 20.0)
            .all(|(_, x)| x.abs() < 1e-12)
    );
    // 16 segments: half a percent.
    assert!((tip / exact - 1.0).abs() < 5e-3, "{tip}");
}

#[test]
fn loads_with_a_potential_conserve_energy() {
    let loads = "Force(at_nm: 90.0, force_pn: (2.0, 0.0, 0.0)),
        Couple(end: End, couple_pn_nm: (0.0, 70.0, 80.0)),
        Couple(at_nm: 55.0, couple_pn_nm: (-40.0, 0.0, 30.0)),
        ForcePerLength(force_pn_per_nm: (0.0, 0.02, 0.0)),
        CouplePerLength(couple_pn_nm_per_nm: (0.0, 0.0, 0.5)),
        Acceleration(acceleration_nm_per_ns2: (0.0, 0.3, 0.0)),";
    let task = "task: Dynamics(duration_ns: 20.0, record_every_ns: 0.5, step_safety: 0.25),";
    let (_, trajectory) = run(&cantilever(8, 1.6e4, loads, task));
    let totals = trajectory.records.iter();
    let totals: Vec<f64> = totals
        .map(|r| r.kinetic_pn_nm + r.energies_pn_nm.iter().sum::<f64>())
        .collect();
    let kinetic = trajectory
        .records
        .iter()
        .map(|r| r.kinetic_pn_nm)
        .fold(0.0, f64::max);
    let worst = totals
        .iter()
        .map(|e| (e - totals[0]).abs())
        .fold(0.0, f64::max);
    assert!(kinetic > 50.0, "{kinetic}");
    // PEFRL at a quarter of its limit.
    assert!(worst < 1e-4 * kinetic, "{worst} of {kinetic}");
}

/// Growth of the deflection of a cantilever under a following axial force, from the first to the
/// last third.
fn growth(load: f64) -> f64 {
    let force = -load * BEND / LENGTH.powi(2);
    let loads = format!(
        "Force(end: End, force_pn: (0.0, 0.0, {force:?}), follows: true),
         Force(end: End, force_pn: (1e-3, 0.0, 0.0),
            factor: Table(time_ns: [0.0, 2.0, 2.001], factor: [1.0, 1.0, 0.0]))"
    );
    let task = "task: Dynamics(duration_ns: 150.0, record_every_ns: 0.5),";
    let (assembly, trajectory) = run(&cantilever(16, SHEAR / 30.0, &loads, task));
    let all = tips(&assembly, &trajectory);
    let largest = |part: &[(f64, f64)]| part.iter().map(|(_, x)| x.abs()).fold(0.0, f64::max);
    let third = all.len() / 3;
    largest(&all[2 * third..]) / largest(&all[..third])
}

/// Beck's column: a cantilever under a following tip force flutters from `P = 20.05 B / L^2`.
/// Sixteen segments have an error of about a percent.
///
/// # Source
/// M. Beck, Z. angew. Math. Phys. 3 (1952) 225.
#[test]
fn a_column_under_a_following_force_flutters() {
    let [below, above] = [18.0, 22.0].map(growth);
    assert!(below < 2.0, "{below}");
    assert!(above > 5.0, "{above}");
}

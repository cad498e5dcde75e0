//! The first flexural frequency of a clamped rod against theory.

use super::common::{build, orders, run};
use actin_mechanics::Vector3;
use actin_sim::Assembly;

/// Smallest root of `1 + cos x cosh x = 0`: `beta_1 L` of the clamped-free beam.
const BETA_L: f64 = 1.875_104_068_711_961;
/// Length of the rod (nm).
const LENGTH: f64 = 160.0;
/// Bending and shearing rigidity, in pN nm^2 and pN.
const BEND: f64 = 3.9e4;
const SHEAR: f64 = 1.6e4;
/// Mass per length (pN ns^2/nm^2): a monomer's mass over the rise.
const DENSITY: f64 = 0.0697 / (71.2 / 26.0);
/// Area of the cross-section (nm^2).
const AREA: f64 = 38.5;

/// Deflection and slope of the first mode of the Euler-Bernoulli cantilever at `s`.
fn mode(s: f64) -> (f64, f64) {
    let beta = BETA_L / LENGTH;
    let x = beta * s;
    let sigma = (BETA_L.cosh() + BETA_L.cos()) / (BETA_L.sinh() + BETA_L.sin());
    let deflection = x.cosh() - x.cos() - sigma * (x.sinh() - x.sin());
    let slope = x.sinh() + x.sin() - sigma * (x.cosh() - x.cos());
    (deflection, beta * slope)
}

/// The frequency of the slender beam, `(beta_1 L)^2 sqrt(B / mu) / L^2` (rad/ns).
fn slender() -> f64 {
    (BETA_L / LENGTH).powi(2) * (BEND / DENSITY).sqrt()
}

/// What rotary inertia and shear take off it, to first order, relative:
/// `(A / 4 pi + B / S) / 2` times the mean of the squared slope over that of the squared
/// deflection, `sigma beta (2 + sigma beta L) / L` (both terms have the same integral, since the
/// curvature of the mode is the mode seen from the other end).
fn thickness() -> f64 {
    let sigma = (BETA_L.cosh() + BETA_L.cos()) / (BETA_L.sinh() + BETA_L.sin());
    let x = sigma * BETA_L;
    let slopes = x * (2.0 + x) / (LENGTH * LENGTH);
    0.5 * (AREA / (4.0 * std::f64::consts::PI) + BEND / SHEAR) * slopes
}

/// An unloaded, undamped rod.
fn rod(segments: usize) -> Assembly {
    build(&format!(
        "Scene(
            filament: Filament(sections: [
                Rod(from_nm: 0.0, to_nm: {LENGTH:?}, segments: {segments}),
            ], rod: RodModel(law: Constant)),
            clamps: [Clamp(end: Start)],
            task: Dynamics(duration_ns: 100.0, record_every_ns: 0.1),
        )"
    ))
}

/// Sets the rod in motion as in the first mode, 1e-3 nm/ns at the tip, so that it swings by
/// 1e-2 nm about its straight rest.
fn strike(assembly: &mut Assembly) {
    let (points, frames) = (assembly.points.clone(), assembly.frames.clone());
    let state = assembly.system.state_mut();
    let tip_speed = 1e-3 / mode(LENGTH).0;
    for (i, point) in points.iter().enumerate().filter(|(_, p)| p.s_nm > 0.0) {
        let (deflection, _) = mode(point.s_nm);
        let velocity = Vector3::x() * (tip_speed * deflection);
        state.points.velocity.set(i, velocity);
    }
    for (i, frame) in frames.iter().enumerate() {
        if state.frames.is_free(i) {
            let (_, slope) = mode(frame.s_nm);
            // A slope towards x is a turn about y.
            let omega = Vector3::y() * (tip_speed * slope);
            let momentum = omega.component_div(&state.frames.inverse_moments(i));
            state.frames.angular_momentum.set(i, momentum);
        }
    }
}

/// Times at which the amplitude of the first mode changes its sign.
///
/// The amplitude is the projection on the mode, in which higher modes are absent but for the
/// error of the mesh. Linear interpolation over 0.1 ns of a period of 37 ns is good to 1e-6.
fn crossings(assembly: &mut Assembly) -> Vec<f64> {
    let (trajectory, _) = run(assembly);
    let amplitudes: Vec<(f64, f64)> = trajectory
        .records
        .iter()
        .map(|record| {
            let nodes = assembly
                .points
                .iter()
                .zip(record.state.points.position.iter());
            let amplitude = nodes.map(|(node, x)| mode(node.s_nm).0 * x.x).sum();
            (record.at.value(), amplitude)
        })
        .collect();
    amplitudes
        .windows(2)
        .filter(|pair| pair[0].1 * pair[1].1 < 0.0)
        .map(|pair| {
            let [(t0, a0), (t1, a1)] = [pair[0], pair[1]];
            t0 + (t1 - t0) * a0 / (a0 - a1)
        })
        .collect()
}

/// The frequency of free vibration (rad/ns): half a turn between two zeros.
fn measured(segments: usize) -> f64 {
    let mut assembly = rod(segments);
    strike(&mut assembly);
    let zeros = crossings(&mut assembly);
    let (first, last) = (zeros[0], zeros[zeros.len() - 1]);
    (zeros.len() - 1) as f64 * std::f64::consts::PI / (last - first)
}

/// Masses, moments of inertia and rigidities together: a mass that is counted twice at the tip,
/// or the inertia of a solid segment instead of that of its cross-section, moves the frequency by
/// a tenth or by a percent. Against the slender beam the 10 nm mesh is within 1 %.
#[test]
fn the_first_flexural_frequency_is_that_of_the_beam() {
    let slender = slender();
    assert!((slender - 0.170).abs() < 5e-4, "{slender}");
    let theory = slender * (1.0 - thickness());
    let errors = [8, 16, 32].map(|segments| measured(segments) / theory - 1.0);
    println!("slender {slender}, thick {theory}, errors {errors:?}");
    let at_10_nm = (1.0 + errors[1]) * theory / slender;
    assert!((at_10_nm - 1.0).abs() < 0.01, "{at_10_nm}");
    for order in orders(errors) {
        assert!((order - 2.0).abs() < 0.05, "{errors:?}");
    }
    // Second-order terms of the thickness and fourth-order ones of the mesh, each about 1e-6, and
    // the nonlinearity of a swing of 1e-2 nm, which is less.
    let limit = (4.0 * errors[2] - errors[1]) / 3.0;
    assert!(limit.abs() < 1e-5, "{limit:e}");
}

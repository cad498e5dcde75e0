//! Rate at which the rod's loads are evaluated: elements (segments) per second, one thread; and
//! the time in which its second derivatives are.
//!
//! `cargo run --release -p actin-cosserat --example load_rate [SEGMENTS]`

use actin_cosserat::{EnergyGradient, PaperBalance, Rigidities, RodMaterial, StraightRod, Walls};
use actin_mechanics::testing::{Noise, perturb};
use actin_mechanics::{Interaction, Loads, SecondOrder, State, Stiffness};
use std::hint::black_box;
use std::time::Instant;

/// Segments per second of repeated evaluations over about a second; the best of five.
fn rate(law: &dyn Interaction, state: &State, segments: usize) -> f64 {
    let mut loads = Loads::zeros(state);
    let evaluations = 10_000_000 / segments;
    let once = |loads: &mut Loads| {
        let started = Instant::now();
        for _ in 0..evaluations {
            loads.clear();
            law.add_loads(black_box(state), loads);
            black_box(&*loads);
        }
        (evaluations * segments) as f64 / started.elapsed().as_secs_f64()
    };
    (0..5).map(|_| once(&mut loads)).fold(0.0, f64::max)
}

/// Microseconds for all blocks of second derivatives; the best of five.
fn stiffness_time(law: &dyn SecondOrder, state: &State, segments: usize) -> f64 {
    let mut stiffness = Stiffness::default();
    let evaluations = 1_000_000 / segments;
    let mut once = || {
        let started = Instant::now();
        for _ in 0..evaluations {
            stiffness.clear();
            law.add_stiffness(black_box(state), &mut stiffness);
            black_box(&stiffness);
        }
        started.elapsed().as_secs_f64() / evaluations as f64
    };
    (0..5).map(|_| once()).fold(f64::INFINITY, f64::min) * 1e6
}

fn main() {
    let segments = std::env::args().nth(1).and_then(|n| n.parse().ok());
    let segments = segments.unwrap_or(64);
    for angle in [1e-3, 0.05] {
        let rod = StraightRod {
            walls: Walls {
                start: true,
                end: false,
            },
            ..StraightRod::uniform(segments, 160.0 / segments as f64)
        };
        let mut state = State::default();
        let layout = rod.push(&mut state).expect("the rod has segments");
        perturb(&mut state, &mut Noise::new(1), 1e-3, angle);
        let material = RodMaterial::new(Rigidities::table4()).expect("the table is valid");
        let gradient = EnergyGradient::new(layout.clone(), material);
        let printed = PaperBalance::new(layout, material);
        println!(
            "{segments} segments, angles to {angle}: energy-gradient {:.3e}, paper-balance {:.3e} \
             elements/s; stiffness {:.1} us",
            rate(&gradient, &state, segments),
            rate(&printed, &state, segments),
            stiffness_time(&gradient, &state, segments),
        );
    }
}

//! Evaluation rate of a rod's loads (segments per second, one thread) and time per evaluation of
//! its second derivatives.
//!
//! `cargo run --release -p actin-cosserat --example load_rate [SEGMENTS [LAW [EVALUATIONS]]]` for
//! all laws, or for one of `constant`, `published`, `fitted`, `homogenised`, `printed`. With
//! EVALUATIONS the loads are evaluated that many times without timing, for a profiler.

#[path = "../benches/common/mod.rs"]
mod common;

use actin_cosserat::PaperBalance;
use actin_mechanics::{Interaction, Loads, State, Stiffness};
use std::hint::black_box;
use std::time::Instant;

fn evaluate(law: &dyn Interaction, state: &State, evaluations: usize) {
    let mut loads = Loads::zeros(state);
    for _ in 0..evaluations {
        loads.clear();
        law.add_loads(black_box(state), &mut loads);
        black_box(&loads);
    }
}

/// Segments per second: maximum over short series, some of which are not interrupted by other
/// processes.
fn rate(law: &dyn Interaction, state: &State, segments: usize) -> f64 {
    let evaluations = (30_000 / segments).max(10);
    let once = || {
        let started = Instant::now();
        evaluate(law, state, evaluations);
        (evaluations * segments) as f64 / started.elapsed().as_secs_f64()
    };
    (0..200).map(|_| once()).fold(0.0, f64::max)
}

/// Time for all blocks of second derivatives (us): minimum of five series.
fn stiffness_time(law: &dyn Interaction, state: &State, segments: usize) -> Option<f64> {
    let law = law.second_order()?;
    let mut stiffness = Stiffness::default();
    let evaluations = 300_000 / segments;
    let mut once = || {
        let started = Instant::now();
        for _ in 0..evaluations {
            stiffness.clear();
            law.add_stiffness(black_box(state), &mut stiffness);
            black_box(&stiffness);
        }
        started.elapsed().as_secs_f64() / evaluations as f64
    };
    Some((0..5).map(|_| once()).fold(f64::INFINITY, f64::min) * 1e6)
}

fn main() {
    let segments = std::env::args().nth(1).and_then(|n| n.parse().ok());
    let segments = segments.unwrap_or(64);
    let chosen = std::env::args().nth(2);
    let counted = std::env::args().nth(3).and_then(|n| n.parse().ok());
    for angle in [1e-3, 0.05] {
        let (state, layout) = common::rod(segments, angle);
        let [constant, ..] = common::laws();
        let mut rods: Vec<(&str, Box<dyn Interaction>)> = Vec::new();
        for law in common::laws() {
            rods.push((law.0, Box::new(common::interaction(&layout, law))));
        }
        let printed = PaperBalance::new(layout, constant.1).expect("its rigidities are constant");
        rods.push(("printed", Box::new(printed)));
        rods.retain(|(name, _)| chosen.as_deref().is_none_or(|chosen| chosen == *name));
        for (name, rod) in rods {
            if let Some(evaluations) = counted {
                evaluate(&*rod, &state, evaluations);
                continue;
            }
            let rate = rate(&*rod, &state, segments);
            print!("{segments} segments, angles to {angle}, {name}: {rate:.3e} elements/s");
            match stiffness_time(&*rod, &state, segments) {
                Some(time) => println!("; stiffness {time:.1} us"),
                None => println!(),
            }
        }
    }
}

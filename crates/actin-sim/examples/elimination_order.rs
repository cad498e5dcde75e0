//! Cost of orders of elimination: parallel filaments of 160 nm, cross-linked every 40 nm,
//! eliminated one after another, by arc length, and with least fill-in.
//!
//! `cargo run --release -p actin-sim --example elimination_order`
//!
//! Prints the number of unknowns of each bundle. For each order it prints the entries of the factor
//! and the shortest time of a certificate (`Newton::certify`), which assembles and factorises a
//! fixed number of times.

use actin_equilibrium::{BodyOrder, Layout, Newton, NewtonOptions};
use actin_sim::{Assembly, Scene};
use std::time::Instant;

const MODELS: [(&str, &str); 2] = [
    ("monomers", "Ellipsoids(from_nm: 0.0, to_nm: 160.0)"),
    ("rods", "Rod(from_nm: 0.0, to_nm: 160.0, segments: 16)"),
];
const COUNTS: [usize; 4] = [1, 2, 4, 8];
/// Arc lengths of the cross-linkers (nm).
const PLACES: [f64; 4] = [40.0, 80.0, 120.0, 160.0];
/// Repetitions; the shortest time counts.
const REPEATS: usize = 5;

fn main() {
    println!("model     filaments unknowns | entries and ms: one by one | along | least fill");
    for (name, sections) in MODELS {
        for count in COUNTS {
            let assembly = bundle(count, sections);
            let state = assembly.system.state();
            let layout = |apart| Layout::new(state, Some(&order(&assembly, apart)));
            let layout = |apart| layout(apart).expect("one number for each body");
            let layouts = [layout(1e3), layout(0.0), layout(1e3).with_links()];
            let unknowns = layouts[0].unknowns();
            let costs = layouts.map(|layout| cost(&assembly, &layout));
            let shown = costs.map(|(entries, ms)| format!("{entries:8} {ms:8.2}"));
            println!("{name:9} {count:9} {unknowns:8} | {}", shown.join(" | "));
        }
    }
}

/// Filaments 10 nm apart, clamped at their starts.
fn bundle(count: usize, sections: &str) -> Assembly {
    let filament = |i: usize| {
        let x = 10.0 * i as f64;
        format!("Filament(sections: [{sections}], at_nm: ({x:?}, 0.0, 0.0)),")
    };
    let clamp = |i: usize| format!("Clamp(filament: {i}, end: Start),");
    let linker = |i: usize, s: f64| {
        format!(
            "Linker(filament: {i}, at_nm: {s:?}, to: Site(filament: {}, at_nm: {s:?}),
                stiffness_pn_per_nm: 50.0, rest_length_nm: 10.0),",
            i + 1
        )
    };
    let filaments: String = (0..count).map(filament).collect();
    let clamps: String = (0..count).map(clamp).collect();
    let linkers: String = (0..count - 1)
        .flat_map(|i| PLACES.map(|s| linker(i, s)))
        .collect();
    let text = format!(
        "Scene(filaments: [{filaments}], clamps: [{clamps}], linkers: [{linkers}],
            task: Equilibrium())"
    );
    let scene = Scene::from_ron(&text).expect("the scene above is valid");
    Assembly::build(&scene).expect("the scene above can be built")
}

/// Arc lengths, with an offset `apart` (nm) between successive filaments.
fn order(assembly: &Assembly, apart: f64) -> BodyOrder {
    let place = |filament: usize, s_nm: f64| apart * filament as f64 + s_nm;
    let points = assembly.points.iter().enumerate();
    let frames = assembly.frames.iter().enumerate();
    BodyOrder {
        points: points
            .map(|(i, p)| place(assembly.filament_of_point(i), p.s_nm))
            .collect(),
        frames: frames
            .map(|(i, f)| place(assembly.filament_of_frame(i), f.s_nm))
            .collect(),
    }
}

/// Entries of the factor, and the time of a certificate (ms).
fn cost(assembly: &Assembly, layout: &Layout) -> (u64, f64) {
    let (state, interactions) = (assembly.system.state(), assembly.system.interactions());
    let mut newton = Newton::new(layout.clone(), NewtonOptions::default()).expect("the defaults");
    let mut certify = || {
        let started = Instant::now();
        let certificate = newton.certify(state, interactions);
        certificate.expect("every interaction has second derivatives");
        started.elapsed().as_secs_f64() * 1e3
    };
    // The first call computes the pattern.
    certify();
    let least = (0..REPEATS)
        .map(|_| certify())
        .fold(f64::INFINITY, f64::min);
    (newton.work().factor_entries, least)
}

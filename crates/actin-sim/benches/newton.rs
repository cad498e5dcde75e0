//! Assembly and factorisation of one Newton iteration. `cargo xtask bench` measures time steps.
//!
//! `cargo bench -p actin-sim --bench newton`

use actin_equilibrium::{BodyOrder, Layout, Newton, NewtonOptions};
use actin_mechanics::{Xorshift, perturb};
use actin_sim::{Assembly, Scene};
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use std::hint::black_box;

/// Clamped filaments of 160 nm: a rod of 64 segments, and 60 monomers.
const ROD: &str = "Rod(from_nm: 0.0, to_nm: 160.0, segments: 64)";
const MONOMERS: &str = "Ellipsoids(from_nm: 0.0, to_nm: 160.0)";
const LONG: &str = "Ellipsoids(from_nm: 0.0, to_nm: 1600.0)";

fn assembly(section: &str) -> Assembly {
    let text = format!(
        "Scene(
            filament: Filament(sections: [{section}]),
            clamps: [Clamp(end: Start)],
            loads: [EndForce(end: End, force_pn: (-2.0, 0.0, 0.0))],
            task: Equilibrium(),
        )"
    );
    let scene = Scene::from_ron(&text).expect("the scene is well formed");
    Assembly::build(&scene).expect("the scene has room for its bodies")
}

fn newton_iteration(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("newton_iteration");
    for (name, section) in [
        ("rod_64", ROD),
        ("monomers_60", MONOMERS),
        ("1600_nm", LONG),
    ] {
        let mut assembly = assembly(section);
        perturb(
            assembly.system.state_mut(),
            &mut Xorshift::new(1),
            1e-3,
            1e-3,
        );
        let order = BodyOrder {
            points: assembly.points.iter().map(|p| p.s_nm).collect(),
            frames: assembly.frames.iter().map(|f| f.s_nm).collect(),
        };
        let (state, terms) = (assembly.system.state(), assembly.system.interactions());
        let layout = Layout::new(state, Some(&order)).expect("it fits the state");
        let ones = vec![1.0; layout.unknowns()];
        let mut newton = Newton::new(layout, NewtonOptions::default()).expect("by default valid");
        group.bench_function(BenchmarkId::new("assembly", name), |bencher| {
            bencher.iter(|| black_box(newton.stiffness_times(state, terms, &ones).is_ok()));
        });
        // A certificate factorises twice, with positive and negative shift.
        group.bench_function(
            BenchmarkId::new("assembly_and_two_factors", name),
            |bencher| {
                bencher.iter(|| black_box(newton.certify(state, terms).is_ok()));
            },
        );
    }
    group.finish();
}

criterion_group!(benches, newton_iteration);
criterion_main!(benches);

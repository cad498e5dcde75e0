//! Loads of a rod: the fast path of constant rigidities, and a law that takes the scalar path.
//!
//! `cargo bench -p actin-cosserat --bench rod_loads`

use actin_cosserat::{
    EnergyGradient, Rigidities, RodMaterial, StraightRod, TanhTwist, TwistLaw, Walls,
};
use actin_mechanics::testing::{Noise, perturb};
use actin_mechanics::{Interaction, Loads, State};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;

/// Angles between neighbours (rad) of a rod that is well bent.
const ANGLE: f64 = 0.02;

fn rod_loads(criterion: &mut Criterion) {
    let constant = RodMaterial::new(Rigidities::table4()).expect("the table is valid");
    let published = TwistLaw::Tanh(TanhTwist::published());
    let tanh = constant.with_twist(published).expect("the law is valid");
    let mut group = criterion.benchmark_group("rod_loads");
    for segments in [16, 64, 256, 1024] {
        let rod = StraightRod {
            walls: Walls {
                start: true,
                end: false,
            },
            ..StraightRod::uniform(segments, 160.0 / segments as f64)
        };
        let mut state = State::default();
        let layout = rod.push(&mut state).expect("the rod has segments");
        perturb(&mut state, &mut Noise::new(1), 1e-3, ANGLE);
        let mut loads = Loads::zeros(&state);
        group.throughput(Throughput::Elements(segments as u64));
        for (name, material) in [("constant", constant), ("tanh_twist", tanh)] {
            let law = EnergyGradient::new(layout.clone(), material);
            group.bench_function(BenchmarkId::new(name, segments), |bencher| {
                bencher.iter(|| {
                    loads.clear();
                    law.add_loads(black_box(&state), &mut loads);
                    black_box(&loads);
                });
            });
        }
    }
    group.finish();
}

criterion_group!(benches, rod_loads);
criterion_main!(benches);

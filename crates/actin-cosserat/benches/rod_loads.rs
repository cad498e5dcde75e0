//! Loads of a rod under each law with a vector kernel.
//!
//! `cargo bench -p actin-cosserat --bench rod_loads`

mod common;

use actin_mechanics::{Interaction, Loads};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;

/// Angle between neighbours (rad).
const ANGLE: f64 = 0.02;

fn rod_loads(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("rod_loads");
    for segments in [16, 64, 256, 1024] {
        let (state, layout) = common::rod(segments, ANGLE);
        let mut loads = Loads::zeros(&state);
        group.throughput(Throughput::Elements(segments as u64));
        for law in common::laws() {
            let rod = common::interaction(&layout, law);
            group.bench_function(BenchmarkId::new(law.0, segments), |bencher| {
                bencher.iter(|| {
                    loads.clear();
                    rod.add_loads(black_box(&state), &mut loads);
                    black_box(&loads);
                });
            });
        }
    }
    group.finish();
}

criterion_group!(benches, rod_loads);
criterion_main!(benches);

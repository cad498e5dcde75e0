//! Bond loads of monomers.
//!
//! `cargo bench -p actin-ellipsoid --bench bond_loads`

use actin_ellipsoid::{EllipsoidModel, EllipsoidParameters, Placement};
use actin_mechanics::{Interaction, Loads, State};
use actin_mechanics::{Xorshift, perturb};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;

fn bond_loads(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("bond_loads");
    for (monomers, per_interface) in [(60, 10), (1000, 10), (60, 64)] {
        let parameters = EllipsoidParameters::with_sampled_bonds(per_interface, 0);
        let model = EllipsoidModel::new(parameters).expect("the parameters are valid");
        let mut state = State::default();
        let run = model
            .build(&mut state, &Placement::default(), 0, monomers)
            .unwrap();
        let bonds = model.bonds(&run).expect("the interfaces have bonds");
        perturb(&mut state, &mut Xorshift::new(1), 0.05, 0.05);
        let mut loads = Loads::zeros(&state);
        group.throughput(Throughput::Elements(bonds.number_of_bonds() as u64));
        let id = BenchmarkId::new(format!("{per_interface}_per_interface"), monomers);
        group.bench_function(id, |bencher| {
            bencher.iter(|| {
                loads.clear();
                bonds.add_loads(black_box(&state), &mut loads);
                black_box(&loads);
            });
        });
    }
    group.finish();
}

criterion_group!(benches, bond_loads);
criterion_main!(benches);

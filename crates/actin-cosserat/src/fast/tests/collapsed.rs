//! Segments of nearly zero length, and inverted segments.

use super::*;
use crate::extended::MeanCurvature;
use crate::fast::laws::Law;
use actin_mechanics::wide::{Columns, ColumnsMut, Simd, WithSimd};

struct OfSegments<'a, L>(L, &'a [[Vector3; 2]]);

impl<L: Law> WithSimd for OfSegments<'_, L> {
    type Output = Vec<[Vector3; 2]>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let states = self.1;
        let part = |k: usize| states.iter().map(|both| both[k / 3][k % 3]).collect();
        let arguments: [Vec<f64>; 6] = std::array::from_fn(part);
        let mut results = arguments.clone();
        let columns = Columns::<S, 6>::new(arguments.each_ref().map(Vec::as_slice));
        let mut out = ColumnsMut::<S, 6>::new(results.each_mut().map(Vec::as_mut_slice));
        for group in 0..columns.groups() {
            let [a, b, c, d, e, f] = columns.get(simd, group);
            let [[a, b, c], [d, e, f]] = self.0.segment(simd, [a, b, c], [d, e, f]);
            out.set(simd, group, [a, b, c, d, e, f]);
        }
        let [a, b, c, d, e, f] = &results;
        let vectors = |i: usize| [[a[i], b[i], c[i]], [d[i], e[i], f[i]]].map(Vector3::from);
        (0..states.len()).map(vectors).collect()
    }
}

fn of_segments(arch: Arch, rod: &FastRod, states: &[[Vector3; 2]]) -> Vec<[Vector3; 2]> {
    match &rod.0 {
        Kind::Constant(rod) => arch.dispatch(OfSegments(rod.law, states)),
        Kind::Published(rod) => arch.dispatch(OfSegments(rod.law, states)),
        Kind::Fitted(rod) => arch.dispatch(OfSegments(rod.law, states)),
        Kind::FittedLinearShear(rod) => arch.dispatch(OfSegments(rod.law, states)),
        Kind::Bent(rod) => arch.dispatch(OfSegments(rod.law, states)),
        Kind::Potential(rod) => arch.dispatch(OfSegments(rod.law, states)),
    }
}

/// Strains of segments with 1e-9 to 3 times their rest length, in all directions, at random
/// curvatures.
fn states() -> Vec<[Vector3; 2]> {
    let mut noise = Xorshift::new(11);
    let mut segments = vec![
        Vector3::new(1e-9, 0.0, 0.0),
        Vector3::new(0.0, -1e-4, 0.0),
        -Vector3::z(),
        Vector3::z(),
    ];
    for size in [1e-9, 1e-6, 1e-4, 1e-2, 0.1, 1.0, 3.0] {
        segments.extend((0..20).map(|_| noise.vector().normalize() * size));
    }
    let state = |segment| [segment - Vector3::z(), noise.vector() * 0.1];
    segments.into_iter().map(state).collect()
}

#[test]
fn laws_of_collapsed_and_inverted_segments_are_the_scalar_ones() {
    let (states, (_, layout)) = (states(), rod(3, Walls::default(), &mut Xorshift::new(9)));
    for law in &laws() {
        let extended = extended(&layout, law, false);
        let rod = fast(&layout, law, extended.as_ref());
        let scalar = extended.map_or_else(SegmentLaw::default, |segments| segments.law);
        for arch in architectures() {
            let found = of_segments(arch, &rod, &states);
            for ([sigma, kappa], [force, couple]) in states.iter().zip(found) {
                let expected = scalar.loads(&law.1, *sigma, MeanCurvature::inside(*kappa));
                // About ten roundings of terms up to the forces or 4e4 pN nm^2 times strain and
                // curvature. The potential's polynomials cancel by up to a factor of 20.
                let cancels = if law.0 == "potential" { 20.0 } else { 1.0 };
                let scale = expected.0.norm() + 4e4 * (sigma.norm() + kappa.norm());
                let error = (force - expected.0)
                    .norm()
                    .max((couple - expected.1).norm());
                assert!(
                    error < 2e-15 * cancels * scale,
                    "{}, {sigma}: {error:e}",
                    law.0
                );
                assert!(force.iter().chain(&couple).all(|part| part.is_finite()));
            }
        }
    }
}

fn collapse((state, layout): (&mut State, &RodLayout), size: f64, noise: &mut Xorshift) {
    let first = layout.points().start;
    for (k, length) in layout.segment_lengths().iter().enumerate() {
        let q = state.frames.orientation.get(layout.frames().start + k);
        let segment = q * (noise.vector().normalize() * (size * length));
        let x = &mut state.points.position;
        x.set(first + k + 1, x.get(first + k) + segment);
    }
}

/// Strains are accurate to 2e-16, and the direction of a segment of 1 % of its length to 2e-14.
#[test]
fn loads_of_collapsed_rods_are_those_of_the_scalar_path() {
    let mut noise = Xorshift::new(12);
    for law in &laws() {
        for segments in [1, 2, 5, 16] {
            for size in [0.01, 0.03, 0.3, 1.0] {
                let (mut state, layout) = rod(segments, Walls::default(), &mut noise);
                perturb(&mut state, &mut noise, 0.0, 0.3);
                collapse((&mut state, &layout), size, &mut noise);
                assert_paths_agree((&state, &layout), law, true, 0.0);
            }
        }
    }
}

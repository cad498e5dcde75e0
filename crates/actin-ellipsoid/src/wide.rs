//! Vectors, matrices and rotations of several bodies at once: one body per lane.
//!
//! Products are fused with sums where the machine can, so results may differ in the last digits
//! from one kind of processor to another.
#![allow(
    clippy::inline_always,
    reason = "vector code must be compiled into the function that enables the instructions"
)]

use crate::table::GROUP;
use actin_mechanics::{Quaternions, Vectors};
use pulp::Simd;
use std::ops::Range;

/// Three-vectors.
pub(crate) type Wide3<S> = [<S as Simd>::f64s; 3];

/// Rotation matrices, row by row.
pub(crate) type WideMatrix<S> = [Wide3<S>; 3];

/// The numbers at `range`, at most as many as there are lanes; zero in the lanes beyond.
#[inline(always)]
pub(crate) fn load<S: Simd>(simd: S, values: &[f64], range: &Range<usize>) -> S::f64s {
    let values = &values[range.clone()];
    match S::as_simd_f64s(values).0 {
        [all] => *all,
        _ => simd.partial_load_f64s(values),
    }
}

/// Adds to the numbers at `range`, at most as many as there are lanes.
#[inline(always)]
fn add_to<S: Simd>(simd: S, values: &mut [f64], range: &Range<usize>, terms: S::f64s) {
    let values = &mut values[range.clone()];
    if let [all] = S::as_mut_simd_f64s(values).0 {
        *all = simd.add_f64s(*all, terms);
    } else {
        let sum = simd.add_f64s(simd.partial_load_f64s(values), terms);
        simd.partial_store_f64s(values, sum);
    }
}

/// The numbers that fill the lanes for the `place`-th time.
#[inline(always)]
pub(crate) fn read<S: Simd>(simd: S, numbers: &[f64; GROUP], place: usize) -> S::f64s {
    match S::as_simd_f64s(numbers).0.get(place) {
        Some(lanes) => *lanes,
        None => simd.partial_load_f64s(numbers),
    }
}

/// Replaces the numbers that [`read`] returns.
#[inline(always)]
pub(crate) fn write<S: Simd>(simd: S, numbers: &mut [f64; GROUP], place: usize, values: S::f64s) {
    match S::as_mut_simd_f64s(numbers).0.get_mut(place) {
        Some(lanes) => *lanes = values,
        None => simd.partial_store_f64s(numbers, values),
    }
}

/// The vectors at `range`.
#[inline(always)]
pub(crate) fn load3<S: Simd>(simd: S, vectors: &Vectors, range: &Range<usize>) -> Wide3<S> {
    [
        load(simd, &vectors.x, range),
        load(simd, &vectors.y, range),
        load(simd, &vectors.z, range),
    ]
}

/// Adds to the vectors at `range`.
#[inline(always)]
pub(crate) fn add3<S: Simd>(simd: S, vectors: &mut Vectors, range: &Range<usize>, terms: Wide3<S>) {
    add_to(simd, &mut vectors.x, range, terms[0]);
    add_to(simd, &mut vectors.y, range, terms[1]);
    add_to(simd, &mut vectors.z, range, terms[2]);
}

/// The quaternions at `range`, scalar part first.
#[inline(always)]
pub(crate) fn load_quaternions<S: Simd>(
    simd: S,
    q: &Quaternions,
    range: &Range<usize>,
) -> [S::f64s; 4] {
    [
        load(simd, &q.w, range),
        load(simd, &q.x, range),
        load(simd, &q.y, range),
        load(simd, &q.z, range),
    ]
}

/// `a + b`.
#[inline(always)]
pub(crate) fn add<S: Simd>(simd: S, a: Wide3<S>, b: Wide3<S>) -> Wide3<S> {
    [
        simd.add_f64s(a[0], b[0]),
        simd.add_f64s(a[1], b[1]),
        simd.add_f64s(a[2], b[2]),
    ]
}

/// `a - b`.
#[inline(always)]
pub(crate) fn sub<S: Simd>(simd: S, a: Wide3<S>, b: Wide3<S>) -> Wide3<S> {
    [
        simd.sub_f64s(a[0], b[0]),
        simd.sub_f64s(a[1], b[1]),
        simd.sub_f64s(a[2], b[2]),
    ]
}

/// `a s` for numbers `s`.
#[inline(always)]
pub(crate) fn scale<S: Simd>(simd: S, a: Wide3<S>, s: S::f64s) -> Wide3<S> {
    [
        simd.mul_f64s(a[0], s),
        simd.mul_f64s(a[1], s),
        simd.mul_f64s(a[2], s),
    ]
}

/// `a x b + c`.
#[inline(always)]
pub(crate) fn cross_add<S: Simd>(simd: S, a: Wide3<S>, b: Wide3<S>, c: Wide3<S>) -> Wide3<S> {
    [
        difference_of_products(simd, [a[1], b[2]], [a[2], b[1]], c[0]),
        difference_of_products(simd, [a[2], b[0]], [a[0], b[2]], c[1]),
        difference_of_products(simd, [a[0], b[1]], [a[1], b[0]], c[2]),
    ]
}

/// `a[0] a[1] - b[0] b[1] + c`.
#[inline(always)]
fn difference_of_products<S: Simd>(
    simd: S,
    a: [S::f64s; 2],
    b: [S::f64s; 2],
    c: S::f64s,
) -> S::f64s {
    simd.negate_mul_add_e_f64s(b[0], b[1], simd.mul_add_e_f64s(a[0], a[1], c))
}

/// `-a`.
#[inline(always)]
pub(crate) fn neg<S: Simd>(simd: S, a: Wide3<S>) -> Wide3<S> {
    [
        simd.neg_f64s(a[0]),
        simd.neg_f64s(a[1]),
        simd.neg_f64s(a[2]),
    ]
}

/// `a . b + c`.
#[inline(always)]
pub(crate) fn dot_add<S: Simd>(simd: S, a: Wide3<S>, b: Wide3<S>, c: S::f64s) -> S::f64s {
    let sum = simd.mul_add_e_f64s(a[0], b[0], c);
    let sum = simd.mul_add_e_f64s(a[1], b[1], sum);
    simd.mul_add_e_f64s(a[2], b[2], sum)
}

/// `M v + c`.
#[inline(always)]
pub(crate) fn mul_add<S: Simd>(simd: S, m: &WideMatrix<S>, v: Wide3<S>, c: Wide3<S>) -> Wide3<S> {
    [
        dot_add(simd, m[0], v, c[0]),
        dot_add(simd, m[1], v, c[1]),
        dot_add(simd, m[2], v, c[2]),
    ]
}

/// `M v`.
#[inline(always)]
pub(crate) fn mul<S: Simd>(simd: S, m: &WideMatrix<S>, v: Wide3<S>) -> Wide3<S> {
    mul_add(simd, m, v, [simd.splat_f64s(0.0); 3])
}

/// The transposed matrix.
#[inline(always)]
pub(crate) fn transpose<S: Simd>(m: &WideMatrix<S>) -> WideMatrix<S> {
    [
        [m[0][0], m[1][0], m[2][0]],
        [m[0][1], m[1][1], m[2][1]],
        [m[0][2], m[1][2], m[2][2]],
    ]
}

/// `p* q`: the rotation `q` as seen from the body `p`.
#[inline(always)]
pub(crate) fn relative<S: Simd>(simd: S, p: [S::f64s; 4], q: [S::f64s; 4]) -> [S::f64s; 4] {
    let ([pw, px, py, pz], [qw, qx, qy, qz]) = (p, q);
    let zero = simd.splat_f64s(0.0);
    let w = simd.mul_f64s(pw, qw);
    let (p, q) = ([px, py, pz], [qx, qy, qz]);
    // The imaginary part is pw q - qw p - p x q.
    let along = sub(simd, scale(simd, q, pw), scale(simd, p, qw));
    let [x, y, z] = cross_add(simd, q, p, along);
    [simd.add_f64s(w, dot_add(simd, p, q, zero)), x, y, z]
}

/// The matrices of unit quaternions.
#[inline(always)]
pub(crate) fn matrix<S: Simd>(simd: S, q: [S::f64s; 4]) -> WideMatrix<S> {
    let [w, x, y, z] = q;
    let (one, two) = (simd.splat_f64s(1.0), simd.splat_f64s(2.0));
    let (x2, y2, z2) = (
        simd.mul_f64s(two, x),
        simd.mul_f64s(two, y),
        simd.mul_f64s(two, z),
    );
    let (xy, xz, yz) = (
        simd.mul_f64s(x2, y),
        simd.mul_f64s(x2, z),
        simd.mul_f64s(y2, z),
    );
    let (without_x, without_y) = (less(simd, x2, x, one), less(simd, y2, y, one));
    [
        [
            less(simd, z2, z, without_y),
            less(simd, z2, w, xy),
            more(simd, y2, w, xz),
        ],
        [
            more(simd, z2, w, xy),
            less(simd, z2, z, without_x),
            less(simd, x2, w, yz),
        ],
        [
            less(simd, y2, w, xz),
            more(simd, x2, w, yz),
            less(simd, y2, y, without_x),
        ],
    ]
}

/// `c + a b`.
#[inline(always)]
fn more<S: Simd>(simd: S, a: S::f64s, b: S::f64s, c: S::f64s) -> S::f64s {
    simd.mul_add_e_f64s(a, b, c)
}

/// `c - a b`.
#[inline(always)]
fn less<S: Simd>(simd: S, a: S::f64s, b: S::f64s, c: S::f64s) -> S::f64s {
    simd.negate_mul_add_e_f64s(a, b, c)
}

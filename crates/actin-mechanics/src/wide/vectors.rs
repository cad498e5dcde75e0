//! Vectors and matrices of several bodies, and functions to load and store them.

use super::MOST_LANES;
use crate::{Quaternions, Vector3, Vectors};
use pulp::Simd;
use std::ops::Range;

/// Vectors of several bodies.
pub type Wide3<S> = [<S as Simd>::f64s; 3];

/// Rotation matrices of several bodies, row by row.
pub type WideMatrix<S> = [Wide3<S>; 3];

/// Loads the numbers at `range`, at most one per lane, padded with zeros.
#[inline(always)]
pub fn load<S: Simd>(simd: S, values: &[f64], range: &Range<usize>) -> S::f64s {
    let values = &values[range.clone()];
    match S::as_simd_f64s(values).0 {
        [all] => *all,
        _ => simd.partial_load_f64s(values),
    }
}

/// Reads the group of lanes with the index `place`.
#[inline(always)]
pub fn read<S: Simd, const N: usize>(simd: S, numbers: &[f64; N], place: usize) -> S::f64s {
    match S::as_simd_f64s(numbers).0.get(place) {
        Some(lanes) => *lanes,
        None => simd.partial_load_f64s(numbers),
    }
}

/// Replaces the numbers returned by [`read`].
#[inline(always)]
pub fn write<S: Simd, const N: usize>(
    simd: S,
    numbers: &mut [f64; N],
    place: usize,
    values: S::f64s,
) {
    match S::as_mut_simd_f64s(numbers).0.get_mut(place) {
        Some(lanes) => *lanes = values,
        None => simd.partial_store_f64s(numbers, values),
    }
}

/// Equal vectors in all lanes.
#[inline(always)]
pub fn splat<S: Simd>(simd: S, v: Vector3) -> Wide3<S> {
    [
        simd.splat_f64s(v.x),
        simd.splat_f64s(v.y),
        simd.splat_f64s(v.z),
    ]
}

/// A vector in one lane, zero in the others.
#[inline(always)]
pub fn in_lane<S: Simd>(simd: S, lane: usize, v: Vector3) -> Wide3<S> {
    let mut lanes = [[0.0; MOST_LANES]; 3];
    lanes[0][lane] = v.x;
    lanes[1][lane] = v.y;
    lanes[2][lane] = v.z;
    [
        read(simd, &lanes[0], 0),
        read(simd, &lanes[1], 0),
        read(simd, &lanes[2], 0),
    ]
}

/// Vector of one lane.
#[inline(always)]
pub fn lane<S: Simd>(simd: S, lane: usize, vectors: Wide3<S>) -> Vector3 {
    let mut lanes = [[0.0; MOST_LANES]; 3];
    for (lanes, component) in lanes.iter_mut().zip(vectors) {
        write(simd, lanes, 0, component);
    }
    Vector3::new(lanes[0][lane], lanes[1][lane], lanes[2][lane])
}

/// Loads the vectors at `range`.
#[inline(always)]
pub fn load3<S: Simd>(simd: S, vectors: &Vectors, range: &Range<usize>) -> Wide3<S> {
    [
        load(simd, &vectors.x, range),
        load(simd, &vectors.y, range),
        load(simd, &vectors.z, range),
    ]
}

/// Loads the quaternions at `range`, scalar part first.
#[inline(always)]
pub fn load_quaternions<S: Simd>(simd: S, q: &Quaternions, range: &Range<usize>) -> [S::f64s; 4] {
    [
        load(simd, &q.w, range),
        load(simd, &q.x, range),
        load(simd, &q.y, range),
        load(simd, &q.z, range),
    ]
}

/// `a + b`.
#[inline(always)]
pub fn add<S: Simd>(simd: S, a: Wide3<S>, b: Wide3<S>) -> Wide3<S> {
    [
        simd.add_f64s(a[0], b[0]),
        simd.add_f64s(a[1], b[1]),
        simd.add_f64s(a[2], b[2]),
    ]
}

/// `a - b`.
#[inline(always)]
pub fn sub<S: Simd>(simd: S, a: Wide3<S>, b: Wide3<S>) -> Wide3<S> {
    [
        simd.sub_f64s(a[0], b[0]),
        simd.sub_f64s(a[1], b[1]),
        simd.sub_f64s(a[2], b[2]),
    ]
}

/// Componentwise product of `a` and `b`.
#[inline(always)]
pub fn mul_each<S: Simd>(simd: S, a: Wide3<S>, b: Wide3<S>) -> Wide3<S> {
    [
        simd.mul_f64s(a[0], b[0]),
        simd.mul_f64s(a[1], b[1]),
        simd.mul_f64s(a[2], b[2]),
    ]
}

/// `a s` for scalars `s`.
#[inline(always)]
pub fn scale<S: Simd>(simd: S, a: Wide3<S>, s: S::f64s) -> Wide3<S> {
    [
        simd.mul_f64s(a[0], s),
        simd.mul_f64s(a[1], s),
        simd.mul_f64s(a[2], s),
    ]
}

/// `a s + c` for scalars `s`.
#[inline(always)]
pub fn scale_add<S: Simd>(simd: S, a: Wide3<S>, s: S::f64s, c: Wide3<S>) -> Wide3<S> {
    [
        simd.mul_add_e_f64s(a[0], s, c[0]),
        simd.mul_add_e_f64s(a[1], s, c[1]),
        simd.mul_add_e_f64s(a[2], s, c[2]),
    ]
}

/// `a x b`.
#[inline(always)]
pub fn cross<S: Simd>(simd: S, a: Wide3<S>, b: Wide3<S>) -> Wide3<S> {
    let product =
        |i: usize, j: usize| simd.negate_mul_add_e_f64s(a[j], b[i], simd.mul_f64s(a[i], b[j]));
    [product(1, 2), product(2, 0), product(0, 1)]
}

/// `a x b + c`.
#[inline(always)]
pub fn cross_add<S: Simd>(simd: S, a: Wide3<S>, b: Wide3<S>, c: Wide3<S>) -> Wide3<S> {
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
pub fn neg<S: Simd>(simd: S, a: Wide3<S>) -> Wide3<S> {
    [
        simd.neg_f64s(a[0]),
        simd.neg_f64s(a[1]),
        simd.neg_f64s(a[2]),
    ]
}

/// `a . b`.
#[inline(always)]
pub(crate) fn dot<S: Simd>(simd: S, a: Wide3<S>, b: Wide3<S>) -> S::f64s {
    let sum = simd.mul_f64s(a[0], b[0]);
    let sum = simd.mul_add_e_f64s(a[1], b[1], sum);
    simd.mul_add_e_f64s(a[2], b[2], sum)
}

/// `a . b + c`.
#[inline(always)]
pub fn dot_add<S: Simd>(simd: S, a: Wide3<S>, b: Wide3<S>, c: S::f64s) -> S::f64s {
    let sum = simd.mul_add_e_f64s(a[0], b[0], c);
    let sum = simd.mul_add_e_f64s(a[1], b[1], sum);
    simd.mul_add_e_f64s(a[2], b[2], sum)
}

/// `M v + c`.
#[inline(always)]
pub fn mul_add<S: Simd>(simd: S, m: &WideMatrix<S>, v: Wide3<S>, c: Wide3<S>) -> Wide3<S> {
    [
        dot_add(simd, m[0], v, c[0]),
        dot_add(simd, m[1], v, c[1]),
        dot_add(simd, m[2], v, c[2]),
    ]
}

/// `M v`.
#[inline(always)]
pub fn mul<S: Simd>(simd: S, m: &WideMatrix<S>, v: Wide3<S>) -> Wide3<S> {
    [dot(simd, m[0], v), dot(simd, m[1], v), dot(simd, m[2], v)]
}

/// Transpose of the matrices.
#[inline(always)]
pub fn transpose<S: Simd>(m: &WideMatrix<S>) -> WideMatrix<S> {
    [
        [m[0][0], m[1][0], m[2][0]],
        [m[0][1], m[1][1], m[2][1]],
        [m[0][2], m[1][2], m[2][2]],
    ]
}

/// `c + a b`.
#[inline(always)]
pub(super) fn more<S: Simd>(simd: S, a: S::f64s, b: S::f64s, c: S::f64s) -> S::f64s {
    simd.mul_add_e_f64s(a, b, c)
}

/// `c - a b`.
#[inline(always)]
pub(super) fn less<S: Simd>(simd: S, a: S::f64s, b: S::f64s, c: S::f64s) -> S::f64s {
    simd.negate_mul_add_e_f64s(a, b, c)
}

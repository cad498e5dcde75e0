//! Unit quaternions of several bodies, and their logarithms.

use super::MOST_LANES;
use super::functions::{JACOBIAN, SMALL_JACOBIAN, TWICE_ARCSINE, TWICE_SMALL_ARCSINE, polynomial};
use super::vectors::{
    Wide3, WideMatrix, add, cross, cross_add, dot, dot_add, less, more, read, scale, scale_add,
    write,
};
use crate::{UnitQuaternion, rotation};
use nalgebra::{Quaternion, Unit};
use pulp::Simd;

/// Upper limit of the squared sine of half the angle for polynomials: angles up to pi/3.
const LARGEST_SQUARED_SINE: f64 = 0.25;
/// Upper limit for short polynomials: angles up to a quarter of a radian.
const LARGEST_SMALL: f64 = 1.0 / 64.0;

/// Quaternions, scalar part first.
pub type WideQuaternion<S> = [<S as Simd>::f64s; 4];

/// Product `p q`.
#[inline(always)]
pub(crate) fn product<S: Simd>(
    simd: S,
    p: WideQuaternion<S>,
    q: WideQuaternion<S>,
) -> WideQuaternion<S> {
    let ([pw, px, py, pz], [qw, qx, qy, qz]) = (p, q);
    let (p, q) = ([px, py, pz], [qx, qy, qz]);
    let [x, y, z] = cross_add(simd, p, q, scale_add(simd, q, pw, scale(simd, p, qw)));
    let w = simd.negate_mul_add_e_f64s(px, qx, simd.mul_f64s(pw, qw));
    let w = simd.negate_mul_add_e_f64s(py, qy, w);
    [simd.negate_mul_add_e_f64s(pz, qz, w), x, y, z]
}

/// Product `p q` for a rotation `q = (w, 0, 0, z)` about the third axis.
#[inline(always)]
pub(crate) fn product_about_z<S: Simd>(
    simd: S,
    [pw, px, py, pz]: WideQuaternion<S>,
    [w, z]: [S::f64s; 2],
) -> WideQuaternion<S> {
    [
        less(simd, pz, z, simd.mul_f64s(pw, w)),
        more(simd, py, z, simd.mul_f64s(px, w)),
        less(simd, px, z, simd.mul_f64s(py, w)),
        more(simd, pw, z, simd.mul_f64s(pz, w)),
    ]
}

/// `c - a s` for scalars `s`.
#[inline(always)]
fn scale_sub<S: Simd>(simd: S, a: Wide3<S>, s: S::f64s, c: Wide3<S>) -> Wide3<S> {
    [
        less(simd, a[0], s, c[0]),
        less(simd, a[1], s, c[1]),
        less(simd, a[2], s, c[2]),
    ]
}

/// Relative rotation `p* q`.
#[inline(always)]
pub fn relative<S: Simd>(simd: S, p: WideQuaternion<S>, q: WideQuaternion<S>) -> WideQuaternion<S> {
    let ([pw, px, py, pz], [qw, qx, qy, qz]) = (p, q);
    let w = simd.mul_f64s(pw, qw);
    let (p, q) = ([px, py, pz], [qx, qy, qz]);
    // Imaginary part: pw q - qw p - p x q.
    let along = scale_sub(simd, p, qw, scale(simd, q, pw));
    let [x, y, z] = cross_add(simd, q, p, along);
    [dot_add(simd, p, q, w), x, y, z]
}

/// Rotation matrices of unit quaternions.
#[inline(always)]
pub fn matrix<S: Simd>(simd: S, q: WideQuaternion<S>) -> WideMatrix<S> {
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

/// `Q v = v + 2 w u x v + 2 u x (u x v)`, where `Q` is the rotation of `q` and `u` its imaginary
/// part.
#[inline(always)]
pub fn turn<S: Simd>(simd: S, [w, x, y, z]: WideQuaternion<S>, v: Wide3<S>) -> Wide3<S> {
    let u = [x, y, z];
    let twice = cross(simd, add(simd, u, u), v);
    cross_add(simd, u, twice, scale_add(simd, twice, w, v))
}

/// `Q^T v`, the components of `v` in a body with orientation `q`.
#[inline(always)]
pub fn turn_back<S: Simd>(simd: S, [w, x, y, z]: WideQuaternion<S>, v: Wide3<S>) -> Wide3<S> {
    let u = [x, y, z];
    let twice = cross(simd, add(simd, u, u), v);
    cross_add(simd, u, twice, scale_sub(simd, twice, w, v))
}

/// Rotation vectors (rad) of unit quaternions, and the coefficients of their inverse Jacobians.
///
/// Accurate to round-off. Angles above pi/3 are computed by the references, [`rotation::log`] and
/// [`rotation::inverse_jacobian_coefficient`]. The result of a lane depends on its angle alone.
#[inline(always)]
pub fn log_with_coefficient<S: Simd>(simd: S, q: WideQuaternion<S>) -> (Wide3<S>, S::f64s) {
    let v = [q[1], q[2], q[3]];
    let u = dot(simd, v, v);
    let largest = simd.reduce_max_f64s(u);
    let small = log_by(simd, q, u, (&TWICE_SMALL_ARCSINE, &SMALL_JACOBIAN));
    if largest <= LARGEST_SMALL {
        return small;
    }
    let limit = simd.splat_f64s(LARGEST_SMALL);
    let is_small = simd.less_than_or_equal_f64s(u, limit);
    let other = log_by(simd, q, u, (&TWICE_ARCSINE, &JACOBIAN));
    let found = select(simd, is_small, small, other);
    if largest <= LARGEST_SQUARED_SINE {
        return found;
    }
    let limit = simd.splat_f64s(LARGEST_SQUARED_SINE);
    let is_known = simd.less_than_or_equal_f64s(u, limit);
    select(simd, is_known, found, log_of_any(simd, q))
}

/// Rotation vector and coefficient by polynomials in `u`, the squared sine of half the angle, and
/// in the squared angle.
#[inline(always)]
fn log_by<S: Simd, const N: usize, const M: usize>(
    simd: S,
    [w, x, y, z]: WideQuaternion<S>,
    u: S::f64s,
    (arcsine, jacobian): (&[f64; N], &[f64; M]),
) -> (Wide3<S>, S::f64s) {
    let factor = polynomial(simd, arcsine, u);
    let negative = simd.less_than_f64s(w, simd.splat_f64s(0.0));
    let signed = simd.select_f64s(negative, simd.neg_f64s(factor), factor);
    let squared = simd.mul_f64s(u, simd.mul_f64s(factor, factor));
    let coefficient = polynomial(simd, jacobian, squared);
    (scale(simd, [x, y, z], signed), coefficient)
}

#[inline(always)]
fn select<S: Simd>(
    simd: S,
    mask: S::m64s,
    (v, c): (Wide3<S>, S::f64s),
    (other, d): (Wide3<S>, S::f64s),
) -> (Wide3<S>, S::f64s) {
    let chosen = [
        simd.select_f64s(mask, v[0], other[0]),
        simd.select_f64s(mask, v[1], other[1]),
        simd.select_f64s(mask, v[2], other[2]),
    ];
    (chosen, simd.select_f64s(mask, c, d))
}

#[inline(always)]
fn log_of_any<S: Simd>(simd: S, q: WideQuaternion<S>) -> (Wide3<S>, S::f64s) {
    let mut lanes = [[0.0; MOST_LANES]; 4];
    for (lanes, component) in lanes.iter_mut().zip(q) {
        write(simd, lanes, 0, component);
    }
    let [x, y, z, c] = log_of_each(&lanes);
    let theta = [read(simd, &x, 0), read(simd, &y, 0), read(simd, &z, 0)];
    (theta, read(simd, &c, 0))
}

#[cold]
#[inline(never)]
fn log_of_each(q: &[[f64; MOST_LANES]; 4]) -> [[f64; MOST_LANES]; 4] {
    let mut logs = [[0.0; MOST_LANES]; 4];
    for lane in 0..MOST_LANES {
        let [w, x, y, z] = q.map(|component| component[lane]);
        let q: UnitQuaternion = Unit::new_unchecked(Quaternion::new(w, x, y, z));
        let theta = rotation::log(q);
        let c = rotation::inverse_jacobian_coefficient(theta.norm_squared());
        for (log, value) in logs.iter_mut().zip([theta.x, theta.y, theta.z, c]) {
            log[lane] = value;
        }
    }
    logs
}

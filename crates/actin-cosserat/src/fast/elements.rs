//! Segments and bending elements of both kernels.
#![allow(
    clippy::inline_always,
    reason = "vector code must be compiled into the function that enables the instructions"
)]

use super::laws::Law;
use actin_mechanics::wide::{self, Columns, ColumnsMut, Simd, Wide3, WideQuaternion};
use actin_mechanics::{Quaternions, Vectors};
use std::ops::Range;

#[derive(Clone, Copy)]
pub(super) struct Segments<S: Simd> {
    q: WideQuaternion<S>,
    /// Vector from node to node (nm, body axes).
    body: Wide3<S>,
    sigma: Wide3<S>,
    /// Inverse rest length (1/nm).
    inverse: S::f64s,
    /// Factor of the shear strains.
    across: S::f64s,
}

impl<S: Simd> Segments<S> {
    /// `length` and `inverse` are zero in lanes without a segment.
    #[inline(always)]
    pub(super) fn new(
        simd: S,
        q: WideQuaternion<S>,
        l: Wide3<S>,
        [length, inverse]: [S::f64s; 2],
    ) -> Self {
        let body = wide::turn_back(simd, q, l);
        let [x, y, z] = body;
        let sigma = wide::scale(simd, [x, y, simd.sub_f64s(z, length)], inverse);
        Self {
            q,
            body,
            sigma,
            inverse,
            across: simd.splat_f64s(1.0),
        }
    }

    #[inline(always)]
    pub(super) fn count_shear(&mut self, simd: S, factor: S::f64s) {
        let [x, y, z] = self.sigma;
        self.sigma = [simd.mul_f64s(x, factor), simd.mul_f64s(y, factor), z];
        self.across = factor;
    }

    /// Forces on first nodes (pN), torques (pN nm), and conjugates of the mean curvature `kappa`
    /// (pN nm).
    #[inline(always)]
    pub(super) fn loads<L: Law>(&self, simd: S, law: &L, kappa: Wide3<S>) -> [Wide3<S>; 3] {
        let [n, couple] = law.segment(simd, self.sigma, kappa);
        let n = if L::COUPLES {
            self.existing(simd, n)
        } else {
            n
        };
        let n = if L::COVERS {
            self.answering(simd, n)
        } else {
            n
        };
        let force = wide::turn(simd, self.q, n);
        [force, wide::cross(simd, self.body, n), couple]
    }

    /// Transverse forces conjugate to the strains without factor.
    #[inline(always)]
    fn answering(&self, simd: S, [x, y, z]: Wide3<S>) -> Wide3<S> {
        [
            simd.mul_f64s(x, self.across),
            simd.mul_f64s(y, self.across),
            z,
        ]
    }

    /// Zero in lanes without a segment, where a natural extension would cause a force.
    #[inline(always)]
    fn existing(&self, simd: S, n: Wide3<S>) -> Wide3<S> {
        where_there_is(simd, self.inverse, n)
    }
}

/// Zero in lanes without an element, whose inverse length is zero.
#[inline(always)]
pub(super) fn where_there_is<S: Simd>(simd: S, inverse: S::f64s, v: Wide3<S>) -> Wide3<S> {
    let zero = simd.splat_f64s(0.0);
    let exists = simd.greater_than_f64s(inverse, zero);
    v.map(|component| simd.select_f64s(exists, component, zero))
}

/// Torques on the first frames of bending elements and against the second ones, at the torque `m`
/// (pN nm).
#[inline(always)]
pub(super) fn bending_torques<S: Simd>(
    simd: S,
    theta: Wide3<S>,
    coefficient: S::f64s,
    m: Wide3<S>,
) -> [Wide3<S>; 2] {
    let cross = wide::cross(simd, theta, m);
    let even = wide::scale_add(simd, wide::cross(simd, theta, cross), coefficient, m);
    let half = simd.splat_f64s(0.5);
    let against_second = [
        simd.negate_mul_add_e_f64s(cross[0], half, even[0]),
        simd.negate_mul_add_e_f64s(cross[1], half, even[1]),
        simd.negate_mul_add_e_f64s(cross[2], half, even[2]),
    ];
    [wide::scale_add(simd, cross, half, even), against_second]
}

#[inline(always)]
pub(super) fn vectors<S: Simd>(v: &Vectors, range: Range<usize>) -> Columns<'_, S, 3> {
    Columns::new([&v.x, &v.y, &v.z].map(|component| &component[range.clone()]))
}

#[inline(always)]
pub(super) fn vectors_mut<S: Simd>(v: &mut Vectors, range: Range<usize>) -> ColumnsMut<'_, S, 3> {
    ColumnsMut::new([&mut v.x, &mut v.y, &mut v.z].map(|component| &mut component[range.clone()]))
}

#[inline(always)]
pub(super) fn quaternions<S: Simd>(q: &Quaternions, range: Range<usize>) -> Columns<'_, S, 4> {
    Columns::new([&q.w, &q.x, &q.y, &q.z].map(|component| &component[range.clone()]))
}

//! Vector kernel of free rotation, with one symmetric top per lane.
#![allow(
    clippy::inline_always,
    reason = "vector code must be compiled into the function that enables the instructions"
)]

use super::{Frames, Inertias};
use crate::wide::{self, Columns, ColumnsMut, Simd, Wide3, WideQuaternion, WithSimd};

#[derive(Debug)]
pub(super) struct Drift<'a> {
    pub(super) frames: &'a mut Frames,
    pub(super) h: f64,
}

impl WithSimd for Drift<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        if self.frames.inertias.off_z {
            self.turn_about_any(simd);
        } else {
            self.turn_about_z(simd);
        }
    }
}

impl Drift<'_> {
    #[inline(always)]
    fn turn_about_any<S: Simd>(self, simd: S) {
        let Frames {
            orientation: q,
            angular_momentum: l,
            inertias,
        } = self.frames;
        let Inertias {
            inverse_transverse,
            excess,
            ..
        } = &**inertias;
        let mut q = ColumnsMut::<S, 4>::new([&mut q.w, &mut q.x, &mut q.y, &mut q.z]);
        let mut l = ColumnsMut::<S, 3>::new([&mut l.x, &mut l.y, &mut l.z]);
        let inertia = Columns::<S, 4>::new([inverse_transverse, &excess.x, &excess.y, &excess.z]);
        let half = simd.splat_f64s(0.5 * self.h);
        for group in 0..q.groups() {
            let [transverse, ex, ey, ez] = inertia.get(simd, group);
            let momentum = l.get(simd, group);
            let precession = wide::scale(simd, momentum, simd.mul_f64s(half, transverse));
            let spin = wide::mul_each(simd, wide::scale(simd, momentum, half), [ex, ey, ez]);
            let [precession, spin] = turns(simd, [precession, spin]);
            let turn = wide::product(simd, precession, spin);
            let turned = wide::product(simd, q.get(simd, group), turn);
            q.set(simd, group, to_unit_length(simd, turned));
            l.set(simd, group, wide::turn_back(simd, spin, momentum));
        }
    }

    /// Free rotation of tops whose symmetry axis is the third body axis, such as rod segments, in
    /// fewer operations.
    #[inline(always)]
    fn turn_about_z<S: Simd>(self, simd: S) {
        let n = self.frames.len();
        let Frames {
            orientation: q,
            angular_momentum: l,
            inertias,
        } = self.frames;
        let [qw, qx, qy, qz] = [&mut q.w, &mut q.x, &mut q.y, &mut q.z];
        let [lx, ly, lz] = [&mut l.x, &mut l.y, &mut l.z];
        let (inverse, excess) = (&inertias.inverse_transverse, &inertias.excess.z);
        let mut tops = TopsAboutZ {
            q: ColumnsMut::new([&mut qw[..n], &mut qx[..n], &mut qy[..n], &mut qz[..n]]),
            l: ColumnsMut::new([&mut lx[..n], &mut ly[..n], &mut lz[..n]]),
            inertia: Columns::new([&inverse[..n], &excess[..n]]),
            half: simd.splat_f64s(0.5 * self.h),
        };
        // Full groups have a separate loop, in which the compiler can prove the bounds.
        for group in 0..n / S::F64_LANES {
            tops.turn(simd, group);
        }
        if !n.is_multiple_of(S::F64_LANES) {
            tops.turn(simd, n / S::F64_LANES);
        }
    }
}

struct TopsAboutZ<'a, S: Simd> {
    q: ColumnsMut<'a, S, 4>,
    l: ColumnsMut<'a, S, 3>,
    /// Inverse transverse moment, and the excess of the inverse axial moment over it.
    inertia: Columns<'a, S, 2>,
    half: S::f64s,
}

impl<S: Simd> TopsAboutZ<'_, S> {
    #[inline(always)]
    fn turn(&mut self, simd: S, group: usize) {
        let [transverse, excess] = self.inertia.get(simd, group);
        let momentum = self.l.get(simd, group);
        let precession = wide::scale(simd, momentum, simd.mul_f64s(self.half, transverse));
        let spin = simd.mul_f64s(simd.mul_f64s(self.half, excess), momentum[2]);
        let squared = [
            wide::dot(simd, precession, precession),
            simd.mul_f64s(spin, spin),
        ];
        let [[c, s], [cosine, sinc]] = wide::cosine_and_sinc(simd, squared);
        let [x, y, z] = wide::scale(simd, precession, s);
        let spin = [cosine, simd.mul_f64s(sinc, spin)];
        let turn = wide::product_about_z(simd, [c, x, y, z], spin);
        let turned = wide::product(simd, self.q.get(simd, group), turn);
        self.q.set(simd, group, to_unit_length(simd, turned));
        self.l
            .set(simd, group, turn_back_about_z(simd, spin, momentum));
    }
}

/// Quaternions of the rotation vectors `2 half` (rad).
#[inline(always)]
fn turns<S: Simd>(simd: S, half: [Wide3<S>; 2]) -> [WideQuaternion<S>; 2] {
    let squared = [
        wide::dot(simd, half[0], half[0]),
        wide::dot(simd, half[1], half[1]),
    ];
    let [[c0, s0], [c1, s1]] = wide::cosine_and_sinc(simd, squared);
    let [x0, y0, z0] = wide::scale(simd, half[0], s0);
    let [x1, y1, z1] = wide::scale(simd, half[1], s1);
    [[c0, x0, y0, z0], [c1, x1, y1, z1]]
}

/// `q` renormalised to first order.
#[inline(always)]
fn to_unit_length<S: Simd>(simd: S, q: WideQuaternion<S>) -> WideQuaternion<S> {
    let [w, x, y, z] = q;
    let v = [x, y, z];
    let squared = wide::dot_add(simd, v, v, simd.mul_f64s(w, w));
    let minus_half = simd.splat_f64s(-0.5);
    let correction = simd.mul_add_e_f64s(minus_half, squared, simd.splat_f64s(1.5));
    let [x, y, z] = wide::scale(simd, v, correction);
    [simd.mul_f64s(w, correction), x, y, z]
}

/// Components of `l` after a rotation of the body by `(w, 0, 0, z)`.
#[inline(always)]
fn turn_back_about_z<S: Simd>(simd: S, [w, z]: [S::f64s; 2], [x, y, along]: Wide3<S>) -> Wide3<S> {
    let twice = simd.add_f64s(z, z);
    let sine = simd.mul_f64s(twice, w);
    let cosine = simd.negate_mul_add_e_f64s(twice, z, simd.splat_f64s(1.0));
    [
        simd.mul_add_e_f64s(sine, y, simd.mul_f64s(cosine, x)),
        simd.negate_mul_add_e_f64s(sine, x, simd.mul_f64s(cosine, y)),
        along,
    ]
}

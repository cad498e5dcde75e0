//! Inner loop of the second derivatives.
#![allow(
    clippy::inline_always,
    reason = "vector code must be compiled into the function that enables the instructions"
)]

use crate::kernel::{Ends, GUARD, place_of};
use crate::table::{GROUP, Group, Relative};
use actin_mechanics::wide::{self, Simd, Wide3, WideMatrix, WithSimd};

type Lanes = [f64; GROUP];

/// Upper bodies of a group of pairs in the frames of the lower ones.
#[derive(Debug, Default)]
pub(crate) struct Relatives {
    rotation: [[Lanes; 3]; 3],
    offset: [Lanes; 3],
}

/// Sums over the bonds of each pair of a group, in the frame of the lower body.
///
/// `a` and `y` are the ends, `u` the unit vector from `a` to `y`, `r` the distance and `L` the rest
/// length. Terms are multiplied by the weights, if any.
#[derive(Debug, Default)]
pub(crate) struct Sums {
    /// `L/r q q^T` with `q = (u, a x u)`, upper triangle.
    lines: [[Lanes; 6]; 6],
    /// `(1 - L/r) (1, a) (1, y)^T`.
    ends: [[Lanes; 4]; 4],
}

#[derive(Debug)]
pub(crate) struct PairSums {
    pub(crate) lines: [[f64; 6]; 6],
    pub(crate) ends: [[f64; 4]; 4],
}

#[derive(Debug)]
pub(crate) struct SumBonds<'a> {
    pub(crate) relatives: &'a Relatives,
    pub(crate) group: Group<'a>,
    pub(crate) sums: &'a mut Sums,
}

#[derive(Clone, Copy, Debug)]
struct WideSums<S: Simd> {
    lines: [[S::f64s; 6]; 6],
    ends: [[S::f64s; 4]; 4],
}

impl Relatives {
    pub(crate) fn set(&mut self, lane: usize, relative: &Relative) {
        for i in 0..3 {
            for j in 0..3 {
                self.rotation[i][j][lane] = relative.rotation[(i, j)];
            }
            self.offset[i][lane] = relative.offset[i];
        }
    }

    #[inline(always)]
    pub(crate) fn read<S: Simd>(&self, simd: S, place: usize) -> (WideMatrix<S>, Wide3<S>) {
        let read = |lanes| wide::read(simd, lanes, place);
        let rows = self.rotation.each_ref();
        let rotation = rows.map(|row| row.each_ref().map(read));
        (rotation, self.offset.each_ref().map(read))
    }
}

impl Sums {
    pub(crate) fn of(&self, lane: usize) -> PairSums {
        PairSums {
            lines: self.lines.map(|row| row.map(|lanes| lanes[lane])),
            ends: self.ends.map(|row| row.map(|lanes| lanes[lane])),
        }
    }
}

impl WithSimd for SumBonds<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for first in (0..GROUP).step_by(S::F64_LANES.min(GROUP)) {
            let place = place_of::<S>(first);
            let (rotation, offset) = self.relatives.read(simd, place);
            let sums = sum_bonds(simd, &rotation, offset, self.group, place);
            for (row, values) in self.sums.lines.iter_mut().zip(sums.lines) {
                for (lanes, value) in row.iter_mut().zip(values) {
                    wide::write(simd, lanes, place, value);
                }
            }
            for (row, values) in self.sums.ends.iter_mut().zip(sums.ends) {
                for (lanes, value) in row.iter_mut().zip(values) {
                    wide::write(simd, lanes, place, value);
                }
            }
        }
    }
}

#[inline(always)]
fn sum_bonds<S: Simd>(
    simd: S,
    rotation: &WideMatrix<S>,
    offset: Wide3<S>,
    Group { records, weights }: Group<'_>,
    place: usize,
) -> WideSums<S> {
    let (zero, one) = (simd.splat_f64s(0.0), simd.splat_f64s(1.0));
    let guard = simd.splat_f64s(GUARD);
    let mut sums = WideSums::<S> {
        lines: [[zero; 6]; 6],
        ends: [[zero; 4]; 4],
    };
    for (k, record) in records.iter().enumerate() {
        let Ends { a, b, length } = Ends::read(simd, record, place);
        let weight = weights.get(k).map(|lanes| wide::read(simd, lanes, place));
        let weighted = |x| weight.map_or(x, |weight| simd.mul_f64s(x, weight));
        let y = wide::mul_add(simd, rotation, b, offset);
        let d = wide::sub(simd, y, a);
        let squared = wide::dot_add(simd, d, d, guard);
        let inverse = simd.div_f64s(one, simd.sqrt_f64s(squared));
        let share = simd.mul_f64s(length, inverse);
        let share = simd.select_f64s(simd.greater_than_f64s(squared, guard), share, zero);
        let [ux, uy, uz] = wide::scale(simd, d, inverse);
        let [mx, my, mz] = wide::cross_add(simd, a, [ux, uy, uz], [zero; 3]);
        let lines = [ux, uy, uz, mx, my, mz];
        add_outer(simd, &mut sums.lines, weighted(share), lines);
        let rest = simd.sub_f64s(one, share);
        add_ends(simd, &mut sums.ends, weighted(rest), a, y);
    }
    sums
}

#[inline(always)]
fn add_outer<S: Simd>(simd: S, sum: &mut [[S::f64s; 6]; 6], s: S::f64s, q: [S::f64s; 6]) {
    for i in 0..6 {
        let scaled = simd.mul_f64s(s, q[i]);
        for j in i..6 {
            sum[i][j] = simd.mul_add_e_f64s(scaled, q[j], sum[i][j]);
        }
    }
}

#[inline(always)]
fn add_ends<S: Simd>(simd: S, sum: &mut [[S::f64s; 4]; 4], s: S::f64s, a: Wide3<S>, y: Wide3<S>) {
    let [ax, ay, az] = wide::scale(simd, a, s);
    for (row, factor) in sum.iter_mut().zip([s, ax, ay, az]) {
        row[0] = simd.add_f64s(row[0], factor);
        for j in 0..3 {
            row[j + 1] = simd.mul_add_e_f64s(factor, y[j], row[j + 1]);
        }
    }
}

//! The two loops, over nodes and over frames; `mod.rs` has the formulas.
#![allow(
    clippy::inline_always,
    reason = "vector code must be compiled into the function that enables the instructions"
)]

use super::ConstantRod;
use crate::RodLayout;
use actin_mechanics::wide::{self, Columns, ColumnsMut, ShiftedUp, Simd, Wide3, WithSimd};
use actin_mechanics::{Loads, Quaternions, State, Vector3, Vectors};
use std::ops::Range;

/// Both loops, to be compiled for whatever instructions the machine has.
#[derive(Debug)]
pub(super) struct AddLoads<'a> {
    pub(super) rod: &'a ConstantRod,
    pub(super) layout: &'a RodLayout,
    pub(super) state: &'a State,
    pub(super) loads: &'a mut Loads,
}

impl WithSimd for AddLoads<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        self.add_shear(simd);
        self.add_bending(simd);
    }
}

impl AddLoads<'_> {
    /// Segments: node to node, one frame each.
    #[inline(always)]
    fn add_shear<S: Simd>(&mut self, simd: S) {
        let (nodes, frames) = (self.layout.points(), self.layout.frames());
        let x = &self.state.points.position;
        let first = vectors::<S>(x, nodes.start..nodes.end - 1);
        let second = vectors::<S>(x, nodes.start + 1..nodes.end);
        let q = quaternions::<S>(&self.state.frames.orientation, frames.clone());
        let lengths = self.layout.segment_lengths();
        let lengths = Columns::<S, 2>::new([lengths, &self.rod.inverse_lengths]);
        let rigidities = splat(simd, self.rod.shear);
        let mut force = vectors_mut::<S>(&mut self.loads.force, nodes);
        let mut torque = vectors_mut::<S>(&mut self.loads.torque, frames);
        let mut reactions = ShiftedUp::new(simd);
        for group in 0..force.groups() {
            let l = wide::sub(simd, second.get(simd, group), first.get(simd, group));
            let axes = wide::matrix(simd, q.get(simd, group));
            let body = wide::transpose_mul(simd, &axes, l);
            let n = shear_force(simd, rigidities, body, lengths.get(simd, group));
            let on_first = wide::mul(simd, &axes, n);
            let on_second = reactions.next(simd, on_first);
            force.add(simd, group, wide::sub(simd, on_first, on_second));
            torque.add(simd, group, wide::cross(simd, body, n));
        }
    }

    /// Bending elements: frame to frame, walls included.
    #[inline(always)]
    fn add_bending<S: Simd>(&mut self, simd: S) {
        let chain = self.layout.bending_chain();
        let elements = self.rod.inverse_distances.len();
        let frames = chain.start..chain.start + elements + 1;
        let q = &self.state.frames.orientation;
        let first = quaternions::<S>(q, frames.start..frames.end - 1);
        let second = quaternions::<S>(q, frames.start + 1..frames.end);
        let inverse_distances = Columns::<S, 1>::new([&self.rod.inverse_distances]);
        let rigidities = splat(simd, self.rod.bend);
        let mut torque = vectors_mut::<S>(&mut self.loads.torque, frames);
        let mut reactions = ShiftedUp::new(simd);
        for group in 0..torque.groups() {
            let turn = wide::relative(simd, first.get(simd, group), second.get(simd, group));
            let [inverse_distance] = inverse_distances.get(simd, group);
            let [even, odd] = bending_couples(simd, rigidities, turn, inverse_distance);
            let on_first = wide::add(simd, even, odd);
            let on_second = reactions.next(simd, wide::sub(simd, odd, even));
            torque.add(simd, group, wide::add(simd, on_first, on_second));
        }
    }
}

/// `S (y - |lhat| e3) / |lhat|`, body axes, from `|lhat|` and its inverse, which are both zero where
/// there is no element.
#[inline(always)]
fn shear_force<S: Simd>(
    simd: S,
    rigidities: Wide3<S>,
    body: Wide3<S>,
    [length, inverse]: [S::f64s; 2],
) -> Wide3<S> {
    let [x, y, z] = body;
    let elongation = [x, y, simd.sub_f64s(z, length)];
    wide::mul_each(simd, rigidities, wide::scale(simd, elongation, inverse))
}

/// The parts of the torques of a relative turn that the two frames feel with opposite and with
/// equal sign.
#[inline(always)]
fn bending_couples<S: Simd>(
    simd: S,
    rigidities: Wide3<S>,
    turn: wide::WideQuaternion<S>,
    inverse_distance: S::f64s,
) -> [Wide3<S>; 2] {
    let (theta, coefficient) = wide::log_with_coefficient(simd, turn);
    let kappa = wide::scale(simd, theta, inverse_distance);
    let m = wide::mul_each(simd, rigidities, kappa);
    let cross = wide::cross(simd, theta, m);
    let even = wide::scale_add(simd, wide::cross(simd, theta, cross), coefficient, m);
    [even, wide::scale(simd, cross, simd.splat_f64s(0.5))]
}

#[inline(always)]
fn splat<S: Simd>(simd: S, v: Vector3) -> Wide3<S> {
    [
        simd.splat_f64s(v.x),
        simd.splat_f64s(v.y),
        simd.splat_f64s(v.z),
    ]
}

#[inline(always)]
fn vectors<S: Simd>(v: &Vectors, range: Range<usize>) -> Columns<'_, S, 3> {
    Columns::new([&v.x, &v.y, &v.z].map(|component| &component[range.clone()]))
}

#[inline(always)]
fn vectors_mut<S: Simd>(v: &mut Vectors, range: Range<usize>) -> ColumnsMut<'_, S, 3> {
    ColumnsMut::new([&mut v.x, &mut v.y, &mut v.z].map(|component| &mut component[range.clone()]))
}

#[inline(always)]
fn quaternions<S: Simd>(q: &Quaternions, range: Range<usize>) -> Columns<'_, S, 4> {
    Columns::new([&q.w, &q.x, &q.y, &q.z].map(|component| &component[range.clone()]))
}

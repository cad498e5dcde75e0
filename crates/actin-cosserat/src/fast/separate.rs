//! The two loops of a law that couples nothing: over segments, then over bending elements.
#![allow(
    clippy::inline_always,
    reason = "vector code must be compiled into the function that enables the instructions"
)]

use super::elements::{
    Segments, bending_couples, quaternions, vectors, vectors_mut, where_there_is,
};
use super::laws::Law;
use super::rod::AddLoads;
use actin_mechanics::wide::{self, Columns, ShiftedUp, Simd};

impl<L: Law> AddLoads<'_, L> {
    /// Segments: node to node, one frame each.
    #[inline(always)]
    pub(super) fn add_segments<S: Simd>(&mut self, simd: S) {
        let (nodes, frames) = (self.layout.points(), self.layout.frames());
        let x = &self.state.points.position;
        let first = vectors::<S>(x, nodes.start..nodes.end - 1);
        let second = vectors::<S>(x, nodes.start + 1..nodes.end);
        let q = quaternions::<S>(&self.state.frames.orientation, frames.clone());
        let lengths = self.rod.bodies.lengths(self.layout);
        let lengths = Columns::<S, 2>::new(lengths);
        let law = self.rod.law;
        let straight = [simd.splat_f64s(0.0); 3];
        let mut force = vectors_mut::<S>(&mut self.loads.force, nodes);
        let mut torque = vectors_mut::<S>(&mut self.loads.torque, frames);
        let mut reactions = ShiftedUp::new(simd);
        for group in 0..force.groups() {
            let l = wide::sub(simd, second.get(simd, group), first.get(simd, group));
            let q = q.get(simd, group);
            let segments = Segments::new(simd, q, l, lengths.get(simd, group));
            let [on_first, on_frame, _] = segments.loads(simd, &law, straight);
            let on_second = reactions.next(simd, on_first);
            force.add(simd, group, wide::sub(simd, on_first, on_second));
            torque.add(simd, group, on_frame);
        }
    }

    /// Bending elements: frame to frame, walls included.
    #[inline(always)]
    pub(super) fn add_bending<S: Simd>(&mut self, simd: S) {
        let frames = self.layout.bending_chain();
        let q = &self.state.frames.orientation;
        let first = quaternions::<S>(q, frames.start..frames.end - 1);
        let second = quaternions::<S>(q, frames.start + 1..frames.end);
        let inverse_distances = self.rod.bodies.inverse_distances(self.layout);
        let inverse_distances = Columns::<S, 1>::new([inverse_distances]);
        let law = self.rod.law;
        let mut torque = vectors_mut::<S>(&mut self.loads.torque, frames);
        let mut reactions = ShiftedUp::new(simd);
        for group in 0..torque.groups() {
            let turn = wide::relative(simd, first.get(simd, group), second.get(simd, group));
            let [inverse_distance] = inverse_distances.get(simd, group);
            let (theta, coefficient) = wide::log_with_coefficient(simd, turn);
            let m = law.bending(simd, wide::scale(simd, theta, inverse_distance));
            let m = if L::BENT {
                where_there_is(simd, inverse_distance, m)
            } else {
                m
            };
            let [even, odd] = bending_couples(simd, theta, coefficient, m);
            let on_first = wide::add(simd, even, odd);
            let on_second = reactions.next(simd, wide::sub(simd, odd, even));
            torque.add(simd, group, wide::add(simd, on_first, on_second));
        }
    }
}

//! Kernels of laws without coupling: separate loops over segments and bending elements.
#![allow(
    clippy::inline_always,
    reason = "vector code must be compiled into the function that enables the instructions"
)]

use super::elements::{
    Segments, bending_torques, quaternions, vectors, vectors_mut, where_there_is,
};
use super::laws::Law;
use super::rod::AddLoads;
use actin_mechanics::wide::{self, Columns, ColumnsMut, ShiftedUp, Simd};

impl<L: Law> AddLoads<'_, L> {
    #[inline(always)]
    pub(super) fn add_segments<S: Simd>(&mut self, simd: S) {
        let n = self.layout.segments();
        let (node, frame) = (self.layout.points().start, self.layout.frames().start);
        let x = &self.state.points.position;
        let mut segments = SegmentLoop {
            first: vectors(x, node..node + n),
            second: vectors(x, node + 1..node + 1 + n),
            frames: quaternions(&self.state.frames.orientation, frame..frame + n),
            lengths: Columns::new(self.rod.bodies.lengths(self.layout)),
            law: self.rod.law,
            reactions: ShiftedUp::new(simd),
            force: vectors_mut(&mut self.loads.force, node..node + n + 1),
            torque: vectors_mut(&mut self.loads.torque, frame..frame + n),
        };
        // Full groups have a separate loop, in which the compiler can prove the bounds.
        for group in 0..n / S::F64_LANES {
            segments.add(simd, group);
        }
        if n.is_multiple_of(S::F64_LANES) {
            segments.end(simd, n / S::F64_LANES);
        } else {
            segments.add(simd, n / S::F64_LANES);
        }
    }

    #[inline(always)]
    pub(super) fn add_bending<S: Simd>(&mut self, simd: S) {
        let frame = self.layout.bending_chain().start;
        let inverse_distances = self.rod.bodies.inverse_distances(self.layout);
        let n = inverse_distances.len();
        let q = &self.state.frames.orientation;
        let mut elements = BendingLoop {
            first: quaternions(q, frame..frame + n),
            second: quaternions(q, frame + 1..frame + 1 + n),
            inverse_distances: Columns::new([inverse_distances]),
            law: self.rod.law,
            reactions: ShiftedUp::new(simd),
            torque: vectors_mut(&mut self.loads.torque, frame..frame + n + 1),
        };
        for group in 0..n / S::F64_LANES {
            elements.add(simd, group);
        }
        if n.is_multiple_of(S::F64_LANES) {
            elements.end(simd, n / S::F64_LANES);
        } else {
            elements.add(simd, n / S::F64_LANES);
        }
    }
}

struct SegmentLoop<'a, S: Simd, L> {
    first: Columns<'a, S, 3>,
    second: Columns<'a, S, 3>,
    frames: Columns<'a, S, 4>,
    lengths: Columns<'a, S, 2>,
    law: L,
    /// Forces on first nodes (pN).
    reactions: ShiftedUp<S, 3>,
    force: ColumnsMut<'a, S, 3>,
    torque: ColumnsMut<'a, S, 3>,
}

impl<S: Simd, L: Law> SegmentLoop<'_, S, L> {
    #[inline(always)]
    fn add(&mut self, simd: S, group: usize) {
        let straight = [simd.splat_f64s(0.0); 3];
        let first = self.first.get(simd, group);
        let l = wide::sub(simd, self.second.get(simd, group), first);
        let q = self.frames.get(simd, group);
        let segments = Segments::new(simd, q, l, self.lengths.get(simd, group));
        let [on_first, on_frame, _] = segments.loads(simd, &self.law, straight);
        let on_second = self.reactions.next(simd, on_first);
        let force = wide::sub(simd, on_first, on_second);
        self.force.add(simd, group, force);
        self.torque.add(simd, group, on_frame);
    }

    #[inline(always)]
    fn end(&mut self, simd: S, group: usize) {
        let zero = [simd.splat_f64s(0.0); 3];
        let on_second = self.reactions.next(simd, zero);
        let force = wide::sub(simd, zero, on_second);
        self.force.add(simd, group, force);
    }
}

struct BendingLoop<'a, S: Simd, L> {
    first: Columns<'a, S, 4>,
    second: Columns<'a, S, 4>,
    inverse_distances: Columns<'a, S, 1>,
    law: L,
    /// Torques against second frames (pN nm).
    reactions: ShiftedUp<S, 3>,
    torque: ColumnsMut<'a, S, 3>,
}

impl<S: Simd, L: Law> BendingLoop<'_, S, L> {
    #[inline(always)]
    fn add(&mut self, simd: S, group: usize) {
        let (first, second) = (self.first.get(simd, group), self.second.get(simd, group));
        let turn = wide::relative(simd, first, second);
        let [inverse_distance] = self.inverse_distances.get(simd, group);
        let (theta, coefficient) = wide::log_with_coefficient(simd, turn);
        let kappa = wide::scale(simd, theta, inverse_distance);
        let m = self.law.bending(simd, kappa);
        let m = if L::BENT {
            where_there_is(simd, inverse_distance, m)
        } else {
            m
        };
        let [on_first, against_second] = bending_torques(simd, theta, coefficient, m);
        let against_second = self.reactions.next(simd, against_second);
        let torque = wide::sub(simd, on_first, against_second);
        self.torque.add(simd, group, torque);
    }

    #[inline(always)]
    fn end(&mut self, simd: S, group: usize) {
        let zero = [simd.splat_f64s(0.0); 3];
        let against_second = self.reactions.next(simd, zero);
        let torque = wide::sub(simd, zero, against_second);
        self.torque.add(simd, group, torque);
    }
}

//! Vector kernel for laws that couple the strain of segments to curvature.
#![allow(
    clippy::inline_always,
    reason = "vector code must be compiled into the function that enables the instructions"
)]

use super::elements::{
    Segments, bending_torques, quaternions, vectors, vectors_mut, where_there_is,
};
use super::ends::Ends;
use super::laws::Law;
use super::rod::AddLoads;
use super::rod::Rod;
use crate::{End, RodLayout};
use actin_mechanics::wide::{self, Columns, ShiftedDown, ShiftedUp, Simd, Wide3};
use actin_mechanics::{State, rotation};
use std::ops::Range;

impl<L: Law> AddLoads<'_, L> {
    #[inline(always)]
    pub(super) fn add_coupled<S: Simd>(&mut self, simd: S) {
        let (rod, layout, state) = (self.rod, self.layout, self.state);
        let mut ends = Ends::new(&rod.joined, state, [layout.segments(), S::F64_LANES]);
        let mut chain = Chain::new(simd, rod, layout, state);
        let mut force = vectors_mut::<S>(&mut self.loads.force, layout.points());
        let mut torque = vectors_mut::<S>(&mut self.loads.torque, frames_and_end(layout));
        let first = chain.next(simd, 0, &mut ends);
        force.add(simd, 0, first.force);
        let mut torques = first.torque;
        for group in 1..chain.groups {
            let now = chain.next(simd, group, &mut ends);
            force.add(simd, group, now.force);
            torque.add(simd, group - 1, wide::add(simd, torques, now.before));
            torques = now.torque;
        }
        if chain.groups < force.groups() {
            let zero = [simd.splat_f64s(0.0); 3];
            let on_second = chain.reactions.next(simd, zero);
            force.add(simd, chain.groups, wide::sub(simd, zero, on_second));
        }
        let rest = chain.last(simd);
        torque.add(simd, chain.groups - 1, wide::add(simd, torques, rest));
        if let Some(wall) = layout.wall(End::Start) {
            let on_wall = wide::lane(simd, S::F64_LANES - 1, first.before);
            self.loads.torque.add(wall, on_wall);
        }
        ends.add_loads(self.loads);
    }
}

struct Group<S: Simd> {
    /// Forces on nodes (pN).
    force: Wide3<S>,
    /// Torques on frames (pN nm), without the contributions of the following elements.
    torque: Wide3<S>,
    /// Torques of the elements after the frames of the preceding group.
    before: Wide3<S>,
}

struct Chain<'a, S: Simd, L> {
    law: L,
    groups: usize,
    nodes: [Columns<'a, S, 3>; 2],
    frames: [Columns<'a, S, 4>; 2],
    bodies: Columns<'a, S, 5>,
    /// Coverage of preceding elements divided by rest distance, and shear factors of segments.
    of_ends: Columns<'a, S, 2>,
    /// Angles from the next group's frames to the following ones, with Jacobian coefficients. They
    /// are computed one group ahead to hide their latency.
    ahead: [S::f64s; 4],
    /// Angles and coefficients from the preceding frames.
    angles: ShiftedUp<S, 4>,
    /// Forces on first nodes.
    reactions: ShiftedUp<S, 3>,
    /// Torques on the elements after segments.
    couples: ShiftedUp<S, 3>,
    /// Torques on first frames.
    torques: ShiftedDown<S, 3>,
}

impl<'a, S: Simd, L: Law> Chain<'a, S, L> {
    #[inline(always)]
    fn new(simd: S, rod: &'a Rod<L>, layout: &RodLayout, state: &'a State) -> Self {
        let (nodes, frames) = (layout.points(), frames_and_end(layout));
        let (x, q) = (&state.points.position, &state.frames.orientation);
        let bodies = &rod.bodies;
        let ([length, inverse], [before, after]) = (&bodies.lengths, &bodies.shares);
        let elements = layout.segments() + usize::from(layout.wall(End::End).is_some());
        let mut chain = Self {
            law: rod.law,
            groups: elements.div_ceil(S::F64_LANES),
            nodes: [
                vectors(x, nodes.start..nodes.end - 1),
                vectors(x, nodes.start + 1..nodes.end),
            ],
            frames: [
                quaternions(q, frames.clone()),
                quaternions(q, frames.start + 1..frames.end),
            ],
            bodies: Columns::new([length, inverse, &bodies.inverse_distances, before, after]),
            of_ends: Columns::new([&bodies.covers, &bodies.shear]),
            ahead: [simd.splat_f64s(0.0); 4],
            angles: ShiftedUp::after(simd, angle_at_wall(layout, state)),
            reactions: ShiftedUp::new(simd),
            couples: ShiftedUp::new(simd),
            torques: ShiftedDown::new(simd),
        };
        chain.ahead = chain.angles_after(simd, 0);
        chain
    }

    #[inline(always)]
    fn next(&mut self, simd: S, group: usize, ends: &mut Ends) -> Group<S> {
        let ahead = self.angles_after(simd, group + 1);
        let now = std::mem::replace(&mut self.ahead, ahead);
        let ([x, y, z, _], [u, v, w, coefficient]) = (now, self.angles.next(simd, now));
        let (after, before) = ([x, y, z], [u, v, w]);
        let [
            length,
            inverse_length,
            inverse_distance,
            share_before,
            share_after,
        ] = self.bodies.get(simd, group);
        // Computed first, because it does not depend on the segments.
        let [covers, shear] = self.of_ends(simd, group);
        let own = self.own(simd, covers, (before, inverse_distance));
        let segments = self.segments(simd, group, [length, inverse_length, shear]);
        let mut kappa = wide::scale(simd, before, share_before);
        kappa = wide::scale_add(simd, after, share_after, kappa);
        if ends.are_in(group) {
            kappa = ends.add_means(simd, group, kappa);
        }
        let [on_first, on_frame, couple] = segments.loads(simd, &self.law, kappa);
        let couple = wide::scale(simd, couple, length);
        if ends.are_in(group) {
            ends.keep(simd, group, couple);
        }
        let on_second = self.reactions.next(simd, on_first);
        let force = wide::sub(simd, on_first, on_second);
        let m = wide::scale_add(simd, couple, share_before, own);
        let on_after = self
            .couples
            .next(simd, wide::scale(simd, couple, share_after));
        let m = wide::add(simd, m, on_after);
        let [on_before, against_own] = bending_torques(simd, before, coefficient, m);
        Group {
            force,
            torque: wide::sub(simd, on_frame, against_own),
            before: self.torques.next(simd, on_before),
        }
    }

    #[inline(always)]
    fn segments(&self, simd: S, group: usize, numbers: [S::f64s; 3]) -> Segments<S> {
        let [length, inverse_length, shear] = numbers;
        let [first, second] = &self.nodes;
        let l = wide::sub(simd, second.get(simd, group), first.get(simd, group));
        let q = self.frames[0].get(simd, group);
        let mut segments = Segments::new(simd, q, l, [length, inverse_length]);
        if L::COVERS {
            segments.count_shear(simd, shear);
        }
        segments
    }

    /// Coverage and shear factors, or 1 if the law does not use them.
    #[inline(always)]
    fn of_ends(&self, simd: S, group: usize) -> [S::f64s; 2] {
        if L::COVERS {
            self.of_ends.get(simd, group)
        } else {
            [simd.splat_f64s(1.0); 2]
        }
    }

    #[inline(always)]
    fn own(&self, simd: S, covers: S::f64s, (angle, inverse): (Wide3<S>, S::f64s)) -> Wide3<S> {
        let own = self.law.bending(simd, wide::scale(simd, angle, inverse));
        let own = if L::BENT {
            where_there_is(simd, inverse, own)
        } else {
            own
        };
        if !L::COVERS {
            return own;
        }
        wide::scale(simd, own, covers)
    }

    /// Angles of the elements after a group's frames with coefficients, or zeros after the last
    /// group.
    #[inline(always)]
    fn angles_after(&self, simd: S, group: usize) -> [S::f64s; 4] {
        if group >= self.groups {
            return [simd.splat_f64s(0.0); 4];
        }
        let [first, second] = &self.frames;
        let turn = wide::relative(simd, first.get(simd, group), second.get(simd, group));
        let ([x, y, z], coefficient) = wide::log_with_coefficient(simd, turn);
        [x, y, z, coefficient]
    }

    #[inline(always)]
    fn last(&mut self, simd: S) -> Wide3<S> {
        self.torques.next(simd, [simd.splat_f64s(0.0); 3])
    }
}

fn frames_and_end(layout: &RodLayout) -> Range<usize> {
    layout.frames().start..layout.bending_chain().end
}

/// Angle between a wall at the start and the first segment (rad), with its coefficient.
fn angle_at_wall(layout: &RodLayout, state: &State) -> [f64; 4] {
    let Some(wall) = layout.wall(End::Start) else {
        return [0.0; 4];
    };
    let q = &state.frames.orientation;
    let theta = rotation::log(q.get(wall).inverse() * q.get(wall + 1));
    let c = rotation::inverse_jacobian_coefficient(theta.norm_squared());
    [theta.x, theta.y, theta.z, c]
}

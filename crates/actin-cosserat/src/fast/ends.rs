//! Elements of other interactions joined to the ends of a rod: their curvature is added to the end
//! segments, and the conjugate torques to their frames.
#![allow(
    clippy::inline_always,
    reason = "vector code must be compiled into the function that enables the instructions"
)]

use crate::End;
use crate::bending::BendingLoads;
use actin_mechanics::wide::{self, Simd, Wide3};
use actin_mechanics::{Loads, State, Vector3, rotation};

pub(super) const MOST_JOINED: usize = 8;

#[derive(Clone, Copy, Debug)]
pub(super) struct JoinedEnd {
    pub(super) frames: [usize; 2],
    pub(super) end: End,
    /// Weight in the mean curvature divided by rest distance (1/nm).
    pub(super) share: f64,
    /// Weighted difference between the rest curvatures of the rod and of the element (rad/nm).
    pub(super) difference: Vector3,
}

impl JoinedEnd {
    fn number(&self) -> usize {
        usize::from(self.end == End::End)
    }
}

#[derive(Debug)]
pub(super) struct Ends<'a> {
    joined: &'a [JoinedEnd],
    angles: [Vector3; MOST_JOINED],
    /// Group and lane of the first and of the last segment.
    places: [[usize; 2]; 2],
    /// Contributions to the mean curvatures of the end segments (rad/nm).
    means: [Vector3; 2],
    /// Torques of the end segments times length (pN nm^2).
    couples: [Vector3; 2],
}

impl<'a> Ends<'a> {
    pub(super) fn new(
        joined: &'a [JoinedEnd],
        state: &State,
        [segments, lanes]: [usize; 2],
    ) -> Self {
        let last = segments - 1;
        let mut ends = Self {
            joined,
            angles: [Vector3::zeros(); MOST_JOINED],
            places: [[0, 0], [last / lanes, last % lanes]],
            means: [Vector3::zeros(); 2],
            couples: [Vector3::zeros(); 2],
        };
        let q = &state.frames.orientation;
        for (angle, element) in ends.angles.iter_mut().zip(joined) {
            let [a, b] = element.frames;
            *angle = rotation::log(q.get(a).inverse() * q.get(b));
            ends.means[element.number()] += element.share * *angle + element.difference;
        }
        ends
    }

    #[inline(always)]
    pub(super) fn are_in(&self, group: usize) -> bool {
        let [[first, _], [last, _]] = self.places;
        !self.joined.is_empty() && (group == first || group == last)
    }

    #[inline(always)]
    pub(super) fn add_means<S: Simd>(&self, simd: S, group: usize, kappa: Wide3<S>) -> Wide3<S> {
        let mut kappa = kappa;
        for ([at, lane], mean) in self.places.into_iter().zip(self.means) {
            if at == group {
                kappa = wide::add(simd, kappa, wide::in_lane(simd, lane, mean));
            }
        }
        kappa
    }

    #[inline(always)]
    pub(super) fn keep<S: Simd>(&mut self, simd: S, group: usize, couples: Wide3<S>) {
        for ([at, lane], kept) in self.places.into_iter().zip(&mut self.couples) {
            if at == group {
                *kept = wide::lane(simd, lane, couples);
            }
        }
    }

    pub(super) fn add_loads(&self, loads: &mut Loads) {
        for (angle, element) in self.angles.iter().zip(self.joined) {
            let couple = element.share * self.couples[element.number()];
            let bending = BendingLoads::of_couple(couple, *angle);
            let [a, b] = element.frames;
            loads.torque.add(a, bending.first);
            loads.torque.add(b, bending.second);
        }
    }
}

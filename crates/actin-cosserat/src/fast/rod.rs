//! Data of a rod for the kernels, computed when the interaction is built.

use super::ends::{JoinedEnd, MOST_JOINED};
use super::laws::Law;
use crate::extended::{AdjacentElement, ExtendedSegments};
use crate::{End, RodLayout, SegmentCurvature};
use actin_mechanics::wide::Arch;
use actin_mechanics::{Loads, State};

#[derive(Clone, Debug)]
pub(super) struct Rod<L> {
    pub(super) law: L,
    pub(super) bodies: Bodies,
    pub(super) joined: Vec<JoinedEnd>,
}

/// Properties of each segment and of the preceding bending element. There is one lane more than
/// segments; missing elements have zeros.
#[derive(Clone, Debug)]
pub(super) struct Bodies {
    /// Rest lengths of segments (nm) and their inverse.
    pub(super) lengths: [Vec<f64>; 2],
    /// Inverse rest distance of the element before each segment (1/nm).
    pub(super) inverse_distances: Vec<f64>,
    /// Weights of the elements before and after a segment in its mean curvature, divided by rest
    /// distances (1/nm).
    pub(super) shares: [Vec<f64>; 2],
    /// Length covered by the element before each segment, divided by its rest distance: 1, or more
    /// next to a free end.
    pub(super) covers: Vec<f64>,
    pub(super) shear: Vec<f64>,
}

impl Bodies {
    fn new(layout: &RodLayout) -> Self {
        let segments = layout.segments();
        let zeros = || vec![0.0; segments + 1];
        let mut lengths = [zeros(), zeros()];
        for (k, length) in layout.segment_lengths().iter().enumerate() {
            lengths[0][k] = *length;
            lengths[1][k] = length.recip();
        }
        let mut inverse_distances = zeros();
        // Without a wall at the start, the first segment has no preceding element.
        let first = usize::from(layout.wall(End::Start).is_none());
        let elements = inverse_distances[first..].iter_mut();
        for (inverse, distance) in elements.zip(layout.voronoi_lengths()) {
            *inverse = distance.recip();
        }
        let covers = inverse_distances
            .iter()
            .map(|&inverse| f64::from(u8::from(inverse > 0.0)));
        Self {
            lengths,
            covers: covers.collect(),
            shear: vec![1.0; segments + 1],
            inverse_distances,
            shares: [zeros(), zeros()],
        }
    }
}

impl Bodies {
    /// Rest lengths of the segments (nm) and their inverse, without the additional lane.
    #[inline]
    pub(super) fn lengths(&self, layout: &RodLayout) -> [&[f64]; 2] {
        let [lengths, inverse] = &self.lengths;
        let segments = layout.segments();
        [&lengths[..segments], &inverse[..segments]]
    }

    /// Inverse rest distances of the bending elements (1/nm).
    #[inline]
    pub(super) fn inverse_distances(&self, layout: &RodLayout) -> &[f64] {
        let first = usize::from(layout.wall(End::Start).is_none());
        &self.inverse_distances[first..][..layout.voronoi_lengths().len()]
    }
}

impl<L: Law> Rod<L> {
    /// Creates the data, or returns `None` if a segment's mean curvature contains elements other
    /// than its neighbours and those joined to the ends.
    pub(super) fn new(
        layout: &RodLayout,
        law: L,
        extended: Option<&ExtendedSegments>,
    ) -> Option<Self> {
        let mut rod = Self {
            law,
            bodies: Bodies::new(layout),
            joined: Vec::new(),
        };
        for k in 0..layout.segments() {
            for around in
                extended.map_or(&[][..], |segments| segments.curvature.adjacent_elements(k))
            {
                rod.add_around(k, layout, around)?;
            }
            let shear = extended.map_or(1.0, |segments| segments.curvature.shear_factor(k));
            if L::COVERS {
                rod.cover(k, layout, &extended?.curvature)?;
                rod.bodies.shear[k] = shear;
            } else if shear.to_bits() != 1.0_f64.to_bits() {
                return None;
            }
        }
        (rod.joined.len() <= MOST_JOINED).then_some(rod)
    }

    fn add_around(&mut self, k: usize, layout: &RodLayout, around: &AdjacentElement) -> Option<()> {
        let frames = around.frames;
        let share = around.share / around.element.rest_distance;
        let difference = around.share * around.curvature_difference;
        let frame = layout.frames().start + k;
        let own = |lane: usize| self.bodies.inverse_distances[lane] > 0.0;
        if own(k) && frames == [frame.wrapping_sub(1), frame] {
            self.bodies.shares[0][k] += share;
        } else if own(k + 1) && frames == [frame, frame + 1] {
            self.bodies.shares[1][k] += share;
        } else {
            let at = |end| layout.end_frame(end) == frame;
            let end = match frames {
                [_, second] if second == frame && at(End::Start) => End::Start,
                [first, _] if first == frame && at(End::End) => End::End,
                _ => return None,
            };
            self.joined.push(JoinedEnd {
                frames,
                end,
                share,
                difference,
            });
        }
        Some(())
    }

    /// Extends the only element around segment `k` over the uncovered part of the segment.
    fn cover(&mut self, k: usize, layout: &RodLayout, curvature: &SegmentCurvature) -> Option<()> {
        let bare = (1.0 - curvature.covered(k)) * layout.segment_lengths()[k];
        let lane = match (
            curvature.adjacent_elements(k),
            self.bodies.shares[0][k] > 0.0,
        ) {
            _ if bare == 0.0 => return Some(()),
            ([], _) => return Some(()),
            ([_], true) => k,
            ([_], false) if self.bodies.shares[1][k] > 0.0 => k + 1,
            _ => return None,
        };
        self.bodies.covers[lane] += bare * self.bodies.inverse_distances[lane];
        Some(())
    }

    pub(super) fn add_loads(
        &self,
        arch: Arch,
        layout: &RodLayout,
        state: &State,
        loads: &mut Loads,
    ) {
        arch.dispatch(AddLoads {
            rod: self,
            layout,
            state,
            loads,
        });
    }
}

#[derive(Debug)]
pub(super) struct AddLoads<'a, L> {
    pub(super) rod: &'a Rod<L>,
    pub(super) layout: &'a RodLayout,
    pub(super) state: &'a State,
    pub(super) loads: &'a mut Loads,
}

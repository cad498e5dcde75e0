//! The mean curvature around each segment.

use super::end_shear::{EndShear, factors};
use super::end_twist::{EndTwist, end_twists};
use crate::{BendingElement, RodLayout};
use actin_mechanics::{State, Vector3};

/// A bending element that joins the end of a rod to something else, in the rod's direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JoinedElement {
    /// The frames that it joins: at the rod's start the second, at its end the first is that of
    /// the rod's end segment.
    pub frames: [usize; 2],
    /// The element.
    pub element: BendingElement,
    /// Curvature at rest (rad/nm) that it lacks of the rod's: zero of what is bent at rest as the rod is.
    pub lacking: Vector3,
}

/// Which bending elements stand around each segment of a rod, and with what shares its curvature
/// is their mean.
///
/// Each side of a segment has half; a side on which several elements stand (the bonds of a
/// junction) shares its half among them. Where one side has none (a free end), the other has all:
/// a quadrature that counts the missing side as straight would halve the twist of a uniformly
/// twisted rod at its ends.
#[derive(Clone, Debug, PartialEq)]
pub struct SegmentCurvature {
    /// Where the elements around each segment begin, and where those of the last one end.
    offsets: Vec<usize>,
    around: Vec<Around>,
    /// Share of each segment's length that elements stand for: half for each side that has any.
    covered: Vec<f64>,
    /// Factor of each segment's shear.
    shear: Vec<f64>,
    /// Bending elements near blocked ends.
    end_twists: Vec<EndTwist>,
}

/// One of the elements around a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Around {
    pub(crate) frames: [usize; 2],
    pub(crate) element: BendingElement,
    lacking: Vector3,
    /// Its part of the mean; those around a segment sum to 1.
    pub(crate) share: f64,
}

impl SegmentCurvature {
    /// The means of a rod that the elements `start` and `end` join to its surroundings.
    ///
    /// ```
    /// use actin_cosserat::{SegmentCurvature, StraightRod};
    /// use actin_mechanics::{State, Vector3, rotation};
    /// let mut state = State::default();
    /// let layout = StraightRod::uniform(2, 10.0).push(&mut state)?;
    /// state.frames.orientation.set(1, rotation::exp(Vector3::z() * 0.2));
    /// let curvature = SegmentCurvature::new(&layout, &[], &[]);
    /// // Both segments of a free pair have the twist of the one element between them.
    /// assert!((curvature.mean(0, &state).z - 0.02).abs() < 1e-15);
    /// assert!((curvature.mean(1, &state).z - 0.02).abs() < 1e-15);
    /// # Ok::<(), actin_cosserat::RodError>(())
    /// ```
    pub fn new(layout: &RodLayout, start: &[JoinedElement], end: &[JoinedElement]) -> Self {
        let segments = layout.segments();
        let first = layout.bending_chain().start;
        // The rod's own element that joins `frame` to the next.
        let own = |frame: usize| {
            let k = frame.checked_sub(first)?;
            let &rest_distance = layout.voronoi_lengths().get(k)?;
            Some(JoinedElement {
                frames: [frame, frame + 1],
                element: BendingElement { rest_distance },
                lacking: Vector3::zeros(),
            })
        };
        let mut curvature = Self {
            offsets: Vec::with_capacity(segments + 1),
            around: Vec::with_capacity(2 * segments + start.len() + end.len()),
            covered: Vec::with_capacity(segments),
            shear: vec![1.0; segments],
            end_twists: Vec::new(),
        };
        curvature.offsets.push(0);
        for (k, frame) in layout.frames().enumerate() {
            let before: &[_] = if k == 0 { start } else { &[] };
            let behind: &[_] = if k + 1 == segments { end } else { &[] };
            let previous = frame.checked_sub(1).and_then(own);
            curvature.push_segment([(previous, before), (own(frame), behind)]);
        }
        curvature
    }

    /// The same where the start and the end of the rod `layout` change the shear and the twist beside them. The ends are
    /// those of the rod or, `beyond_nm` its own, of rods that continue it. Meant for a potential.
    #[must_use]
    pub fn with_ends(self, layout: &RodLayout, ends: [EndShear; 2], beyond_nm: [f64; 2]) -> Self {
        Self {
            shear: factors(layout.segment_lengths(), ends, beyond_nm),
            end_twists: end_twists(layout, ends, beyond_nm),
            ..self
        }
    }

    /// Bending elements near blocked ends.
    pub(crate) fn end_twists(&self) -> &[EndTwist] {
        &self.end_twists
    }

    /// What the element between these frames has of that.
    pub(crate) fn end_twist(&self, frames: [usize; 2]) -> Option<&EndTwist> {
        self.end_twists.iter().find(|end| end.joins(frames))
    }

    /// Factor by which `segment` counts its strains across: 1 but near ends.
    #[inline]
    pub fn shear_factor(&self, segment: usize) -> f64 {
        self.shear[segment]
    }

    /// Appends a segment with what stands on its two sides: an element of the rod, and others.
    fn push_segment(&mut self, sides: [(Option<JoinedElement>, &[JoinedElement]); 2]) {
        let count = |(own, joined): &(Option<_>, &[_])| usize::from(own.is_some()) + joined.len();
        let present = sides.iter().filter(|side| count(side) > 0).count();
        for side in sides {
            let share = ((present * count(&side)) as f64).recip();
            let (own, joined) = side;
            let elements = own.into_iter().chain(joined.iter().copied());
            self.around.extend(elements.map(|joined| Around {
                frames: joined.frames,
                element: joined.element,
                lacking: joined.lacking,
                share,
            }));
        }
        self.offsets.push(self.around.len());
        self.covered.push(0.5 * present as f64);
    }

    /// Share of the length of `segment` that the elements around it stand for.
    #[inline]
    pub(crate) fn covered(&self, segment: usize) -> f64 {
        self.covered[segment]
    }

    /// The elements around `segment`.
    #[inline]
    pub(crate) fn around(&self, segment: usize) -> &[Around] {
        &self.around[self.offsets[segment]..self.offsets[segment + 1]]
    }

    /// Mean curvature around `segment` (rad/nm, body axes); zero where nothing bends.
    #[inline]
    pub fn mean(&self, segment: usize, state: &State) -> Vector3 {
        let q = &state.frames.orientation;
        let curvature = |a: &Around| {
            let [first, second] = a.frames.map(|frame| q.get(frame));
            a.share * (a.element.curvature(first, second) + a.lacking)
        };
        self.around(segment).iter().map(curvature).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{StraightRod, Walls};

    fn shares(curvature: &SegmentCurvature, segment: usize) -> Vec<([usize; 2], f64)> {
        let around = curvature.around(segment).iter();
        around.map(|a| (a.frames, a.share)).collect()
    }

    /// Frames: wall 0, segments 1 to 3, then two junction frames.
    #[test]
    fn walls_and_junctions_are_neighbours() {
        let mut state = State::default();
        let walls = Walls {
            start: true,
            end: false,
        };
        let rod = StraightRod {
            walls,
            ..StraightRod::uniform(3, 10.0)
        };
        let layout = rod.push(&mut state).unwrap();
        let joined = [4, 5].map(|junction| JoinedElement {
            frames: [3, junction],
            element: BendingElement { rest_distance: 6.0 },
            lacking: Vector3::zeros(),
        });
        let curvature = SegmentCurvature::new(&layout, &[], &joined);
        assert_eq!(shares(&curvature, 0), [([0, 1], 0.5), ([1, 2], 0.5)]);
        assert_eq!(shares(&curvature, 1), [([1, 2], 0.5), ([2, 3], 0.5)]);
        let last = [([2, 3], 0.5), ([3, 4], 0.25), ([3, 5], 0.25)];
        assert_eq!(shares(&curvature, 2), last);
    }

    /// Each segment looks at its neighbours alone: a look at all elements for each of a million
    /// segments would take hours.
    #[test]
    fn a_million_segments_have_two_neighbours_each() {
        let n = 1_000_000;
        let layout = RodLayout::new(0, 0, vec![10.0; n], Walls::default()).unwrap();
        let curvature = SegmentCurvature::new(&layout, &[], &[]);
        assert_eq!(curvature.around.len(), 2 * (n - 1));
        let middle = n / 2;
        let expected = [([middle - 1, middle], 0.5), ([middle, middle + 1], 0.5)];
        assert_eq!(shares(&curvature, middle), expected);
        let last = [([n - 2, n - 1], 1.0)];
        assert_eq!(shares(&curvature, n - 1), last);
    }

    #[test]
    fn free_ends_take_their_only_neighbour_and_a_lone_segment_has_none() {
        let mut state = State::default();
        let layout = StraightRod::uniform(3, 10.0).push(&mut state).unwrap();
        let curvature = SegmentCurvature::new(&layout, &[], &[]);
        assert_eq!(shares(&curvature, 0), [([0, 1], 1.0)]);
        assert_eq!(shares(&curvature, 2), [([1, 2], 1.0)]);
        let lone = StraightRod::uniform(1, 10.0).push(&mut state).unwrap();
        let curvature = SegmentCurvature::new(&lone, &[], &[]);
        assert_eq!(curvature.mean(0, &state), Vector3::zeros());
    }
}

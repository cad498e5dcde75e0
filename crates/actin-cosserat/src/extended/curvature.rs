//! Mean curvature around each segment.

use super::end_shear::{EndShear, factors};
use super::end_twist::{EndTwist, end_twists};
use crate::{BendingElement, RodLayout};
use actin_mechanics::{State, Vector3};

/// Bending element between the end of a rod and another part, in the direction of the rod.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JoinedElement {
    /// Frames of the element. The rod's end segment has the second frame at the start, the first at
    /// the end.
    pub frames: [usize; 2],
    /// Bending element.
    pub element: BendingElement,
    /// Difference between the rest curvatures of the rod and of the element (rad/nm).
    pub curvature_difference: Vector3,
}

/// Quadrature of the mean curvature around each segment of a rod.
///
/// Each side of a segment has a weight of 1/2, divided among the elements there. At a free end the
/// other side has the whole weight.
#[derive(Clone, Debug, PartialEq)]
pub struct SegmentCurvature {
    /// Index of the first element around each segment, and the total number.
    offsets: Vec<usize>,
    around: Vec<AdjacentElement>,
    /// Share of each segment's length covered by elements: one half per side.
    covered: Vec<f64>,
    shear: Vec<f64>,
    end_twists: Vec<EndTwist>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct AdjacentElement {
    pub(crate) frames: [usize; 2],
    pub(crate) element: BendingElement,
    pub(crate) curvature_difference: Vector3,
    /// Weight in the mean; the weights of a segment sum to 1.
    pub(crate) share: f64,
}

impl SegmentCurvature {
    /// Creates the means of a rod with the elements `start` and `end` joined to its ends.
    ///
    /// ```
    /// use actin_cosserat::{SegmentCurvature, StraightRod};
    /// use actin_mechanics::{State, Vector3, rotation};
    /// let mut state = State::default();
    /// let layout = StraightRod::uniform(2, 10.0).push(&mut state)?;
    /// state.frames.orientation.set(1, rotation::exp(Vector3::z() * 0.2));
    /// let curvature = SegmentCurvature::new(&layout, &[], &[]);
    /// // Both segments of a free pair have the twist of the element between them.
    /// assert!((curvature.mean(0, &state).z - 0.02).abs() < 1e-15);
    /// assert!((curvature.mean(1, &state).z - 0.02).abs() < 1e-15);
    /// # Ok::<(), actin_cosserat::RodError>(())
    /// ```
    pub fn new(layout: &RodLayout, start: &[JoinedElement], end: &[JoinedElement]) -> Self {
        let segments = layout.segments();
        let first = layout.bending_chain().start;
        let own = |frame: usize| {
            let k = frame.checked_sub(first)?;
            let &rest_distance = layout.voronoi_lengths().get(k)?;
            Some(JoinedElement {
                frames: [frame, frame + 1],
                element: BendingElement { rest_distance },
                curvature_difference: Vector3::zeros(),
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

    /// Sets the effect of both ends on shear and twist near them, for potentials.
    ///
    /// `beyond_nm` are the distances from the ends of `layout` to the ends of the whole rod.
    #[must_use]
    pub fn with_ends(self, layout: &RodLayout, ends: [EndShear; 2], beyond_nm: [f64; 2]) -> Self {
        Self {
            shear: factors(layout.segment_lengths(), ends, beyond_nm),
            end_twists: end_twists(layout, ends, beyond_nm),
            ..self
        }
    }

    pub(crate) fn is_straight(&self) -> bool {
        let mut all = self.around.iter();
        all.all(|a| a.curvature_difference.x == 0.0 && a.curvature_difference.y == 0.0)
    }

    pub(crate) fn end_twists(&self) -> &[EndTwist] {
        &self.end_twists
    }

    pub(crate) fn end_twist(&self, frames: [usize; 2]) -> Option<&EndTwist> {
        self.end_twists.iter().find(|end| end.joins(frames))
    }

    /// Factor of the shear strain of `segment`: 1 except near ends.
    #[inline]
    pub fn shear_factor(&self, segment: usize) -> f64 {
        self.shear[segment]
    }

    fn push_segment(&mut self, sides: [(Option<JoinedElement>, &[JoinedElement]); 2]) {
        let count = |(own, joined): &(Option<_>, &[_])| usize::from(own.is_some()) + joined.len();
        let present = sides.iter().filter(|side| count(side) > 0).count();
        for side in sides {
            let share = ((present * count(&side)) as f64).recip();
            let (own, joined) = side;
            let elements = own.into_iter().chain(joined.iter().copied());
            self.around.extend(elements.map(|joined| AdjacentElement {
                frames: joined.frames,
                element: joined.element,
                curvature_difference: joined.curvature_difference,
                share,
            }));
        }
        self.offsets.push(self.around.len());
        self.covered.push(0.5 * present as f64);
    }

    #[inline]
    pub(crate) fn covered(&self, segment: usize) -> f64 {
        self.covered[segment]
    }

    #[inline]
    pub(crate) fn adjacent_elements(&self, segment: usize) -> &[AdjacentElement] {
        &self.around[self.offsets[segment]..self.offsets[segment + 1]]
    }

    /// Mean curvature around `segment` (rad/nm, body axes), or zero without elements.
    #[inline]
    pub fn mean(&self, segment: usize, state: &State) -> Vector3 {
        let q = &state.frames.orientation;
        let curvature = |a: &AdjacentElement| {
            let [first, second] = a.frames.map(|frame| q.get(frame));
            a.share * (a.element.curvature(first, second) + a.curvature_difference)
        };
        self.adjacent_elements(segment).iter().map(curvature).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{StraightRod, Walls};

    fn shares(curvature: &SegmentCurvature, segment: usize) -> Vec<([usize; 2], f64)> {
        let around = curvature.adjacent_elements(segment).iter();
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
            curvature_difference: Vector3::zeros(),
        });
        let curvature = SegmentCurvature::new(&layout, &[], &joined);
        assert_eq!(shares(&curvature, 0), [([0, 1], 0.5), ([1, 2], 0.5)]);
        assert_eq!(shares(&curvature, 1), [([1, 2], 0.5), ([2, 3], 0.5)]);
        let last = [([2, 3], 0.5), ([3, 4], 0.25), ([3, 5], 0.25)];
        assert_eq!(shares(&curvature, 2), last);
    }

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
    fn free_ends_use_their_only_neighbour() {
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

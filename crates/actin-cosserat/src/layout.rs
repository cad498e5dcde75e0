//! Bodies and rest lengths of a rod in a state.

use crate::{End, RodError};
use actin_mechanics::{LoadError, PointLoad, State, Vector3};
use std::ops::Range;

/// Ends of a rod with a held wall frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Walls {
    /// Before the first segment.
    pub start: bool,
    /// After the last segment.
    pub end: bool,
}

/// Bodies and rest lengths of a rod in a state.
///
/// A rod has `n` segments, `n + 1` consecutive points and `n` consecutive frames. Wall frames are
/// directly before the first and after the last frame, so the frames of all bending elements are
/// consecutive.
#[derive(Clone, Debug, PartialEq)]
pub struct RodLayout {
    first_point: usize,
    first_frame: usize,
    walls: Walls,
    /// Walls that are free.
    free_walls: Walls,
    segment_lengths: Vec<f64>,
    voronoi_lengths: Vec<f64>,
}

impl RodLayout {
    /// Creates the layout of a rod from the index of its first point, the index of its first
    /// segment's frame, and rest lengths (nm).
    ///
    /// # Errors
    /// If the rod has no segments, or if a length or its inverse is not positive and finite.
    ///
    /// # Panics
    /// If there is a wall at the start and `first_frame` is 0.
    pub(crate) fn new(
        first_point: usize,
        first_frame: usize,
        segment_lengths: Vec<f64>,
        walls: Walls,
    ) -> Result<Self, RodError> {
        check_lengths(&segment_lengths)?;
        assert!(
            first_frame > 0 || !walls.start,
            "a wall at the start needs a frame before the first segment's frame"
        );
        let voronoi_lengths = voronoi(&segment_lengths, walls);
        let refused = (0..).zip(&voronoi_lengths).find(|(_, l)| !is_length(**l));
        if let Some((joint, &value)) = refused {
            return Err(RodError::JointDistance { joint, value });
        }
        Ok(Self {
            first_point,
            first_frame,
            walls,
            free_walls: Walls::default(),
            segment_lengths,
            voronoi_lengths,
        })
    }

    pub(crate) fn with_free_walls(self, free_walls: Walls) -> Self {
        Self { free_walls, ..self }
    }

    /// Number of segments.
    pub fn segments(&self) -> usize {
        self.segment_lengths.len()
    }

    /// Points of the rod.
    pub fn points(&self) -> Range<usize> {
        self.first_point..self.first_point + self.segments() + 1
    }

    /// Frames of the segments, without walls.
    pub fn frames(&self) -> Range<usize> {
        self.first_frame..self.first_frame + self.segments()
    }

    /// Frames of the bending elements: segments and walls.
    pub fn bending_chain(&self) -> Range<usize> {
        let Range { start, end } = self.frames();
        start - usize::from(self.walls.start)..end + usize::from(self.walls.end)
    }

    /// Frames of the segments and free walls.
    pub(crate) fn free_frames(&self) -> Range<usize> {
        let Range { start, end } = self.frames();
        start - usize::from(self.free_walls.start)..end + usize::from(self.free_walls.end)
    }

    /// Point at an end.
    pub fn end_point(&self, end: End) -> usize {
        match end {
            End::Start => self.first_point,
            End::End => self.first_point + self.segments(),
        }
    }

    /// Position of the last point (nm, lab frame).
    pub fn tip(&self, state: &State) -> Vector3 {
        state.points.position.get(self.end_point(End::End))
    }

    /// Creates a constant force (pN, lab frame) on the last point.
    ///
    /// ```
    /// use actin_cosserat::{End, EnergyGradient, Rigidities, RodClamp, RodMaterial, State, StraightRod, Vector3};
    /// use actin_equilibrium::relax;
    /// let mut state = State::default();
    /// let rod = StraightRod::uniform(32, 5.0).push_clamped(RodClamp::Wall, End::Start, &mut state)?;
    /// let rigidities = Rigidities::table4();
    /// let law = EnergyGradient::new(rod.clone(), RodMaterial::new(rigidities)?);
    /// let force = rod.pull(&mut state, Vector3::x() * 0.01)?;
    /// relax(&mut state, &[Box::new(law), Box::new(force)])?;
    /// let beam = 0.01 * rod.length().powi(3) / (3.0 * rigidities.bend.y);
    /// assert!((rod.tip(&state).x / beam - 1.0).abs() < 0.01);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// If the force is not finite.
    pub fn pull(&self, state: &mut State, force: Vector3) -> Result<PointLoad, LoadError> {
        PointLoad::at(state, self.end_point(End::End), force)
    }

    /// Frame of the segment at an end.
    pub fn end_frame(&self, end: End) -> usize {
        match end {
            End::Start => self.first_frame,
            End::End => self.first_frame + self.segments() - 1,
        }
    }

    /// Rest length of the segment at an end (nm).
    pub fn end_length(&self, end: End) -> f64 {
        match end {
            End::Start => self.segment_lengths[0],
            End::End => self.segment_lengths[self.segments() - 1],
        }
    }

    /// Wall frame at an end, or `None`.
    pub fn wall(&self, end: End) -> Option<usize> {
        let frames = self.frames();
        match end {
            End::Start => self.walls.start.then(|| frames.start - 1),
            End::End => self.walls.end.then_some(frames.end),
        }
    }

    /// Rest lengths of the segments (nm).
    pub fn segment_lengths(&self) -> &[f64] {
        &self.segment_lengths
    }

    /// Rest distances `Dhat` of the bending elements (nm): mean length of the two segments, or half
    /// a segment at a wall.
    pub fn voronoi_lengths(&self) -> &[f64] {
        &self.voronoi_lengths
    }

    /// Rest length of the rod (nm).
    pub fn length(&self) -> f64 {
        self.segment_lengths.iter().sum()
    }

    /// Number of elements: one shear element per segment, `n - 1` bending elements, and one more
    /// per wall.
    pub(crate) fn elements(&self) -> usize {
        self.segment_lengths.len() + self.voronoi_lengths.len()
    }

    /// Rest arc lengths of the nodes, starting at 0 (nm).
    pub fn node_positions(&self) -> Vec<f64> {
        let mut place = 0.0;
        let behind = self.segment_lengths.iter().map(|length| {
            place += length;
            place
        });
        std::iter::once(0.0).chain(behind).collect()
    }

    /// Rest arc lengths of the elements (nm): middles of segments for shear elements, nodes for
    /// bending elements.
    pub fn element_positions(&self) -> Vec<f64> {
        let nodes = self.node_positions();
        let middles = nodes.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
        let first = usize::from(!self.walls.start);
        let past = nodes.len() - usize::from(!self.walls.end);
        middles.chain(nodes[first..past].iter().copied()).collect()
    }
}

pub(crate) fn check_lengths(lengths: &[f64]) -> Result<(), RodError> {
    if lengths.is_empty() {
        return Err(RodError::NoSegments);
    }
    match lengths.iter().position(|l| !is_length(*l)) {
        Some(segment) => Err(RodError::SegmentLength {
            segment,
            value: lengths[segment],
        }),
        None => Ok(()),
    }
}

pub(crate) fn is_length(value: f64) -> bool {
    value.is_finite() && value > 0.0 && value.recip().is_finite()
}

fn voronoi(lengths: &[f64], walls: Walls) -> Vec<f64> {
    let half = |length: &f64| 0.5 * length;
    let first = lengths.first().filter(|_| walls.start).map(half);
    let last = lengths.last().filter(|_| walls.end).map(half);
    let inside = lengths.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
    first.into_iter().chain(inside).chain(last).collect()
}

#[cfg(test)]
pub(crate) const BOTH: Walls = Walls {
    start: true,
    end: true,
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn voronoi_lengths_cover_the_rod() {
        let lengths = vec![1.0, 2.0, 4.0];
        let both = RodLayout::new(0, 1, lengths.clone(), BOTH).unwrap();
        assert_eq!(both.voronoi_lengths(), [0.5, 1.5, 3.0, 2.0]);
        assert!((both.voronoi_lengths().iter().sum::<f64>() - both.length()).abs() < 1e-15);
        let free = RodLayout::new(0, 0, lengths, Walls::default()).unwrap();
        assert_eq!(free.voronoi_lengths(), [1.5, 3.0]);
    }

    #[test]
    fn elements_are_at_middles_and_nodes() {
        let lengths = vec![1.0, 2.0, 4.0];
        let both = RodLayout::new(0, 1, lengths.clone(), BOTH).unwrap();
        assert_eq!(
            both.element_positions(),
            [0.5, 2.0, 5.0, 0.0, 1.0, 3.0, 7.0]
        );
        let free = RodLayout::new(0, 0, lengths, Walls::default()).unwrap();
        assert_eq!(free.element_positions(), [0.5, 2.0, 5.0, 1.0, 3.0]);
        assert_eq!(free.elements(), 5);
    }

    #[test]
    fn one_segment_is_a_rod() {
        let free = RodLayout::new(3, 7, vec![2.0], Walls::default()).unwrap();
        assert_eq!(free.elements(), 1);
        assert_eq!(free.bending_chain(), 7..8);
        let both = RodLayout::new(3, 7, vec![2.0], BOTH).unwrap();
        assert_eq!(both.bending_chain(), 6..9);
        assert_eq!(both.wall(End::Start), Some(6));
        assert_eq!(both.wall(End::End), Some(8));
        assert_eq!(both.voronoi_lengths(), [1.0, 1.0]);
    }

    #[test]
    fn rods_without_segments_or_lengths_are_refused() {
        let rod = |lengths| RodLayout::new(0, 0, lengths, Walls::default());
        assert_eq!(rod(vec![]), Err(RodError::NoSegments));
        for value in [0.0, -1.0, f64::INFINITY] {
            let segment = 1;
            let expected = RodError::SegmentLength { segment, value };
            assert_eq!(rod(vec![1.0, value]), Err(expected));
        }
        assert!(rod(vec![f64::NAN]).is_err());
    }
}

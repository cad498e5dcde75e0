//! Construction of straight rods in a state.

use crate::layout::check_lengths;
use crate::shape::from_z;
use crate::{CrossSection, End, RodClamp, RodError, RodLayout, Walls};
use actin_mechanics::{Frame, Inertia, Point, State, UnitQuaternion, Vector3};

/// A straight, unstrained rod.
#[derive(Clone, Debug, PartialEq)]
pub struct StraightRod {
    /// Position of node 0 (nm, lab frame).
    pub start: Vector3,
    /// Orientation of every frame, body to lab. The rod lies along d3.
    pub orientation: UnitQuaternion,
    /// Rest lengths of the segments (nm).
    pub segment_lengths: Vec<f64>,
    /// Cross-section, which determines masses and moments of inertia.
    pub cross_section: CrossSection,
    /// Transverse inertia of the segments.
    pub rotary_inertia: RotaryInertia,
    /// Ends with a held wall frame.
    pub walls: Walls,
    /// Ends with a free wall frame: the cross-section at the last node, on which end torques act.
    ///
    /// A bending element of half a segment connects the wall frame to the last segment. The wall
    /// frame takes a quarter of the segment's inertia.
    pub free_walls: Walls,
}

/// Transverse inertia of a segment. It affects only `Dynamics`, and not the means and fluctuations in a heat bath.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum RotaryInertia {
    /// Inertia of the cross-section. The time step does not grow with the length of segments above 10 nm.
    #[default]
    CrossSection,
    /// Inertia of the cross-section and of a rigid piece of rod, `mass length^2 / 12`. The time step grows with the
    /// length of segments; slow bending is slower by `(2 pi length / wavelength)^2 / 24`.
    RigidSegment,
}

impl StraightRod {
    /// Rod of equal segments from the origin along lab +z, with actin's cross-section and without
    /// walls.
    pub fn uniform(segments: usize, segment_length: f64) -> Self {
        Self {
            start: Vector3::zeros(),
            orientation: UnitQuaternion::identity(),
            segment_lengths: vec![segment_length; segments],
            cross_section: CrossSection::actin(),
            rotary_inertia: RotaryInertia::default(),
            walls: Walls::default(),
            free_walls: Walls::default(),
        }
    }

    /// Rotates the rod to another direction (lab frame), by the smallest rotation of +z.
    ///
    /// # Errors
    /// If `direction` is zero or not finite.
    pub fn along(self, direction: Vector3) -> Result<Self, RodError> {
        let orientation = from_z(direction).ok_or(RodError::NoAxis)?;
        Ok(Self {
            orientation,
            ..self
        })
    }

    /// Appends the rod to a state with one end clamped, and adds the wall frame if the clamp needs
    /// one.
    ///
    /// # Errors
    /// See [`push`](Self::push).
    pub fn push_clamped(
        &self,
        clamp: RodClamp,
        end: End,
        state: &mut State,
    ) -> Result<RodLayout, RodError> {
        let mut rod = self.clone();
        match end {
            End::Start => rod.walls.start |= clamp.needs_wall(),
            End::End => rod.walls.end |= clamp.needs_wall(),
        }
        let layout = rod.push(state)?;
        clamp.hold(&layout, end, state)?;
        Ok(layout)
    }

    /// Appends the rod's points and frames to a state: wall frame at the start, frames of the
    /// segments, wall frame at the end.
    ///
    /// Each node has half the mass of its segments. Held wall frames have the inertia of the
    /// adjacent segment; free wall frames ([`free_walls`](Self::free_walls)) share it.
    ///
    /// # Errors
    /// If the rod has no segments, if a length or an inertia (or its inverse) is not positive and
    /// finite, or if a position or the orientation is not finite. The state is unchanged on error.
    pub fn push(&self, state: &mut State) -> Result<RodLayout, RodError> {
        let layouts = self.push_in_parts(&[self.segment_lengths.len()], state)?;
        layouts.into_iter().next().ok_or(RodError::NoSegments)
    }

    /// Appends a rod in parts, which may have different materials; `parts` are numbers of segments.
    ///
    /// Neighbouring parts share a node and a free wall frame. The half segments on both sides of
    /// the frame bend in series. The frame takes a quarter of the inertia of both adjacent
    /// segments.
    ///
    /// # Errors
    /// If a part has no segments, if the sum of `parts` is not the number of segments, or as in
    /// [`push`](Self::push). The state is unchanged on error.
    pub fn push_in_parts(
        &self,
        parts: &[usize],
        state: &mut State,
    ) -> Result<Vec<RodLayout>, RodError> {
        let lengths = &self.segment_lengths;
        check_lengths(lengths)?;
        self.check_frames()?;
        let nodes = self.nodes()?;
        if parts.contains(&0) || parts.iter().sum::<usize>() != lengths.len() {
            return Err(RodError::NoSegments);
        }
        let first_point = state.points.len();
        for node in nodes {
            state.points.push(node);
        }
        self.push_wall((End::Start, lengths[0]), state);
        let mut layouts = Vec::with_capacity(parts.len());
        let mut done = 0;
        for (i, &count) in parts.iter().enumerate() {
            let is_joined = [i > 0, i + 1 < parts.len()];
            let own = &lengths[done..done + count];
            let first_frame = state.frames.len();
            self.push_segments(own, is_joined, state);
            done += count;
            if is_joined[1] {
                let mean = 0.5 * (lengths[done - 1] + lengths[done]);
                state.frames.push(self.frame(0.5 * mean, mean));
            } else {
                self.push_wall((End::End, own[count - 1]), state);
            }
            let walls = Walls {
                start: is_joined[0] || self.wall(End::Start).is_some(),
                end: is_joined[1] || self.wall(End::End).is_some(),
            };
            let is_free = |end| self.wall(end) == Some(false);
            let free_walls = Walls {
                start: is_joined[0] || is_free(End::Start),
                end: is_joined[1] || is_free(End::End),
            };
            let first_point = first_point + done - count;
            let layout = RodLayout::new(first_point, first_frame, own.to_vec(), walls)?;
            layouts.push(layout.with_free_walls(free_walls));
        }
        Ok(layouts)
    }

    /// Appends the frames of a part. A segment loses a quarter of its inertia to each adjacent free
    /// wall frame.
    fn push_segments(&self, lengths: &[f64], is_joined: [bool; 2], state: &mut State) {
        let is_free = |end| self.wall(end) == Some(false);
        let shares_inertia = [
            is_joined[0] || is_free(End::Start),
            is_joined[1] || is_free(End::End),
        ];
        for (k, &length) in lengths.iter().enumerate() {
            let is_beside = [k == 0, k + 1 == lengths.len()];
            let sides = is_beside.iter().zip(shares_inertia);
            let curvature_difference = sides.filter(|(beside, shares)| **beside && *shares).count();
            let own = match curvature_difference {
                0 => length,
                sides => length * (1.0 - 0.25 * sides as f64),
            };
            state.frames.push(self.frame(own, length));
        }
    }

    fn nodes(&self) -> Result<Vec<Point>, RodError> {
        let lengths = &self.segment_lengths;
        let axis = self.orientation * Vector3::z();
        let mut s = 0.0;
        let node = |node| {
            let before = if node == 0 { 0.0 } else { lengths[node - 1] };
            let after = lengths.get(node).copied().unwrap_or(0.0);
            s += before;
            let point = Point {
                position: self.start + axis * s,
                mass: self.cross_section.mass(0.5 * (before + after)),
            };
            let is_placed = point.position.iter().all(|x| x.is_finite());
            match (is_placed, point.is_valid()) {
                (false, _) => Err(RodError::Place { node }),
                (true, false) => Err(self.inertia_refused(node.min(lengths.len() - 1))),
                (true, true) => Ok(point),
            }
        };
        (0..=lengths.len()).map(node).collect()
    }

    fn check_frames(&self) -> Result<(), RodError> {
        let is_refused = |&length: &f64| {
            let pieces = [0.25 * length, length];
            !pieces
                .iter()
                .all(|&piece| self.frame(piece, length).is_valid())
        };
        let refused = self.segment_lengths.iter().position(is_refused);
        if self.orientation.coords.iter().any(|q| !q.is_finite()) {
            return Err(RodError::Place { node: 0 });
        }
        refused.map_or(Ok(()), |segment| Err(self.inertia_refused(segment)))
    }

    fn inertia_refused(&self, segment: usize) -> RodError {
        let value = self.segment_lengths[segment];
        RodError::SegmentInertia { segment, value }
    }

    /// Returns whether the wall frame at an end is held, or `None` without a wall frame.
    fn wall(&self, end: End) -> Option<bool> {
        let (is_held, is_free) = match end {
            End::Start => (self.walls.start, self.free_walls.start),
            End::End => (self.walls.end, self.free_walls.end),
        };
        (is_held || is_free).then_some(is_held)
    }

    fn push_wall(&self, (end, length): (End, f64), state: &mut State) {
        let Some(is_held) = self.wall(end) else {
            return;
        };
        let piece = if is_held { length } else { 0.25 * length };
        let wall = state.frames.push(self.frame(piece, length));
        if is_held {
            state.frames.hold(wall);
        }
    }

    fn frame(&self, piece: f64, segment: f64) -> Frame {
        let section = self.cross_section.segment_inertia(piece);
        let about_middle = match self.rotary_inertia {
            RotaryInertia::CrossSection => 0.0,
            RotaryInertia::RigidSegment => self.cross_section.mass(piece) * segment.powi(2) / 12.0,
        };
        Frame {
            orientation: self.orientation,
            inertia: Inertia {
                transverse: section.transverse + about_middle,
                ..section
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::End;

    #[test]
    fn rods_are_appended_to_existing_bodies() {
        let mut state = State::default();
        StraightRod::uniform(2, 1.0).push(&mut state).unwrap();
        let rod = StraightRod {
            start: Vector3::new(1.0, 2.0, 3.0),
            segment_lengths: vec![1.0, 3.0],
            walls: Walls {
                start: true,
                end: true,
            },
            ..StraightRod::uniform(0, 0.0)
        };
        let layout = rod.push(&mut state).unwrap();
        StraightRod::uniform(1, 1.0).push(&mut state).unwrap();
        assert_eq!(layout.points(), 3..6);
        assert_eq!(layout.bending_chain(), 2..6);
        assert_eq!(layout.wall(End::Start), Some(2));
        assert_eq!(layout.wall(End::End), Some(5));
        let held = (0..state.frames.len()).filter(|&i| !state.frames.is_free(i));
        assert!(held.eq([2, 5]));
        let tip = layout.tip(&state);
        assert_eq!(tip, Vector3::new(1.0, 2.0, 7.0));
    }

    #[test]
    fn parts_share_a_node_and_a_cross_section() {
        let rod = StraightRod {
            segment_lengths: vec![1.0, 2.0, 4.0, 3.0],
            walls: Walls {
                start: true,
                end: false,
            },
            ..StraightRod::uniform(0, 0.0)
        };
        let (mut whole, mut divided) = (State::default(), State::default());
        rod.push(&mut whole).unwrap();
        let parts = rod.push_in_parts(&[1, 3], &mut divided).unwrap();
        assert_eq!(divided.points, whole.points);
        assert_eq!((parts[0].points(), parts[1].points()), (0..2, 1..5));
        assert_eq!((parts[0].frames(), parts[1].frames()), (1..2, 3..6));
        let shared = parts[0].wall(End::End);
        assert_eq!((shared, parts[1].wall(End::Start)), (Some(2), Some(2)));
        assert!(divided.frames.is_free(2));
        let inertia = |state: &State| -> f64 {
            let free = (0..state.frames.len()).filter(|&i| state.frames.is_free(i));
            free.map(|i| 1.0 / state.frames.inverse_moments(i).x).sum()
        };
        let (a, b) = (inertia(&whole), inertia(&divided));
        assert!((a / b - 1.0).abs() < 1e-14, "{a} {b}");
        let lengths: f64 = parts.iter().flat_map(RodLayout::voronoi_lengths).sum();
        assert!((lengths - 8.5).abs() < 1e-14);
        for wrong in [&[4, 0][..], &[1, 2], &[]] {
            assert!(rod.push_in_parts(wrong, &mut State::default()).is_err());
        }
    }

    #[test]
    fn free_walls_share_the_inertia_of_their_segments() {
        let inertia = |free_walls| {
            let rod = StraightRod {
                free_walls,
                ..StraightRod::uniform(3, 2.0)
            };
            let mut state = State::default();
            let layout = rod.push(&mut state).unwrap();
            let frames = 0..state.frames.len();
            assert!(frames.clone().all(|i| state.frames.is_free(i)));
            let sum = frames.map(|i| 1.0 / state.frames.inverse_moments(i).x);
            (
                sum.sum::<f64>(),
                layout.voronoi_lengths().iter().sum::<f64>(),
            )
        };
        let ((none, inner), (both, all)) =
            (inertia(Walls::default()), inertia(crate::layout::BOTH));
        assert!((none / both - 1.0).abs() < 1e-14, "{none} {both}");
        assert_eq!((inner, all), (4.0, 6.0));
    }

    #[test]
    fn masses_add_up() {
        let rod = StraightRod {
            segment_lengths: vec![1.0, 2.0, 4.0],
            ..StraightRod::uniform(0, 0.0)
        };
        let mut state = State::default();
        rod.push(&mut state).unwrap();
        let masses = state
            .points
            .inverse_mass()
            .iter()
            .map(|inverse| 1.0 / inverse);
        for (mass, length) in masses.zip([0.5, 1.5, 3.0, 2.0]) {
            let expected = rod.cross_section.linear_density() * length;
            // Rounding of two reciprocals.
            assert!((mass - expected).abs() < 1e-14 * expected);
        }
    }

    #[test]
    fn a_rod_lies_along_its_direction() {
        for direction in [Vector3::x(), -Vector3::z(), Vector3::new(1.0, 2.0, -2.0)] {
            let rod = StraightRod::uniform(1, 3.0).along(direction).unwrap();
            let mut state = State::default();
            rod.push(&mut state).unwrap();
            let tip = state.points.position.get(1);
            assert!((tip - direction * (3.0 / direction.norm())).norm() < 1e-14);
        }
        for nowhere in [Vector3::zeros(), Vector3::repeat(f64::NAN)] {
            let error = StraightRod::uniform(1, 3.0).along(nowhere).unwrap_err();
            assert_eq!(error, RodError::NoAxis);
        }
    }

    #[test]
    fn a_refused_rod_does_not_change_the_state() {
        let mut state = State::default();
        let lengths = [0.0, f64::NAN, f64::MAX, 1e308, 1e-308, 5e-324];
        let rods = lengths.map(|length| StraightRod::uniform(2, length));
        let nowhere = StraightRod {
            start: Vector3::y() * f64::NAN,
            ..StraightRod::uniform(2, 1.0)
        };
        let turned = StraightRod {
            orientation: UnitQuaternion::new(Vector3::y() * f64::NAN),
            ..StraightRod::uniform(2, 1.0)
        };
        let few = [StraightRod::uniform(0, 1.0), nowhere, turned];
        for rod in rods.iter().chain(&few) {
            for rotary_inertia in [RotaryInertia::CrossSection, RotaryInertia::RigidSegment] {
                let rod = StraightRod {
                    rotary_inertia,
                    ..rod.clone()
                };
                assert!(rod.push(&mut state).is_err(), "{rod:?}");
                assert!(rod.push_in_parts(&[1, 1], &mut state).is_err(), "{rod:?}");
            }
        }
        assert_eq!(state, State::default());
    }
}

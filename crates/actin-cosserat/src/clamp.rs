//! Clamps of rod ends.

use crate::{End, RodError, RodLayout};
use actin_mechanics::State;
use std::ops::Range;

/// Bodies held at a clamped end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RodClamp {
    /// Last node and a wall frame. A bending element of half a segment connects the wall frame to
    /// the last segment.
    ///
    /// The error is of second order in the segment length, because the clamped cross-section is at
    /// the node.
    #[default]
    Wall,
    /// Last node and frame of the last segment. The first half segment then remains straight.
    NodeAndFrame,
    /// Last two nodes and frame of the last segment, which cannot stretch.
    TwoNodesAndFrame,
    /// Last node only; the end can rotate.
    Pin,
}

/// Bodies held by a clamp.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HeldBodies {
    /// Indices of the points.
    pub points: Range<usize>,
    /// Indices of the frames.
    pub frames: Range<usize>,
}

impl RodClamp {
    /// Returns `true` if the rod needs a wall frame at the clamped end.
    pub fn needs_wall(self) -> bool {
        self == Self::Wall
    }

    /// Holds an end and returns the held bodies.
    ///
    /// # Errors
    /// If the clamp is [`Wall`](Self::Wall) and the end has no wall frame.
    pub fn hold(
        self,
        layout: &RodLayout,
        end: End,
        state: &mut State,
    ) -> Result<HeldBodies, RodError> {
        let frame = match self {
            Self::Wall => layout.wall(end).ok_or(RodError::NoWall(end))?,
            Self::NodeAndFrame | Self::TwoNodesAndFrame | Self::Pin => layout.end_frame(end),
        };
        let nodes = match self {
            Self::Wall | Self::NodeAndFrame | Self::Pin => 1,
            Self::TwoNodesAndFrame => 2,
        };
        let Range { start, end: past } = layout.points();
        let points = match end {
            End::Start => start..start + nodes,
            End::End => past - nodes..past,
        };
        let frames = frame..frame + usize::from(self != Self::Pin);
        points.clone().for_each(|i| state.points.hold(i));
        frames.clone().for_each(|i| state.frames.hold(i));
        Ok(HeldBodies { points, frames })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{StraightRod, Walls};

    fn held(clamp: RodClamp, end: End) -> (Vec<usize>, Vec<usize>) {
        let rod = StraightRod {
            walls: Walls {
                start: end == End::Start && clamp.needs_wall(),
                end: end == End::End && clamp.needs_wall(),
            },
            ..StraightRod::uniform(3, 10.0)
        };
        let mut state = State::default();
        let layout = rod.push(&mut state).unwrap();
        let held = clamp.hold(&layout, end, &mut state).unwrap();
        let points: Vec<_> = (0..state.points.len())
            .filter(|&i| !state.points.is_free(i))
            .collect();
        let frames: Vec<_> = (0..state.frames.len())
            .filter(|&i| !state.frames.is_free(i))
            .collect();
        assert!(held.points.eq(points.clone()));
        assert!(held.frames.eq(frames.clone()));
        (points, frames)
    }

    #[test]
    fn each_clamp_holds_its_bodies() {
        use RodClamp::{NodeAndFrame, Pin, TwoNodesAndFrame, Wall};
        assert_eq!(held(Pin, End::Start), (vec![0], vec![]));
        assert_eq!(held(Pin, End::End), (vec![3], vec![]));
        assert_eq!(held(Wall, End::Start), (vec![0], vec![0]));
        assert_eq!(held(Wall, End::End), (vec![3], vec![3]));
        assert_eq!(held(NodeAndFrame, End::Start), (vec![0], vec![0]));
        assert_eq!(held(NodeAndFrame, End::End), (vec![3], vec![2]));
        assert_eq!(held(TwoNodesAndFrame, End::Start), (vec![0, 1], vec![0]));
        assert_eq!(held(TwoNodesAndFrame, End::End), (vec![2, 3], vec![2]));
    }

    #[test]
    fn a_wall_clamp_needs_a_wall() {
        let mut state = State::default();
        let layout = StraightRod::uniform(1, 1.0).push(&mut state).unwrap();
        for end in [End::Start, End::End] {
            let error = RodClamp::Wall.hold(&layout, end, &mut state).unwrap_err();
            assert_eq!(error, RodError::NoWall(end));
        }
    }
}

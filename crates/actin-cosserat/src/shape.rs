//! Puts a rod that stands on a state into another shape.

use crate::{RodEnd, RodError, RodLayout};
use actin_mechanics::{State, UnitQuaternion, Vector3, rotation};

/// The least rotation of lab z into a direction; `None` where it has none.
pub(crate) fn from_z(direction: Vector3) -> Option<UnitQuaternion> {
    let length = direction.norm();
    if !(length.is_finite() && length > 0.0) {
        return None;
    }
    let unit = direction / length;
    // Of all half turns that lead to -z this one is as good as any.
    let half_turn = || rotation::exp(Vector3::x() * std::f64::consts::PI);
    Some(UnitQuaternion::rotation_between(&Vector3::z(), &unit).unwrap_or_else(half_turn))
}

impl RodLayout {
    /// Bends and twists the rod to the given curvatures (rad/nm, body axes) without stretch or
    /// shear, from its first node and its first frame on, which stay: that of the wall if there is
    /// one at the start.
    ///
    /// `curvature` is asked at the rest arc length of each bending element (nm from node 0).
    ///
    /// ```
    /// use actin_cosserat::{State, StraightRod, Vector3};
    /// use std::f64::consts::PI;
    /// let mut state = State::default();
    /// let rod = StraightRod::uniform(100, 1.0).push(&mut state)?;
    /// // A full circle about d2: of 100 segments the last ends where the first begins.
    /// rod.bend(&mut state, |_| Vector3::y() * (2.0 * PI / 100.0))?;
    /// let x = &state.points.position;
    /// assert!((x.get(100) - x.get(0)).norm() < 1e-12);
    /// # Ok::<(), actin_cosserat::RodError>(())
    /// ```
    ///
    /// # Errors
    /// A curvature that is not finite; the state is then unchanged.
    ///
    /// # Panics
    /// If `state` does not have the rod's bodies.
    pub fn bend(
        &self,
        state: &mut State,
        curvature: impl Fn(f64) -> Vector3,
    ) -> Result<(), RodError> {
        let places = &self.element_positions()[self.segments()..];
        let elements = places.iter().zip(self.voronoi_lengths());
        let turn = |(&s, &distance): (&f64, &f64)| {
            let angle = curvature(s) * distance;
            let is_finite = angle.iter().all(|a| a.is_finite());
            is_finite.then_some(angle).ok_or(RodError::Curvature { s })
        };
        let turns: Vec<Vector3> = elements.map(turn).collect::<Result<_, _>>()?;
        for (first, turn) in self.bending_chain().zip(turns) {
            let q = state.frames.orientation.get(first) * rotation::exp(turn);
            state.frames.orientation.set(first + 1, q);
        }
        let bodies = self.points().zip(self.frames());
        for ((node, frame), &length) in bodies.zip(self.segment_lengths()) {
            let along = state.frames.orientation.get(frame) * Vector3::z() * length;
            let next = state.points.position.get(node) + along;
            state.points.position.set(node + 1, next);
        }
        Ok(())
    }

    /// Puts the nodes to the given places (nm, lab frame), and the segments' frames along the
    /// lines between them, each turned from the one before by the least rotation; a wall frame at
    /// the start stays, one at the end follows the last segment.
    ///
    /// Rest lengths stay as they are: where the places are further apart, the rod is stretched.
    ///
    /// # Errors
    /// Not one place per node, or places of neighbours that have no direction between them; the
    /// state is then unchanged.
    ///
    /// # Panics
    /// If `state` does not have the rod's bodies.
    pub fn place(&self, state: &mut State, nodes: &[Vector3]) -> Result<(), RodError> {
        let (given, needed) = (nodes.len(), self.points().len());
        if given != needed {
            return Err(RodError::Nodes { given, needed });
        }
        let mut q = state.frames.orientation.get(self.bending_chain().start);
        let mut orientations = Vec::with_capacity(self.segments());
        for (segment, pair) in nodes.windows(2).enumerate() {
            let body = q.inverse_transform_vector(&(pair[1] - pair[0]));
            q *= from_z(body).ok_or(RodError::NoDirection { segment })?;
            orientations.push(q);
        }
        for (node, &place) in self.points().zip(nodes) {
            state.points.position.set(node, place);
        }
        for (frame, &q) in self.frames().zip(&orientations) {
            state.frames.orientation.set(frame, q);
        }
        if let Some(wall) = self.wall(RodEnd::End) {
            state.frames.orientation.set(wall, q);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{BendingElement, RodClamp, ShearElement, StraightRod};

    fn helix(s: f64) -> Vector3 {
        Vector3::new(0.01, 0.002 * s, -0.03)
    }

    /// What is asked for is there: the curvature of each element, and no strain of any segment;
    /// an element that is off by one, or a wall that is left out, would show.
    #[test]
    fn a_bent_rod_has_the_curvatures_that_it_was_given() {
        for end in [RodEnd::Start, RodEnd::End] {
            let mut state = State::default();
            let rod = StraightRod::uniform(5, 2.0);
            let layout = rod.push_clamped(RodClamp::Wall, end, &mut state).unwrap();
            layout.bend(&mut state, helix).unwrap();
            let q = |i| state.frames.orientation.get(i);
            let places = &layout.element_positions()[5..];
            for (k, a) in layout.bending_chain().take(5).enumerate() {
                let rest_distance = layout.voronoi_lengths()[k];
                let kappa = BendingElement { rest_distance }.curvature(q(a), q(a + 1));
                assert!((kappa - helix(places[k])).norm() < 1e-14);
            }
            for (i, frame) in layout.points().zip(layout.frames()) {
                let x = &state.points.position;
                let sigma = ShearElement::segment(2.0).strain(q(frame), x.get(i + 1) - x.get(i));
                assert!(sigma.norm() < 1e-14);
            }
        }
    }

    #[test]
    fn a_curvature_that_is_not_finite_leaves_the_state_alone() {
        let mut state = State::default();
        let layout = StraightRod::uniform(3, 1.0).push(&mut state).unwrap();
        let before = state.clone();
        let curvature = |s: f64| Vector3::x() * if s > 1.5 { f64::NAN } else { 0.1 };
        let refused = layout.bend(&mut state, curvature);
        assert_eq!(refused, Err(RodError::Curvature { s: 2.0 }));
        assert_eq!(state, before);
    }

    /// Nodes are where they were put, segments lie along them, and nothing twists on the way.
    #[test]
    fn a_rod_is_placed_along_its_nodes() {
        let mut state = State::default();
        let layout = StraightRod::uniform(3, 1.0).push(&mut state).unwrap();
        let nodes = [
            Vector3::zeros(),
            Vector3::z(),
            Vector3::new(0.0, 1.0, 1.0),
            Vector3::new(0.0, 1.0, 0.0),
        ];
        layout.place(&mut state, &nodes).unwrap();
        for (k, frame) in layout.frames().enumerate() {
            let q = state.frames.orientation.get(frame);
            assert_eq!(state.points.position.get(k), nodes[k]);
            assert!((q * Vector3::z() - (nodes[k + 1] - nodes[k])).norm() < 1e-15);
            assert!((q * Vector3::x() - Vector3::x()).norm() < 1e-15);
        }
        let before = state.clone();
        let (given, needed) = (3, 4);
        let error = layout.place(&mut state, &nodes[..3]).unwrap_err();
        assert_eq!(error, RodError::Nodes { given, needed });
        let error = layout.place(&mut state, &[nodes[1]; 4]).unwrap_err();
        assert_eq!(error, RodError::NoDirection { segment: 0 });
        assert_eq!(state, before);
    }
}

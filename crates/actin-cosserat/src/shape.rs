//! Changes of the shape of a rod in a state.

use crate::{End, RodError, RodLayout};
use actin_mechanics::{State, UnitQuaternion, Vector3, rotation};

/// Smallest rotation of lab z to a direction, or `None` if the direction is zero or not finite.
pub(crate) fn from_z(direction: Vector3) -> Option<UnitQuaternion> {
    let length = direction.norm();
    if !(length.is_finite() && length > 0.0) {
        return None;
    }
    let unit = direction / length;
    // All half turns to -z are equally small.
    let half_turn = || rotation::exp(Vector3::x() * std::f64::consts::PI);
    Some(UnitQuaternion::rotation_between(&Vector3::z(), &unit).unwrap_or_else(half_turn))
}

impl RodLayout {
    /// Bends and twists the rod to the given curvatures (rad/nm, body axes) without stretch and
    /// shear.
    ///
    /// The first node and the first frame (the start wall, if any) keep their positions.
    /// `curvature` is evaluated at the rest arc length of each bending element (nm).
    ///
    /// ```
    /// use actin_cosserat::{State, StraightRod, Vector3};
    /// use std::f64::consts::PI;
    /// let mut state = State::default();
    /// let rod = StraightRod::uniform(100, 1.0).push(&mut state)?;
    /// // A full circle about d2: the end of the last segment meets the first node.
    /// rod.bend(&mut state, |_| Vector3::y() * (2.0 * PI / 100.0))?;
    /// let x = &state.points.position;
    /// assert!((x.get(100) - x.get(0)).norm() < 1e-12);
    /// # Ok::<(), actin_cosserat::RodError>(())
    /// ```
    ///
    /// # Errors
    /// If a curvature is not finite. The state is unchanged on error.
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

    /// Moves the nodes to the given positions (nm, lab frame) and aligns the segments' frames.
    ///
    /// Each frame is the smallest rotation of the preceding one. A wall frame at the start is
    /// unchanged; a wall frame at the end follows the last segment.
    ///
    /// # Errors
    /// If there is not one position per node, or if neighbouring positions coincide or are not
    /// finite. The state is unchanged on error.
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
        if let Some(wall) = self.wall(End::End) {
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

    #[test]
    fn a_bent_rod_has_the_prescribed_curvatures() {
        for end in [End::Start, End::End] {
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
    fn an_invalid_curvature_does_not_change_the_state() {
        let mut state = State::default();
        let layout = StraightRod::uniform(3, 1.0).push(&mut state).unwrap();
        let before = state.clone();
        let curvature = |s: f64| Vector3::x() * if s > 1.5 { f64::NAN } else { 0.1 };
        let refused = layout.bend(&mut state, curvature);
        assert_eq!(refused, Err(RodError::Curvature { s: 2.0 }));
        assert_eq!(state, before);
    }

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

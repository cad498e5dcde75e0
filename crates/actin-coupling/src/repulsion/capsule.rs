//! A stretch of filament with a round cross-section, and how it follows bodies.

use actin_mechanics::{Coordinates, Loads, Matrix3, State, Vector3};
use thiserror::Error;

/// Distance of neighbouring points of the axis over the radius, at most.
const SPACING: f64 = 1.0 / 3.0;

/// Bodies that the two ends of a capsule's axis follow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Axis {
    /// Two points, one at each end.
    Points([usize; 2]),
    /// A point and a frame: ends at `x + Q b` with two arms `b` (nm, body frame).
    Body {
        /// The point.
        point: usize,
        /// The frame.
        frame: usize,
        /// The arms of the two ends.
        arms: [Vector3; 2],
    },
}

/// A straight stretch of the axis of a filament.
#[derive(Clone, Debug, PartialEq)]
pub struct Capsule {
    axis: Axis,
    /// Length at rest (nm).
    length: f64,
    /// Which filament, and arc length of its middle (nm).
    filament: usize,
    middle: f64,
    /// Contour (nm) within which it does not touch its own filament.
    reach: f64,
}

/// A number of a repulsion that was refused.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("{key} = {value}: must be {rule}")]
pub struct RepulsionError {
    /// Which number.
    pub key: &'static str,
    /// What it was.
    pub value: f64,
    /// What it must be.
    pub rule: &'static str,
}

/// Refuses a number that is not positive and finite.
pub(super) fn positive(key: &'static str, value: f64) -> Result<(), RepulsionError> {
    let rule = "positive and finite";
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    Err(RepulsionError { key, value, rule })
}

impl Capsule {
    /// A capsule of a filament, with its length at rest and the arc length of its middle (nm).
    ///
    /// # Errors
    /// A length that is not positive and finite.
    pub fn new(
        axis: Axis,
        length: f64,
        (filament, middle): (usize, f64),
    ) -> Result<Self, RepulsionError> {
        positive("length", length)?;
        Ok(Self {
            axis,
            length,
            filament,
            middle,
            reach: 0.0,
        })
    }

    /// The same where bonds or bending couple its filament over a contour (nm): within it the two do not repel.
    #[must_use]
    pub fn with_reach(self, reach: f64) -> Self {
        Self { reach, ..self }
    }

    /// Whether two may touch: of one filament they are as far apart along it as each asks, and `apart` (nm).
    pub(super) fn may_touch(&self, other: &Self, apart: f64) -> bool {
        self.contour_between(other) >= apart.max(self.reach).max(other.reach)
    }

    /// The filament that it belongs to.
    pub fn filament(&self) -> usize {
        self.filament
    }

    /// Arc length of its middle (nm).
    pub fn middle(&self) -> f64 {
        self.middle
    }

    /// Length at rest (nm).
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Length of filament between two capsules of one filament (nm); infinite between filaments.
    pub(super) fn contour_between(&self, other: &Self) -> f64 {
        if self.filament != other.filament {
            return f64::INFINITY;
        }
        (self.middle - other.middle).abs() - 0.5 * (self.length + other.length)
    }

    /// The ends of its axis (nm, lab frame).
    pub fn ends(&self, state: &State) -> [Vector3; 2] {
        let x = &state.points.position;
        match self.axis {
            Axis::Points(points) => points.map(|i| x.get(i)),
            Axis::Body { point, frame, arms } => {
                let (x, q) = (x.get(point), state.frames.orientation.get(frame));
                arms.map(|arm| x + q * arm)
            }
        }
    }

    /// A body that it follows.
    pub(super) fn body(&self) -> Coordinates {
        match self.axis {
            Axis::Points([first, _]) => Coordinates::Point(first),
            Axis::Body { point, .. } => Coordinates::Point(point),
        }
    }

    /// Adds what forces at the two ends (pN, lab frame) do to the bodies.
    pub(super) fn add_forces(&self, forces: [Vector3; 2], state: &State, loads: &mut Loads) {
        match self.axis {
            Axis::Points(points) => {
                for (i, force) in points.into_iter().zip(forces) {
                    loads.force.add(i, force);
                }
            }
            Axis::Body { point, frame, arms } => {
                loads.force.add(point, forces[0] + forces[1]);
                let q = state.frames.orientation.get(frame);
                for (arm, force) in arms.into_iter().zip(forces) {
                    let torque = arm.cross(&q.inverse_transform_vector(&force));
                    loads.torque.add(frame, torque);
                }
            }
        }
    }

    /// The two bodies, each with the derivatives of the two ends by its coordinates.
    pub(super) fn slopes(&self, state: &State) -> [(Coordinates, [Matrix3; 2]); 2] {
        let (unit, zero) = (Matrix3::identity(), Matrix3::zeros());
        match self.axis {
            Axis::Points([a, b]) => [
                (Coordinates::Point(a), [unit, zero]),
                (Coordinates::Point(b), [zero, unit]),
            ],
            Axis::Body { point, frame, arms } => {
                let q = state.frames.orientation.get(frame).to_rotation_matrix();
                let turns = arms.map(|arm| -(q.matrix() * arm.cross_matrix()));
                [
                    (Coordinates::Point(point), [unit, unit]),
                    (Coordinates::Frame(frame), turns),
                ]
            }
        }
    }

    /// The second derivative, by the turn of its frame, of the work `g0 . r0 + g1 . r1` of fixed
    /// vectors at the ends: `(c b^T + b c^T) / 2 - (c . b) 1` with `c = Q^T g`; none without a frame.
    pub(super) fn curvature_of_work(
        &self,
        g: [Vector3; 2],
        state: &State,
    ) -> Option<(Coordinates, Matrix3)> {
        let Axis::Body { frame, arms, .. } = self.axis else {
            return None;
        };
        let q = state.frames.orientation.get(frame);
        let of = |(arm, g): (Vector3, Vector3)| {
            let product = q.inverse_transform_vector(&g) * arm.transpose();
            0.5 * (product + product.transpose()) - Matrix3::from_diagonal_element(product.trace())
        };
        let block = arms.into_iter().zip(g).map(of).sum();
        Some((Coordinates::Frame(frame), block))
    }
}

/// Points of a capsule's axis, evenly spaced, each standing for the same length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Row {
    /// How many there are.
    pub(super) count: usize,
    /// What each stands for (nm).
    pub(super) weight: f64,
}

impl Row {
    /// The points of a capsule of a radius (nm).
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a positive number; memory runs out long before the conversion saturates"
    )]
    pub(super) fn of(capsule: &Capsule, radius: f64) -> Self {
        let count = (capsule.length / (SPACING * radius)).ceil().max(1.0);
        Self {
            count: count as usize,
            weight: capsule.length / count,
        }
    }

    /// Where point `k` is, as a share of the length.
    pub(super) fn share(&self, k: usize) -> f64 {
        (k as f64 + 0.5) / self.count as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Parts of a filament touch from its own reach on, whatever other filaments ask for.
    #[test]
    fn each_filament_has_its_own_reach() {
        let capsule = |filament: usize, middle: f64, reach: f64| {
            let axis = Axis::Points([0, 1]);
            Capsule::new(axis, 5.0, (filament, middle))
                .unwrap()
                .with_reach(reach)
        };
        let (one, near, far) = (
            capsule(0, 0.0, 15.0),
            capsule(0, 19.0, 15.0),
            capsule(0, 21.0, 15.0),
        );
        assert!(!one.may_touch(&near, 11.0) && one.may_touch(&far, 11.0));
        assert!(!one.may_touch(&far, 17.0) && !one.may_touch(&capsule(0, 21.0, 30.0), 11.0));
        assert!(one.may_touch(&capsule(1, 0.0, 300.0), 11.0));
    }
}

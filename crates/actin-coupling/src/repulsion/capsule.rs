use crate::site::curvature_of_work;
use actin_mechanics::{Coordinates, Loads, Matrix3, State, Stiffness, Vector3};
use thiserror::Error;

/// Largest distance of integration points relative to the radius.
const SPACING: f64 = 1.0 / 3.0;

/// Distance from contact within which capsules are part of the stiffness, in radii.
pub(super) const MARGIN: f64 = 0.25;

/// Bodies that define the ends of the axis of a capsule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Axis {
    /// Points at the two ends.
    Points([usize; 2]),
    /// Point and frame: the ends are `x + Q b` with two arms `b` (nm, body frame).
    Body {
        /// Index of the point.
        point: usize,
        /// Index of the frame.
        frame: usize,
        /// Arms of the two ends (nm, body frame).
        arms: [Vector3; 2],
    },
}

/// Straight segment of the axis of a filament.
#[derive(Clone, Debug, PartialEq)]
pub struct Capsule {
    axis: Axis,
    /// Rest length (nm).
    length: f64,
    /// Index of the filament and arc length of the middle (nm).
    filament: usize,
    middle: f64,
    /// Smallest contour distance (nm) of interacting parts of the filament.
    reach: f64,
}

/// Invalid parameter of a repulsion.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("{key} = {value}: must be {rule}")]
pub struct RepulsionError {
    /// Name of the parameter.
    pub key: &'static str,
    /// Rejected value.
    pub value: f64,
    /// Violated rule.
    pub rule: &'static str,
}

pub(super) fn positive(key: &'static str, value: f64) -> Result<(), RepulsionError> {
    let rule = "positive and finite";
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    Err(RepulsionError { key, value, rule })
}

impl Capsule {
    /// Creates a capsule with its rest length (nm), the index of the filament and the arc length of
    /// the middle (nm).
    ///
    /// # Errors
    /// If the length is not positive and finite.
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

    /// Sets the contour distance (nm) within which parts of the same filament do not repel each
    /// other, because bonds or bending rigidity keep them apart.
    #[must_use]
    pub fn with_reach(self, reach: f64) -> Self {
        Self { reach, ..self }
    }

    /// Returns `true` if the contour distance exceeds `apart` (nm) and the limits of both capsules.
    pub(super) fn may_touch(&self, other: &Self, apart: f64) -> bool {
        self.contour_between(other) >= apart.max(self.reach).max(other.reach)
    }

    /// Index of the filament.
    pub fn filament(&self) -> usize {
        self.filament
    }

    /// Arc length of the middle (nm).
    pub fn middle(&self) -> f64 {
        self.middle
    }

    /// Rest length (nm).
    pub(crate) fn length(&self) -> f64 {
        self.length
    }

    /// Contour distance of two capsules (nm); infinite for different filaments.
    pub(super) fn contour_between(&self, other: &Self) -> f64 {
        if self.filament != other.filament {
            return f64::INFINITY;
        }
        (self.middle - other.middle).abs() - 0.5 * (self.length + other.length)
    }

    /// Ends of the axis (nm, lab frame).
    pub(crate) fn ends(&self, state: &State) -> [Vector3; 2] {
        let x = &state.points.position;
        match self.axis {
            Axis::Points(points) => points.map(|i| x.get(i)),
            Axis::Body { point, frame, arms } => {
                let (x, q) = (x.get(point), state.frames.orientation.get(frame));
                arms.map(|arm| x + q * arm)
            }
        }
    }

    pub(super) fn has_no_frame(&self) -> bool {
        matches!(self.axis, Axis::Points(_))
    }

    pub(super) fn body(&self) -> Coordinates {
        match self.axis {
            Axis::Points([first, _]) => Coordinates::Point(first),
            Axis::Body { point, .. } => Coordinates::Point(point),
        }
    }

    /// Adds the loads of forces at the two ends (pN, lab frame).
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

    /// Adds the second derivatives of the energy `-(f0 . r0 + f1 . r1)` of constant forces at the ends
    /// with respect to the rotation of the frame, if there is one.
    pub(super) fn push_curvature(
        &self,
        forces: [Vector3; 2],
        state: &State,
        stiffness: &mut Stiffness,
    ) {
        let Axis::Body { frame, arms, .. } = self.axis else {
            return;
        };
        let q = state.frames.orientation.get(frame);
        let parts = arms.into_iter().zip(forces);
        let block = parts
            .map(|(arm, force)| curvature_of_work(q, -force, arm))
            .sum();
        let frame = Coordinates::Frame(frame);
        stiffness.push_link(frame, frame, block);
    }
}

/// Index of the first end of a capsule, one of its bodies, and the derivatives of both ends with
/// respect to this body.
pub(super) type Follows = (usize, (Coordinates, [Matrix3; 2]));

/// Adds `J^T K J` for each pair of bodies once; `K` has a block for each pair of ends.
pub(super) fn push_blocks<const N: usize>(
    bodies: &[Follows],
    tangents: &[[Matrix3; N]; N],
    stiffness: &mut Stiffness,
) {
    for (k, &(first, (a, slopes_a))) in bodies.iter().enumerate() {
        for (l, &(second, (b, slopes_b))) in bodies.iter().enumerate().skip(k) {
            let mut block = Matrix3::zeros();
            for (e, slope_a) in slopes_a.iter().enumerate() {
                for (f, slope_b) in slopes_b.iter().enumerate() {
                    block += slope_a.transpose() * tangents[first + e][second + f] * slope_b;
                }
            }
            if k == l {
                block = 0.5 * (block + block.transpose());
            } else if a == b {
                // A body and its periodic image: block and transpose are on the diagonal.
                block += block.transpose();
            }
            stiffness.push_link(a, b, block);
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Row {
    /// Number of points.
    pub(super) count: usize,
    /// Length per point (nm).
    pub(super) weight: f64,
}

impl Row {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a positive number; memory runs out long before the conversion saturates"
    )]
    pub(super) fn new(capsule: &Capsule, radius: f64) -> Self {
        let count = (capsule.length / (SPACING * radius)).ceil().max(1.0);
        Self {
            count: count as usize,
            weight: capsule.length / count,
        }
    }

    pub(super) fn share(&self, k: usize) -> f64 {
        (k as f64 + 0.5) / self.count as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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

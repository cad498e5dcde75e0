//! Orthographic camera.

use super::{Matrix3, Vector3};
use serde::Serialize;

/// View direction.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Attitude {
    /// Direction towards the viewer, of any length (lab frame).
    pub towards: [f64; 3],
    /// Upward direction in the picture (lab frame); must not be along the line of sight.
    pub up: [f64; 3],
}

impl Attitude {
    /// Lab z to the right, lab x upwards, seen slightly from above.
    pub const HORIZONTAL: Self = Self {
        towards: [0.35, 1.0, 0.15],
        up: [1.0, 0.0, 0.0],
    };
    /// Lab z upwards.
    pub const VERTICAL: Self = Self {
        towards: [-0.35, -1.0, 0.25],
        up: [0.0, 0.0, 1.0],
    };
}

/// An orthographic camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Rows: right, up, and towards the viewer (lab frame).
    pub(super) rotation: Matrix3,
    /// Point in the middle of the area (nm, lab frame).
    target: Vector3,
    /// Middle of the area (pixels).
    centre: [f64; 2],
    per_nm: f64,
    /// Largest distance from the target (nm).
    reach: f64,
}

impl Camera {
    /// Creates a camera that fits all `balls`, each a centre and a radius (nm, lab frame), into an area, given by left,
    /// top, width and height (pixels).
    pub fn fitted(
        attitude: Attitude,
        balls: impl IntoIterator<Item = (Vector3, f64)>,
        [left, top, width, height]: [f64; 4],
    ) -> Self {
        let towards = Vector3::from(attitude.towards).normalize();
        let right = Vector3::from(attitude.up).cross(&towards).normalize();
        let rotation = Matrix3::from_columns(&[right, towards.cross(&right), towards]).transpose();
        let infinite = Vector3::repeat(f64::INFINITY);
        let (low, high) = balls
            .into_iter()
            .map(|(centre, radius)| (rotation * centre, Vector3::repeat(radius)))
            .fold((infinite, -infinite), |(low, high), (c, r)| {
                (low.inf(&(c - r)), high.sup(&(c + r)))
            });
        let half = 0.5 * (high - low);
        Self {
            rotation,
            target: rotation.transpose() * (low + half),
            centre: [left + 0.5 * width, top + 0.5 * height],
            per_nm: (0.5 * width / half.x).min(0.5 * height / half.y),
            reach: half.norm(),
        }
    }

    /// Rotates the camera about an axis (lab frame) through its target by `angle` (rad).
    #[must_use]
    pub fn turned(&self, axis: Vector3, angle: f64) -> Self {
        let turn = nalgebra::Rotation3::new(axis.normalize() * -angle);
        Self {
            rotation: self.rotation * turn,
            ..*self
        }
    }

    /// Returns the scale in pixels per nm.
    pub fn per_nm(&self) -> f64 {
        self.per_nm
    }

    /// Transforms a point to camera coordinates (nm): right, up, towards the viewer.
    pub(super) fn see(&self, point: Vector3) -> Vector3 {
        self.turn(point - self.target)
    }

    pub(super) fn turn(&self, v: Vector3) -> Vector3 {
        self.rotation * v
    }

    /// Returns the position in the picture (pixels, right and down).
    pub(super) fn pixel(&self, point: Vector3) -> [f64; 2] {
        self.pixel_of(self.see(point))
    }

    /// Returns the position of a point in camera coordinates in the picture (pixels, right and down).
    pub(super) fn pixel_of(&self, seen: Vector3) -> [f64; 2] {
        [
            self.centre[0] + self.per_nm * seen.x,
            self.centre[1] - self.per_nm * seen.y,
        ]
    }

    /// Returns the depth beyond the target, from 0 at the target to 1 at the largest distance.
    pub(super) fn remoteness(&self, point: Vector3) -> f64 {
        (-self.see(point).z / self.reach).clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Seen from +y with x upwards, z points to the right. A fitted scene touches two edges, and the target stays in
    /// the middle when the camera turns.
    #[test]
    fn places_are_seen_where_they_must() {
        let attitude = Attitude {
            towards: [0.0, 3.0, 0.0],
            up: [1.0, 0.0, 0.0],
        };
        let places = [Vector3::new(0.0, 0.0, -50.0), Vector3::new(3.0, 0.0, 70.0)];
        let area = [10.0, 0.0, 640.0, 420.0];
        let camera = Camera::fitted(attitude, places.map(|p| (p, 5.0)), area);
        let scale = 640.0 / 130.0;
        assert!((camera.per_nm() - scale).abs() < 1e-12);
        for (place, x) in places.into_iter().zip([-60.0, 60.0]) {
            let [right, down] = camera.pixel(place);
            let up = scale * (place.x - 1.5);
            assert!(
                (right - (330.0 + scale * x)).abs() < 1e-9 && (down - (210.0 - up)).abs() < 1e-9
            );
        }
        let seen = camera.see(camera.target + Vector3::new(2.0, 4.0, 7.0));
        assert!((seen - Vector3::new(7.0, 2.0, 4.0)).norm() < 1e-12);
        let turned = camera.turned(Vector3::x(), 0.3);
        assert!(turned.see(camera.target).norm() < 1e-12);
        // A body on the line of sight moves to the left if the camera moves to the right.
        assert!(turned.see(camera.target + Vector3::y()).x < -0.29);
    }
}

//! Orthographic camera.

use super::Vector3;

/// An orthographic camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Right, up, and towards the viewer (lab frame).
    pub(super) rows: [Vector3; 3],
    pub(super) target: Vector3,
    /// Pixels per nm in the finished picture.
    pub(super) per_nm: f64,
    /// Largest distance from the target along the line of sight (nm).
    pub(super) reach: f64,
}

impl Camera {
    /// Creates a camera with `target` in the middle of the picture, and a scale in pixels per nm. All bodies must be
    /// within `reach` (nm) of the target, and `up` must not be parallel to `towards_viewer`.
    pub fn new(
        towards_viewer: Vector3,
        up: Vector3,
        target: Vector3,
        per_nm: f64,
        reach: f64,
    ) -> Self {
        let towards = towards_viewer.normalize();
        let right = up.cross(&towards).normalize();
        Self {
            rows: [right, towards.cross(&right), towards],
            target,
            per_nm,
            reach,
        }
    }

    /// Creates a camera in which all `places` with a `margin` (nm) fit into a picture, of which `foot` pixels at the
    /// bottom remain free.
    pub fn fitted(
        [towards_viewer, up]: [Vector3; 2],
        places: &[Vector3],
        margin: f64,
        [width, height, foot]: [f64; 3],
    ) -> Self {
        let mut camera = Self::new(towards_viewer, up, Vector3::zeros(), 1.0, 1.0);
        let seen: Vec<Vector3> = places.iter().map(|&p| camera.turn(p)).collect();
        let low = seen
            .iter()
            .fold(Vector3::repeat(f64::INFINITY), |a, b| a.inf(b));
        let high = seen
            .iter()
            .fold(Vector3::repeat(f64::NEG_INFINITY), |a, b| a.sup(b));
        let half = (high - low) * 0.5 + Vector3::repeat(margin);
        let middle = (low + high) * 0.5;
        camera.per_nm = (0.5 * width / half.x).min(0.5 * (height - 2.0 * foot) / half.y);
        camera.target = camera.lab(middle);
        camera.reach = half.norm();
        camera
    }

    /// Rotates the camera about an axis (lab frame) through its target by `angle` (rad).
    #[must_use]
    pub fn turned(&self, axis: Vector3, angle: f64) -> Self {
        let turn = nalgebra::Rotation3::new(axis.normalize() * angle);
        Self {
            rows: self.rows.map(|row| turn * row),
            ..*self
        }
    }

    /// Transforms a point to camera coordinates (nm): right, up, towards the viewer.
    pub(super) fn see(&self, point: Vector3) -> Vector3 {
        self.turn(point - self.target)
    }

    pub(super) fn turn(&self, v: Vector3) -> Vector3 {
        Vector3::from(self.rows.map(|row| row.dot(&v)))
    }

    fn lab(&self, seen: Vector3) -> Vector3 {
        let [right, up, towards] = self.rows;
        right * seen.x + up * seen.y + towards * seen.z
    }

    /// Returns the scale in pixels per nm.
    pub fn per_nm(&self) -> f64 {
        self.per_nm
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Seen from +y with x upwards, z points to the right. A fitted scene touches two edges.
    #[test]
    fn places_are_seen_where_they_must() {
        let [towards, up] = [Vector3::y(), Vector3::x()];
        let camera = Camera::new(towards, up, Vector3::new(1.0, 2.0, 3.0), 5.0, 10.0);
        let seen = camera.see(Vector3::new(2.0, 4.0, 7.0));
        assert!((seen - Vector3::new(4.0, 1.0, 2.0)).norm() < 1e-15);
        let places = [Vector3::new(0.0, 0.0, -50.0), Vector3::new(3.0, 0.0, 70.0)];
        let camera = Camera::fitted([towards, up], &places, 5.0, [640.0, 480.0, 30.0]);
        assert!((camera.per_nm() - 640.0 / 130.0).abs() < 1e-12);
        for place in places {
            let seen = camera.see(place);
            assert!((seen.x.abs() - 60.0).abs() < 1e-12 && seen.y.abs() < 1.5 + 1e-12);
        }
        let turned = camera.turned(up, 0.3);
        assert!(turned.see(camera.target).norm() < 1e-12);
    }
}

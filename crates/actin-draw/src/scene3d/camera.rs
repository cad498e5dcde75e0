//! Perspective camera.

use super::Vector3;

/// View direction of a panel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Direction from the middle of the scene to the viewer, of any length.
    pub towards_viewer: Vector3,
    /// Upward direction in the picture; must not be along the line of sight.
    pub up: Vector3,
}

/// A pinhole camera. Picture coordinates are `(right, up) / depth`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Camera {
    eye: Vector3,
    right: Vector3,
    up: Vector3,
    forward: Vector3,
}

impl Camera {
    pub(super) fn new(view: &View, target: Vector3, distance: f64) -> Self {
        let forward = -view.towards_viewer.normalize();
        let right = forward.cross(&view.up).normalize();
        Self {
            eye: target - forward * distance,
            right,
            up: right.cross(&forward),
            forward,
        }
    }

    pub(super) fn turn(&self, v: Vector3) -> Vector3 {
        Vector3::new(v.dot(&self.right), v.dot(&self.up), v.dot(&self.forward))
    }

    pub(super) fn see(&self, point: Vector3) -> Vector3 {
        self.turn(point - self.eye)
    }

    pub(super) fn project(&self, point: Vector3) -> [f64; 2] {
        let seen = self.see(point);
        [seen.x / seen.z, seen.y / seen.z]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Seen from +x at a distance of 10 with z upwards, +y points to the right. At depth 5 lengths are doubled.
    #[test]
    fn a_known_point_lands_where_it_must() {
        let view = View {
            towards_viewer: Vector3::x() * 3.0,
            up: Vector3::z(),
        };
        let camera = Camera::new(&view, Vector3::zeros(), 10.0);
        let cases = [
            (Vector3::zeros(), [0.0, 0.0]),
            (Vector3::new(0.0, 1.0, 2.0), [0.1, 0.2]),
            (Vector3::new(5.0, 1.0, 2.0), [0.2, 0.4]),
        ];
        for (point, [x, y]) in cases {
            let place = camera.project(point);
            // Round-off of numbers of order 1.
            assert!((place[0] - x).abs() < 1e-15 && (place[1] - y).abs() < 1e-15);
        }
    }
}

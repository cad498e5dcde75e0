//! Where the viewer stands, and how points become places in the picture.

use super::Vector3;

/// From where a panel is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// From the middle of the scene towards the viewer; of any length.
    pub towards_viewer: Vector3,
    /// What points upwards in the picture; not along the line of sight.
    pub up: Vector3,
}

/// A pinhole camera. Places in the picture are `(right, up) / depth`, so that a length `a` at
/// depth `d` across the line of sight measures `a / d`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Camera {
    eye: Vector3,
    right: Vector3,
    up: Vector3,
    forward: Vector3,
}

impl Camera {
    /// Looks at `target` from `distance` away.
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

    /// A direction as the camera sees it: right, up, forward.
    pub(super) fn turn(&self, v: Vector3) -> Vector3 {
        Vector3::new(v.dot(&self.right), v.dot(&self.up), v.dot(&self.forward))
    }

    /// A point as the camera sees it: right, up, depth.
    pub(super) fn see(&self, point: Vector3) -> Vector3 {
        self.turn(point - self.eye)
    }

    /// Place of a point in the picture.
    pub(super) fn project(&self, point: Vector3) -> [f64; 2] {
        let seen = self.see(point);
        [seen.x / seen.z, seen.y / seen.z]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Seen from +x at 10 with z up, +y lies to the right; at depth 5 lengths count double.
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

//! Outlines of ellipsoids (ellipses) and cylinders (convex hulls) in the picture.

use super::camera::Camera;
use super::{Matrix3, Vector3};

#[derive(Clone, Copy, Debug)]
pub(super) struct Ellipse {
    pub centre: [f64; 2],
    /// Semi-axes, the larger first.
    pub semi_axes: [f64; 2],
    /// Angle of the larger axis from the horizontal, counter-clockwise (rad).
    pub angle: f64,
}

/// Returns the outline of the ellipsoid whose semi-axes are the columns of `semi_axes` (lab frame). It must be in
/// front of the camera.
///
/// ```text
/// [M - c c^T, -c; -c^T, -1]   dual quadric of the ellipsoid (its tangent planes), M = A A^T
/// M - c c^T                   dual conic of the outline (its tangent lines)
/// c, A                        centre and semi-axes in camera coordinates
/// ```
///
/// # Source
/// Hartley and Zisserman, Multiple View Geometry, 2nd ed., section 8.3.
pub(super) fn ellipsoid(camera: &Camera, centre: Vector3, semi_axes: &Matrix3) -> Ellipse {
    let columns: Vec<Vector3> = semi_axes
        .column_iter()
        .map(|axis| camera.turn(axis.into_owned()))
        .collect();
    let axes = Matrix3::from_columns(&columns);
    let c = camera.see(centre);
    let conic = axes * axes.transpose() - c * c.transpose();
    let scale = -1.0 / conic[(2, 2)];
    let middle = [-scale * conic[(0, 2)], -scale * conic[(1, 2)]];
    let spread = |i: usize, j: usize| scale * conic[(i, j)] + middle[i] * middle[j];
    let (xx, xy, yy) = (spread(0, 0), spread(0, 1), spread(1, 1));
    let (mean, half) = (0.5 * (xx + yy), (0.5 * (xx - yy)).hypot(xy));
    Ellipse {
        centre: middle,
        semi_axes: [(mean + half).sqrt(), (mean - half).max(0.0).sqrt()],
        angle: 0.5 * (2.0 * xy).atan2(xx - yy),
    }
}

impl Ellipse {
    pub(super) fn bounds(&self) -> [[f64; 2]; 2] {
        let (sin, cos) = self.angle.sin_cos();
        let [a, b] = self.semi_axes;
        let half = [(a * cos).hypot(b * sin), (a * sin).hypot(b * cos)];
        let [x, y] = self.centre;
        [[x - half[0], y - half[1]], [x + half[0], y + half[1]]]
    }
}

const RIM: usize = 72;

/// Returns the rim of a disc (nm, lab frame).
pub(super) fn rim(centre: Vector3, normal: Vector3, radius: f64) -> Vec<Vector3> {
    let aside = if normal.x.abs() < 0.9 * normal.norm() {
        Vector3::x()
    } else {
        Vector3::y()
    };
    let u = normal.cross(&aside).normalize() * radius;
    let v = normal.normalize().cross(&u);
    (0..RIM)
        .map(|k| {
            let (sin, cos) = (k as f64 * std::f64::consts::TAU / RIM as f64).sin_cos();
            centre + u * cos + v * sin
        })
        .collect()
}

/// Returns the convex hull, counter-clockwise. The outline of a cylinder is the hull of its projected rims.
pub(super) fn hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let chain = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for p in points {
            while let [.., a, b] = chain[..]
                && (b[0] - a[0]) * (p[1] - a[1]) <= (b[1] - a[1]) * (p[0] - a[0])
            {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut lower = chain(&mut points.iter().copied());
    lower.extend(chain(&mut points.iter().rev().copied()));
    lower
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene3d::camera::View;
    use nalgebra::Rotation3;

    #[test]
    fn the_outline_is_that_of_the_sampled_surface() {
        let view = View {
            towards_viewer: Vector3::new(1.0, -2.0, 0.5),
            up: Vector3::z(),
        };
        let camera = Camera::new(&view, Vector3::new(2.0, 1.0, -1.0), 9.0);
        let turn = Rotation3::new(Vector3::new(0.3, 0.8, -0.4));
        let semi_axes = turn.into_inner() * Matrix3::from_diagonal(&Vector3::new(1.9, 2.7, 1.2));
        let centre = Vector3::new(0.5, 0.2, 0.3);
        let ellipse = ellipsoid(&camera, centre, &semi_axes);
        let mut surface = Vec::new();
        for i in 0..=600 {
            let (sin, cos) = (std::f64::consts::PI * f64::from(i) / 600.0).sin_cos();
            for j in 0..1200 {
                let (s, c) = (std::f64::consts::TAU * f64::from(j) / 1200.0).sin_cos();
                let unit = Vector3::new(sin * c, sin * s, cos);
                surface.push(camera.project(centre + semi_axes * unit));
            }
        }
        let (sin, cos) = ellipse.angle.sin_cos();
        for k in 0..24 {
            let (n_y, n_x) = (f64::from(k) * 0.27).sin_cos();
            let sampled = surface.iter().map(|p| n_x * p[0] + n_y * p[1]);
            let sampled = sampled.fold(f64::NEG_INFINITY, f64::max);
            let [a, b] = ellipse.semi_axes;
            let reach = (a * (n_x * cos + n_y * sin)).hypot(b * (n_y * cos - n_x * sin));
            let outline = n_x * ellipse.centre[0] + n_y * ellipse.centre[1] + reach;
            // Samples are 0.005 rad apart, which causes an error of at most the square of half of it.
            assert!((outline - sampled).abs() < 1e-5 && outline >= sampled - 1e-12);
        }
        let image = camera.project(centre);
        assert!((image[0] - ellipse.centre[0]).hypot(image[1] - ellipse.centre[1]) > 1e-3);
    }

    #[test]
    fn a_hull_keeps_corners_only() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let mut points = square.to_vec();
        points.extend([[0.5, 0.5], [0.5, 0.0], [0.2, 0.9]]);
        assert_eq!(hull(points), square);
    }
}

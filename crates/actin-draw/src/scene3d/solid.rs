//! Solids in space, and how they are drawn.

use super::camera::Camera;
use super::svg::{Canvas, Paint, Rim, Stroke};
use super::{Matrix3, Vector3};
use crate::Colour;

/// A solid (nm, lab frame).
#[derive(Clone, Debug, PartialEq)]
pub enum Solid {
    /// An ellipsoid.
    Ellipsoid {
        /// Centre.
        centre: Vector3,
        /// Semi-axes as columns.
        semi_axes: Matrix3,
    },
    /// A cylinder with flat ends, which may be oblique.
    Cylinder {
        /// Centres of its ends.
        ends: [Vector3; 2],
        /// Radius.
        radius: f64,
        /// Normals of the end planes, towards the second end.
        normals: [Vector3; 2],
        /// Direction of a stripe at each end, which is drawn on both sides; zero for no stripe.
        stripe: [Vector3; 2],
    },
    /// A flat polygon.
    Plate {
        /// Corners in order.
        corners: Vec<Vector3>,
    },
    /// A disc with a radius in pixels.
    Dot {
        /// Centre.
        at: Vector3,
        /// Radius in pixels.
        pixels: f64,
    },
    /// A line.
    Line {
        /// End points.
        ends: [Vector3; 2],
        /// Style of the line.
        stroke: Stroke,
    },
    /// An arrow.
    Arrow {
        /// Start and tip.
        ends: [Vector3; 2],
        /// Style of the line.
        stroke: Stroke,
    },
}

/// A solid with its appearance.
#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// Shape and position.
    pub solid: Solid,
    /// Colour; lines and arrows have the colour of their stroke.
    pub colour: Colour,
    /// Opacity from 0 to 1.
    pub opacity: f64,
    /// Depth offset towards the viewer (nm).
    pub nearer_nm: f64,
}

/// Fraction of white in the colour of the farthest solid.
const HAZE: f64 = 0.5;
/// Number of shades of haze.
const SHADES: f64 = 6.0;
/// Half the angle of a stripe (rad).
const STRIPE: f64 = 0.35;

impl Item {
    /// Creates an opaque solid without depth offset.
    pub fn new(solid: Solid, colour: Colour) -> Self {
        Self {
            solid,
            colour,
            opacity: 1.0,
            nearer_nm: 0.0,
        }
    }

    /// Creates a line.
    pub fn line(ends: [Vector3; 2], stroke: Stroke) -> Self {
        Self::new(Solid::Line { ends, stroke }, stroke.colour)
    }

    /// Creates an arrow.
    pub fn arrow(ends: [Vector3; 2], stroke: Stroke) -> Self {
        Self::new(Solid::Arrow { ends, stroke }, stroke.colour)
    }

    /// Creates a disc with a radius in pixels.
    pub fn dot(at: Vector3, pixels: f64, colour: Colour) -> Self {
        Self::new(Solid::Dot { at, pixels }, colour)
    }

    /// Sets the opacity.
    #[must_use]
    pub fn with_opacity(self, opacity: f64) -> Self {
        Self { opacity, ..self }
    }

    /// Sets the depth offset (nm).
    #[must_use]
    pub fn nearer(self, nearer_nm: f64) -> Self {
        Self { nearer_nm, ..self }
    }

    pub(super) fn depth(&self, camera: &Camera) -> f64 {
        camera.see(self.solid.middle()).z + self.nearer_nm
    }

    pub(super) fn paint(&self, camera: &Camera, canvas: &mut Canvas) {
        let remoteness = camera.remoteness(self.solid.middle());
        let white = HAZE * (SHADES * remoteness).round() / SHADES;
        let paint = Paint {
            fill: self.colour.lighter(white),
            opacity: self.opacity,
        };
        let hazy = |stroke: &Stroke| Stroke {
            colour: stroke.colour.lighter(white),
            ..*stroke
        };
        let pixel = |p: &Vector3| camera.pixel(*p);
        match &self.solid {
            Solid::Ellipsoid { centre, semi_axes } => {
                let (semi_axes, angle) = outline(&(camera.rotation * semi_axes));
                let semi_axes = semi_axes.map(|a| a * camera.per_nm());
                // The y axis of pixels points down, which reverses angles.
                canvas.ball(pixel(centre), semi_axes, -angle.to_degrees(), paint);
            }
            Solid::Dot { at, pixels } => canvas.dot(pixel(at), *pixels, paint),
            Solid::Line { ends, stroke } => {
                canvas.line(ends.each_ref().map(pixel), hazy(stroke), self.opacity);
            }
            Solid::Arrow { ends, stroke } => {
                canvas.arrow(ends.each_ref().map(pixel), hazy(stroke));
            }
            Solid::Plate { corners } => {
                canvas.polygon(&corners.iter().map(pixel).collect::<Vec<_>>(), paint);
            }
            Solid::Cylinder { .. } => paint_cylinder(&self.solid, camera, paint, canvas),
        }
    }
}

impl Solid {
    fn middle(&self) -> Vector3 {
        match self {
            Self::Ellipsoid { centre, .. } => *centre,
            Self::Dot { at, .. } => *at,
            Self::Cylinder { ends, .. } | Self::Line { ends, .. } | Self::Arrow { ends, .. } => {
                0.5 * (ends[0] + ends[1])
            }
            Self::Plate { corners } => corners.iter().sum::<Vector3>() / corners.len() as f64,
        }
    }

    /// Returns balls that enclose the solid: centres and radii (nm).
    pub fn balls(&self) -> Vec<(Vector3, f64)> {
        match self {
            Self::Ellipsoid { centre, semi_axes } => {
                let lengths = semi_axes.column_iter().map(|axis| axis.norm());
                vec![(*centre, lengths.fold(0.0, f64::max))]
            }
            Self::Dot { at, .. } => vec![(*at, 0.0)],
            Self::Line { ends, .. } | Self::Arrow { ends, .. } => ends.map(|end| (end, 0.0)).into(),
            Self::Cylinder { ends, radius, .. } => ends.map(|end| (end, *radius)).into(),
            Self::Plate { corners } => corners.iter().map(|&corner| (corner, 0.0)).collect(),
        }
    }
}

/// Returns the outline of an ellipsoid whose semi-axes are the columns of a matrix in camera coordinates: semi-axes,
/// the larger first, and the angle of the larger one from the horizontal, counter-clockwise (rad).
///
/// The outline of a matrix A has the squared widths `n A A^T n` along unit vectors n in the plane of the picture.
fn outline(semi_axes: &Matrix3) -> ([f64; 2], f64) {
    let spread = semi_axes * semi_axes.transpose();
    let (xx, xy, yy) = (spread[(0, 0)], spread[(0, 1)], spread[(1, 1)]);
    let (mean, half) = (0.5 * (xx + yy), (0.5 * (xx - yy)).hypot(xy));
    (
        [(mean + half).sqrt(), (mean - half).max(0.0).sqrt()],
        0.5 * (2.0 * xy).atan2(xx - yy),
    )
}

/// A cylinder in camera coordinates.
struct Tube {
    ends: [Vector3; 2],
    axis: Vector3,
    normals: [Vector3; 2],
}

impl Tube {
    /// Returns the point of the rim in the direction of `arm`, from the centre of end `k`.
    fn rim(&self, k: usize, arm: Vector3) -> Vector3 {
        let normal = self.normals[k];
        arm - self.axis * (arm.dot(&normal) / self.axis.dot(&normal))
    }
}

fn paint_cylinder(solid: &Solid, camera: &Camera, paint: Paint, canvas: &mut Canvas) {
    let Solid::Cylinder {
        ends,
        radius,
        normals,
        stripe,
    } = solid
    else {
        return;
    };
    let tube = Tube {
        ends: ends.map(|end| camera.see(end)),
        axis: camera.turn(ends[1] - ends[0]).normalize(),
        normals: normals.map(|normal| camera.turn(normal)),
    };
    let flat = tube.axis.xy().norm();
    // Along and across the cylinder in the picture, clockwise, and towards the viewer.
    let along = if flat > 1e-9 {
        Vector3::new(tube.axis.x, tube.axis.y, 0.0) / flat
    } else {
        Vector3::x()
    };
    let across = Vector3::new(along.y, -along.x, 0.0);
    let front = across.cross(&tube.axis);
    let scale = camera.per_nm();
    let rims = [0, 1].map(|k| Rim {
        at: scale * (tube.ends[k] - tube.ends[0]).dot(&along),
        side: scale * tube.rim(k, *radius * across).dot(&along),
        front: scale * tube.rim(k, *radius * front).dot(&along).abs(),
    });
    let place = (
        camera.pixel(ends[0]),
        (-along.y).atan2(along.x).to_degrees(),
    );
    let near = usize::from(tube.axis.z > 0.0);
    canvas.cylinder(place, scale * radius, &rims, near, paint);
    let arms = stripe.map(|d| *radius * camera.turn(d));
    for side in [1.0, -1.0] {
        if let Some(corners) = stripe_corners(&tube, arms.map(|arm| side * arm)) {
            canvas.highlight(&corners.map(|p| camera.pixel_of(p)), paint.opacity);
        }
    }
}

/// Returns the corners of the visible part of a stripe. `arms` are the vectors from the axis to the stripe at both ends.
fn stripe_corners(tube: &Tube, arms: [Vector3; 2]) -> Option<[Vector3; 4]> {
    let middle = arms[0] + arms[1];
    // The surface faces the viewer within a quarter of a turn of this angle from the stripe.
    let facing = tube.axis.cross(&middle).z.atan2(middle.z);
    let quarter = std::f64::consts::FRAC_PI_2;
    let (from, to) = (
        (facing - quarter).max(-STRIPE),
        (facing + quarter).min(STRIPE),
    );
    let edge = |k: usize, angle: f64| {
        let arm = arms[k] * angle.cos() + tube.axis.cross(&arms[k]) * angle.sin();
        tube.ends[k] + tube.rim(k, arm)
    };
    let is_visible = middle.norm() > 0.0 && from < to;
    is_visible.then(|| [edge(0, from), edge(0, to), edge(1, to), edge(1, from)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Rotation3;

    #[test]
    fn outline_encloses_the_sampled_surface() {
        let turn = Rotation3::new(Vector3::new(0.3, 0.8, -0.4));
        let semi_axes = turn.into_inner() * Matrix3::from_diagonal(&Vector3::new(1.9, 2.7, 1.2));
        let ([a, b], angle) = outline(&semi_axes);
        let mut surface = Vec::new();
        for i in 0..=300 {
            let (sin, cos) = (std::f64::consts::PI * f64::from(i) / 300.0).sin_cos();
            for j in 0..600 {
                let (s, c) = (std::f64::consts::TAU * f64::from(j) / 600.0).sin_cos();
                surface.push(semi_axes * Vector3::new(sin * c, sin * s, cos));
            }
        }
        let (sin, cos) = angle.sin_cos();
        for k in 0..24 {
            let (n_y, n_x) = (f64::from(k) * 0.27).sin_cos();
            let sampled = surface.iter().map(|p| n_x * p.x + n_y * p.y);
            let sampled = sampled.fold(f64::NEG_INFINITY, f64::max);
            let reach = (a * (n_x * cos + n_y * sin)).hypot(b * (n_y * cos - n_x * sin));
            // Samples are 0.01 rad apart, which causes a relative error of at most the square of half of it.
            assert!((reach - sampled).abs() < 2e-4 && reach >= sampled - 1e-12);
        }
    }
}

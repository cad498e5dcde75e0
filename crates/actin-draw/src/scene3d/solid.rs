//! Solids in space, and how they are drawn.

use super::camera::Camera;
use super::frame::Frame;
use super::outline::{self, hull, rim};
use super::svg::{Canvas, Paint, Stroke};
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
    /// A cylinder with flat ends.
    Cylinder {
        /// Centres of its ends.
        ends: [Vector3; 2],
        /// Radius.
        radius: f64,
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
        camera.see(self.solid.middle()).norm() - self.nearer_nm
    }
}

impl Solid {
    pub(super) fn middle(&self) -> Vector3 {
        match self {
            Self::Ellipsoid { centre, .. } => *centre,
            Self::Dot { at, .. } => *at,
            Self::Cylinder { ends, .. } | Self::Line { ends, .. } | Self::Arrow { ends, .. } => {
                0.5 * (ends[0] + ends[1])
            }
            Self::Plate { corners } => corners.iter().sum::<Vector3>() / corners.len() as f64,
        }
    }

    /// Returns points in the picture that enclose the solid.
    pub(super) fn extent(&self, camera: &Camera) -> Vec<[f64; 2]> {
        match self {
            Self::Ellipsoid { centre, semi_axes } => outline::ellipsoid(camera, *centre, semi_axes)
                .bounds()
                .into(),
            Self::Dot { at, .. } => vec![camera.project(*at)],
            Self::Line { ends, .. } | Self::Arrow { ends, .. } => {
                ends.map(|end| camera.project(end)).into()
            }
            Self::Cylinder { ends, radius } => {
                let rims = ends
                    .iter()
                    .flat_map(|&end| rim(end, ends[1] - ends[0], *radius));
                rims.map(|p| camera.project(p)).collect()
            }
            Self::Plate { corners } => corners.iter().map(|&p| camera.project(p)).collect(),
        }
    }

    pub(super) fn paint(&self, item: &Item, frame: &Frame, canvas: &mut Canvas) {
        let paint = Paint {
            fill: item.colour,
            opacity: item.opacity,
        };
        let pixel = |p: &Vector3| frame.pixel(frame.camera.project(*p));
        match self {
            Self::Ellipsoid { centre, semi_axes } => {
                let ellipse = outline::ellipsoid(&frame.camera, *centre, semi_axes);
                let semi_axes = ellipse.semi_axes.map(|a| a * frame.scale);
                // The y axis of pixels points down, which reverses angles.
                let angle = -ellipse.angle.to_degrees();
                canvas.ball(frame.pixel(ellipse.centre), semi_axes, angle, paint);
            }
            Self::Dot { at, pixels } => canvas.dot(pixel(at), *pixels, paint),
            Self::Line { ends, stroke } => {
                canvas.line(ends.each_ref().map(pixel), *stroke, item.opacity);
            }
            Self::Arrow { ends, stroke } => canvas.arrow(ends.each_ref().map(pixel), *stroke),
            Self::Plate { corners } => {
                canvas.polygon(&corners.iter().map(pixel).collect::<Vec<_>>(), paint);
            }
            Self::Cylinder { ends, radius } => paint_cylinder(*ends, *radius, paint, frame, canvas),
        }
    }
}

/// Draws the outline of a cylinder, then the end that faces the viewer.
fn paint_cylinder(
    ends: [Vector3; 2],
    radius: f64,
    paint: Paint,
    frame: &Frame,
    canvas: &mut Canvas,
) {
    let axis = ends[1] - ends[0];
    let rims = ends.map(|end| {
        let rim = rim(end, axis, radius).into_iter();
        let rim = rim.map(|p| frame.pixel(frame.camera.project(p)));
        rim.collect::<Vec<_>>()
    });
    canvas.polygon(&hull(rims.concat()), paint);
    let near = usize::from(frame.camera.see(ends[1]).norm() < frame.camera.see(ends[0]).norm());
    let fill = paint.fill.lighter(0.35);
    canvas.polygon(&rims[near], Paint { fill, ..paint });
}

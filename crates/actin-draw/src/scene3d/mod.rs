//! Orthographic drawings of solids as SVG.
//!
//! A [`Sheet`] contains panels and a legend. A [`Panel`] contains solids and labels, seen by a [`Camera`]. Outlines are
//! exact projections. Solids are drawn in the order of the depths of their centres (painter's algorithm), and lighter
//! with depth.

mod camera;
mod labels;
mod panel;
mod sheet;
mod solid;
mod svg;

pub use camera::{Attitude, Camera};
pub use labels::Label;
pub use panel::Panel;
pub use sheet::{Key, Sheet};
pub use solid::{Item, Solid};
pub use svg::Stroke;

/// Vector with three components.
pub type Vector3 = nalgebra::Vector3<f64>;
/// Matrix with three rows and columns.
pub type Matrix3 = nalgebra::Matrix3<f64>;

//! Perspective drawings of solids as SVG.
//!
//! A [`Sheet`] contains panels and a legend. A [`Panel`] contains solids and labels, and fits them into its area.
//! Outlines are exact projections. Solids are drawn in the order of the distances of their centres (painter's
//! algorithm).

mod camera;
mod frame;
mod labels;
mod outline;
mod panel;
mod sheet;
mod solid;
mod svg;

pub use camera::View;
pub use labels::Label;
pub use panel::Panel;
pub use sheet::{Key, Sheet};
pub use solid::{Item, Solid};
pub use svg::Stroke;

/// Vector with three components.
pub type Vector3 = nalgebra::Vector3<f64>;
/// Matrix with three rows and columns.
pub type Matrix3 = nalgebra::Matrix3<f64>;

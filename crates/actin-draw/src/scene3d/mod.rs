//! A small renderer: solids in space, seen in perspective, painted back to front into an SVG.
//!
//! A [`Sheet`] holds panels and a legend; a [`Panel`] holds solids and labels and chooses scale
//! and place so that all of them fit. Outlines are exact projections; what hides what is decided
//! solid by solid, by the distance of its middle.

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

/// A vector of three components.
pub type Vector3 = nalgebra::Vector3<f64>;
/// A matrix of three rows and three columns.
pub type Matrix3 = nalgebra::Matrix3<f64>;

//! A small renderer: solids in space, seen in perspective, painted back to front into an SVG.
//!
//! A [`Sheet`] holds panels and a legend; a [`Panel`] holds solids and labels and chooses scale
//! and place so that all of them fit. Outlines are exact projections; what hides what is decided
//! solid by solid, by the distance of its middle. Nothing here knows of filaments.

mod camera;
mod colour;
mod labels;
mod outline;
mod panel;
mod sheet;
mod solid;
mod svg;

pub(super) use camera::View;
pub(super) use colour::Colour;
pub(super) use labels::Label;
pub(super) use panel::Panel;
pub(super) use sheet::{Key, Sheet};
pub(super) use solid::{Item, Solid, Stroke};

//! Pictures and pages for numbers: line charts, scatters, solids in space, and a report that sets
//! computed numbers beside expected ones.
//!
//! - [`Chart`] and [`Scatter`] are drawn into SVG files.
//! - [`scene3d`] draws ellipsoids, cylinders, lines and labels in perspective, as SVG.
//! - [`raster`] draws solids into PNG pictures.
//! - [`report`] holds rows of numbers with what they are compared with, and reads and writes them.
//! - [`page`] puts pictures, rows and text into one HTML file without links to anything outside.
//! - [`space`] has the scripts of views that a reader turns.
//! - [`browser`](fn@browser) finds what prints and tests pages.
//! - [`Ramp`] and the sets of [`lines`] are colours that keep their differences on white paper.
//!
//! Nothing here knows what is drawn: shapes, numbers and texts come from the caller.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod browser;
mod colour;
pub mod page;
mod palette;
mod plot;
pub mod raster;
pub mod report;
mod scatter;
pub mod scene3d;
pub mod space;

pub use browser::browser;
pub use colour::Colour;
pub use nalgebra;
pub use palette::{Ramp, lines};
pub use plot::{Chart, Series};
pub use scatter::{Scatter, ScatterPoint};

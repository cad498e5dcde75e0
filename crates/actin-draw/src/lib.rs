//! Line charts, scatter plots, 3D scenes, and reports that compare computed numbers with expected ones.
//!
//! - [`Chart`] and [`Scatter`] write SVG files.
//! - [`scene3d`] draws ellipsoids, cylinders, lines and labels in perspective, as SVG.
//! - [`raster`] renders solids to PNG pictures.
//! - [`report`] reads and writes rows of numbers with reference values.
//! - [`page`] combines pictures, rows and text in a self-contained HTML file.
//! - [`space`] contains scripts of interactive 3D views.
//! - [`browser`](fn@browser) finds the browser that prints and tests pages.
//! - [`Ramp`] and [`OKABE_ITO`] are colours that are distinguishable on white paper, also for the colour-blind.
//!
//! This crate is independent of actin: shapes, numbers and texts are provided by the caller.

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
pub use palette::{OKABE_ITO, Ramp};
pub use plot::{Chart, Series};
pub use scatter::{Scatter, ScatterPoint};

//! Line charts, scatter plots, 3D scenes, and reports that compare computed numbers with expected ones.
//!
//! - [`Chart`] and [`Scatter`] write SVG files.
//! - [`scene3d`] draws ellipsoids, cylinders, lines and labels as SVG.
//! - [`png`](fn@png) converts SVG pictures to PNG.
//! - [`report`] reads and writes rows of numbers with reference values.
//! - [`page`] combines pictures, rows and text in a self-contained HTML file.
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
mod plot;
mod png;
pub mod report;
mod scatter;
pub mod scene3d;

pub use browser::browser;
pub use colour::{Colour, OKABE_ITO, Ramp};
pub use nalgebra;
pub use plot::{Chart, Mark, Series};
pub use png::png;
pub use scatter::{Scatter, ScatterPoint};

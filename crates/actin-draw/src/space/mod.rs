//! Scripts for pages that show solids which a reader turns: what they are made of, and the camera.
//!
//! [`SOLIDS`] draws ellipsoids and tubes with WebGL 2; [`SPACE`], which needs it, is a view with mouse, touch
//! and keys, scale bar and axes. What is seen comes from scripts of the caller's.

/// The script that draws solids.
pub const SOLIDS: &str = include_str!("solids.js");
/// The script of a view that can be turned.
pub const SPACE: &str = include_str!("space.js");

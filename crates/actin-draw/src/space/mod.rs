//! Scripts of interactive 3D views.
//!
//! [`SOLIDS`] draws ellipsoids and tubes with WebGL 2. [`SPACE`], which requires it, is a view with camera, input,
//! scale bar and axes. Scripts of the caller provide the solids.

/// Script that draws solids.
pub const SOLIDS: &str = include_str!("solids.js");
/// Script of an interactive view.
pub const SPACE: &str = include_str!("space.js");

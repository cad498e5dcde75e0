//! Software rendering of ellipsoids, tubes and lines to PNG pictures, in the style of the scripts of
//! [`space`](crate::space).
//!
//! A [`Canvas`] has an orthographic [`Camera`]. Solids are drawn in any order; [`Canvas::finish`] adds outlines,
//! ambient occlusion and haze.
//!
//! ```
//! use actin_draw::raster::{Camera, Canvas};
//! use actin_draw::scene3d::{Matrix3, Vector3};
//! let camera = Camera::new(Vector3::y(), Vector3::x(), Vector3::zeros(), 4.0, 20.0);
//! let mut canvas = Canvas::new([80, 60], camera);
//! canvas.ellipsoid(Vector3::zeros(), Matrix3::identity() * 5.0, [200, 30, 30], 0.0);
//! let picture = canvas.finish([255; 3]);
//! assert_eq!(picture.pixel(0, 0), [255; 3]);
//! assert!(picture.pixel(40, 30)[0] > 100 && picture.pixel(40, 30)[1] < 100);
//! ```

mod camera;
mod canvas;
mod finish;
mod letters;
mod picture;
mod tube;

pub use camera::Camera;
pub use canvas::Canvas;
pub use picture::Picture;
pub use tube::TubeStyle;

use crate::scene3d::{Matrix3, Vector3};

//! Visualisation of runs: interactive pages of a run directory, films, and views of states for reports.
//!
//! - [`Run::open`] reads a run directory, which may be incomplete. [`Run::page`] makes a self-contained HTML page,
//!   and [`Film`] writes pictures.
//! - [`Pose`] contains the visible bodies of a state; [`states`] writes several for comparison in a report.
//! - [`Drawing`] makes the solids of a picture.
//! - [`Palette`] contains the colours.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod drawing;
mod film;
mod outlines;
mod palette;
mod pose;
mod run;
pub mod states;
mod trade;

pub use actin_draw as draw;
pub use actin_draw::scene3d::Attitude;
pub use actin_sim as sim;
pub use drawing::{Drawing, INSIDE_NM};
pub use film::Film;
pub use palette::{BodyColours, Palette};
pub use pose::{Bonds, Pose, Rod, Strand, bodies};
pub use run::{Limits, Run, ViewError, is_page};
pub use states::ViewState;
pub use trade::draw_trade;

/// Script that converts a pose to solids; it requires [`SPACE`](actin_draw::page::SPACE).
pub const BODIES: &str = include_str!("js/bodies.js");
/// Script of views of states; it requires [`BODIES`].
pub const STATES: &str = include_str!("js/states.js");

//! Looking at runs: a page that plays through the records of a run directory, films of it, and views of
//! states for report pages.
//!
//! - [`Run::open`] finds what there is in a run directory, finished, interrupted or damaged; [`Run::page`]
//!   makes one HTML file of it that needs nothing else, [`Film`] pictures one after the other.
//! - [`Pose`] is what is seen of a state; [`states`] are poses to be compared in a report.
//! - [`Palette`] has the colours of all of them.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod film;
mod palette;
mod pose;
mod run;
pub mod states;
mod trade;

pub use actin_draw as draw;
pub use actin_sim as sim;
pub use film::Film;
pub use palette::{Palette, Things};
pub use pose::{Bonds, Pose, Rod, Strand, bodies};
pub use run::{Limits, Run, ViewError, is_page};
pub use states::{Attitude, Shown};
pub use trade::draw_trade;

/// The script that makes solids of bodies; it needs those of [`space`](actin_draw::space).
pub const BODIES: &str = include_str!("js/bodies.js");
/// The script of views of states; it needs [`BODIES`].
pub const STATES: &str = include_str!("js/states.js");

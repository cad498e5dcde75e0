//! Runs of actin filaments as files that other programs open.
//!
//! [`export`] writes a run that [`FinishedRun`] has opened in a [`Format`]; [`write_gsd`] and
//! [`write_simularium`] write into anything. A run loses nothing by this: its directory stays as it is, and
//! single precision is that of these formats. What the bodies are is decided in one place ([`Particles`]); each
//! format has a folder of its own that knows how its file is laid out. No physics is here.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod error;
mod extent;
mod file;
mod gsd;
mod particles;
mod simularium;

pub use actin_sim as sim;
pub use actin_sim::{FinishedRun, FinishedRunError};
pub use error::ExportError;
pub use file::{Format, export};
pub use gsd::write_gsd;
pub use particles::{Bond, BondKind, Particles, Shape, Species};
pub use simularium::{simularium_meshes, write_simularium};

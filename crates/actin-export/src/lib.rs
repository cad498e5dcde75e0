//! Export of runs of actin filaments to files of other programs.
//!
//! [`export`] writes a [`FinishedRun`] to a file in a [`Format`]. Positions are stored in single precision, and the
//! run directory is not changed.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod error;
mod extent;
mod file;
mod gsd;
mod particles;
mod simularium;

pub use actin_rundir as rundir;
use actin_rundir::FinishedRun;
pub use actin_sim as sim;
pub use error::ExportError;
pub use file::{Format, export};
pub(crate) use gsd::write_gsd;
pub(crate) use particles::{BondKind, Particles, Shape};
pub(crate) use simularium::{simularium_meshes, write_simularium};

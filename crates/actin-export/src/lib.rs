//! Runs of actin filaments in the formats of other programs: GSD, Simularium and VTK.
//!
//! A [`Format`] writes all [`RecordedStates`] of a run to one file, in single precision. [`VtkPictures`] writes one
//! file for each state, in double precision.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod extent;
mod format;
mod gsd;
mod particles;
mod simularium;
mod states;
mod vtk;

pub use actin_sim as sim;
pub use format::Format;
pub use states::{RecordedStates, StateStream};
pub use vtk::{PARAVIEW_SCRIPT, VtkPictures, write_collection};

use particles::{BondKind, Particles, Shape};

//! Junctions between monomers and Cosserat rods, linkers, and repulsion of filaments.
//!
//! A [`Junction`] attaches the one or two monomers next to a rod to its end. Each bond shears,
//! stretches, bends and twists like a piece of the rod. It has one junction frame with its own
//! inertia. [`push_junction_frames`] adds these frames to the state, between the frames of the two
//! sections. [`Junction::new`] creates the interaction when all bodies are in the state.
//!
//! A [`Linker`] is a spring from a [`Site`] of a filament to an [`Anchor`] or another site. [`LinkerAngles`] resist its tilt and twist. A
//! [`SwitchedLinker`] can be released and bound at several places. A [`SiteForce`] applies a force
//! at sites. [`repulsion`] contains the contacts between filaments and with walls.
//!
//! # Source
//! Gunaratne, Floyd, Ni, Papoian and Erban, arXiv 2203.01284, Section 3.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod bond;
mod build;
mod error;
mod junction;
mod linker;
mod linker_angles;
mod linker_ends;
mod periodic;
mod random_stress;
pub mod repulsion;
mod site;
mod site_force;
mod switched;

pub use build::push_junction_frames;
pub use error::{JunctionError, LinkerError, LinkerKey};
pub use junction::{AttachedMonomer, Junction, JunctionParts, JunctionSide, JunctionWeight};
pub use linker::Linker;
pub use linker_angles::LinkerAngles;
pub use linker_ends::{Anchor, LinkerEnd};
pub use periodic::{PeriodicCell, PeriodicImage};
pub use site::{RodPlace, Site};
pub use site_force::{ForceKind, SiteForce};
pub use switched::{Hand, SwitchedLinker};

/// Re-export of the crate of rods.
pub use actin_cosserat as cosserat;
pub use actin_cosserat::{
    CrossSection, EnergyGradient, Rigidities, RodLayout, RodMaterial, StraightRod,
};
/// Re-export of the crate of points, frames, loads and interactions.
pub use actin_mechanics as mechanics;
pub use actin_mechanics::{
    Frame, Inertia, InertiaError, Interaction, Loads, Point, State, UnitQuaternion, Vector3,
    rotation,
};

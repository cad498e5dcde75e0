//! What joins filaments: the junction between monomers and a Cosserat rod, and linkers; and what keeps them
//! apart.
//!
//! The last one or two monomers before a rod (or the first after it) are attached to the rod's
//! end, each by one bond that shears, stretches, bends and twists as a piece of the rod does. A
//! bond has one massive frame of its own, the junction frame. In a state these stand between the
//! frames of the two sections: [`push_junction_frames`] puts them there while the filament is
//! being built, [`Junction::new`] makes the interaction once all bodies stand.
//!
//! A [`Linker`] is a spring that holds a [`Site`] of a filament, on monomer or rod, to an [`Anchor`]
//! or to another site; a [`SwitchedLinker`] holds at one of several or not at all; a [`SiteForce`] pulls at sites. [`repulsion`] keeps filaments out of each other and
//! out of walls.
//!
//! Nothing here knows how monomers hold together or where a scene puts a junction or a linker.
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
mod random_stress;
pub mod repulsion;
mod site;
mod site_force;
mod switched;

pub use build::push_junction_frames;
pub use error::{JunctionError, LinkerError, LinkerKey};
pub use junction::{AttachedMonomer, Junction, JunctionParts, JunctionSide, JunctionWeight};
pub use linker::{Anchor, Linker, LinkerEnd};
pub use site::{RodPlace, Site};
pub use site_force::{ForceKind, SiteForce};
pub use switched::SwitchedLinker;

/// The crate of rods, whose ends are joined here.
pub use actin_cosserat as cosserat;
pub use actin_cosserat::{
    CrossSection, EnergyGradient, Rigidities, RodLayout, RodMaterial, StraightRod,
};
/// The crate of points, frames, loads and interactions that filaments are made of.
pub use actin_mechanics as mechanics;
pub use actin_mechanics::{
    Frame, Inertia, InertiaError, Interaction, Loads, Point, State, UnitQuaternion, Vector3,
};

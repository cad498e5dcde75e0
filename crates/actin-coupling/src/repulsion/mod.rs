//! Repulsion between filaments, and between filaments and walls.
//!
//! The axis of a filament is divided into [`Capsule`]s: segments of a rod, or the axial part of
//! each monomer. Both resolutions thus have the same surface. [`Contacts`] repels capsules from
//! each other, also across the faces of a periodic box, and [`WallContact`] repels capsules from a
//! [`Wall`]. [`Tethers`] have the largest possible contact stiffness, which gives a bound for the
//! time step.
//!
//! # Integration along axes
//! The smallest distance of two capsules is not twice differentiable if they are parallel, or if a
//! nearest point is at an end. The energy is therefore a sum over points of both axes, spaced by a
//! third of a radius or less. Like the kernel, it has three continuous derivatives. It is nearly
//! independent of the division into capsules.

mod capsule;
mod contacts;
mod images;
mod kernel;
mod neighbours;
mod pair;
mod passing;
mod tethers;
mod wall;
mod wall_contact;

pub use capsule::{Axis, Capsule, RepulsionError};
pub use contacts::{ContactParameters, Contacts, Gap};
pub use tethers::Tethers;
pub use wall::{Side, Wall};
pub use wall_contact::WallContact;

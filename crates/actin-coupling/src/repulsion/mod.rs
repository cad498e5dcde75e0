//! Repulsion of filaments by one another and by walls, without a rule of when they touch.
//!
//! A filament is a string of [`Capsule`]s along its axis: the segments of a rod, and of each monomer the
//! stretch of axis that it stands for, so that a surface is the same whatever resolves it. [`Contacts`]
//! repels capsules from each other, a [`WallContact`] from a plane or a sphere. [`Tethers`] are as stiff as
//! any contact can be: a time step that is stable with them is stable in contact.
//!
//! # Why the axis is integrated over
//! The least distance of two capsules has no second derivative where they are parallel and where the
//! nearest point comes to an end of one. Both happen all the time in a bundle. Here the energy is a sum
//! over points of both axes, a third to a half of a radius apart, each standing for its length: it is as
//! smooth as its kernel, which has three derivatives that are continuous, and it does not depend on how
//! the axes are divided as long as these points are near each other. Least distances only select what is
//! summed and say how far surfaces are apart.

mod capsule;
mod contacts;
mod distance;
mod kernel;
mod neighbours;
mod pair;
mod passing;
mod tethers;
mod wall;

pub use capsule::{Axis, Capsule, RepulsionError};
pub use contacts::{ContactParameters, Contacts, Gap};
pub use tethers::Tethers;
pub use wall::{Side, Wall, WallContact};

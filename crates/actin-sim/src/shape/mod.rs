//! Shape of a filament: twist, writhe, link, distance from the axis, and local fields.
//!
//! All are functions of a [`Ribbon`]: the centre line as a polyline with a frame on each edge, for
//! every resolution.

pub(crate) mod axis;
mod buckle;
mod linking;
mod profile;
mod ribbon;
mod section_loads;
#[cfg(test)]
mod tests;
mod twist;
mod writhe;

pub(crate) use buckle::{Buckle, resampled};
pub use linking::link;
pub(crate) use linking::{WHOLE, link_is_unknown};
pub(crate) use profile::energy_per_length;
pub use profile::{ProfilePoint, profile, profile_of};
pub use ribbon::Ribbon;
pub(crate) use ribbon::{from_rest, writhe_of};
pub use section_loads::SectionLoad;
pub(crate) use section_loads::{Resultants, SectionLoads};
pub(crate) use twist::twist;
pub(crate) use writhe::extended_writhe;

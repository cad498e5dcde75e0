//! Bodies and interactions of a scene.
//!
//! [`Assembly::build`] is the only place that distinguishes kinds of models; all later code handles
//! points, frames and terms. Bodies are stored filament by filament, in order along the filament:
//! monomers, junction frames, rod nodes and segments.
//!
//! Users depend on `actin-sim`, which re-exports the types of this crate.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod assembly;
mod at;
mod bonded;
mod build;
mod built_axis;
mod cells;
mod contacts;
mod describe;
mod drive;
mod energy_balance;
mod friction;
mod hinge;
mod imperfection;
mod kinetics;
mod lattice;
mod law;
mod linkers;
pub mod memory;
mod model_limits;
mod models;
mod notes;
mod parts;
mod problem;
mod ramp;
mod range;
mod reaction;
mod repulsion;
mod rod;
mod section_choice;
mod several_states;
mod start;
mod turned_ends;
mod unstable_twist;
pub mod whole;

use actin_scene as scene;
use kinetics::SiteTable;
use law::{HeatedSegments, TOO_SHORT, potential};
use parts::InterfaceSampling;
use rod::{Ranges, Rod, TwistWatch};

pub use assembly::Assembly;
pub use at::At;
pub use bonded::JunctionBond;
pub use cells::Cells;
pub use drive::Drive;
pub use energy_balance::{EnergyColumn, EnergyExchange};
pub use kinetics::{COARSEST, Kinetics, LinkerEvent, LinkerEventKind, Log};
pub use model_limits::{ModelLimitExceeded, worst};
pub use models::ellipsoids;
pub use notes::Note;
pub use parts::{
    BodyKind, Counts, FilamentSpan, FrameInfo, Part, PointInfo, Resolution, SectionSpan, Term,
};
pub use problem::problem_at;
pub use ramp::Ramp;
pub use range::{Fluctuations, LawExtrapolation, MeasuredError, RangeWatch};
pub use reaction::{Clamped, Reaction};
pub use repulsion::RepulsionModel;
pub use rod::COARSE_IN_HEAT;
pub use section_choice::SectionChoice;
pub use unstable_twist::{TwistRecords, UnstableTwist};

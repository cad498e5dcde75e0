//! Splitting integrators, drag, thermal noise, and a run loop.
//!
//! A method is a [`Composition`]: a cited table of coefficients of alternating drifts and kicks.
//! One loop, [`advance`], serves all of them, and sees of a system only what
//! [`Split`] shows: drift, kick and damp; in a [`Bath`], [`advance_in`] also
//! agitates. [`largest_frequency`] and
//! [`stable_step`] give the time step. A [`Run`] advances a [`System`], shows
//! synchronised states to [`Observer`]s, and ends by a [`StopRule`], at its last step, when an
//! observer asks for it, or with a [`RunFailure`] that names what broke. At a [`Pause`] it can be left
//! with a [`Checkpoint`], from which [`Run::resume`] goes on to the same bits. A system of one's own that is a
//! [`Split`] runs with [`Run::execute_split`]; what makes the steps of a [`System`] in a way of its own is a
//! [`Stepper`], with the same observers, checkpoints and rules.
//!
//! This crate knows nothing of what the bodies stand for, and never solves for an equilibrium.
//! Times are in ns, lengths in nm, forces in pN, rates in 1/ns.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod bath;
mod checkpoint;
mod composition;
mod diagnosis;
mod drag;
mod error;
mod execution;
mod failure;
mod frequency;
mod lanczos;
mod noise;
mod observer;
mod outcome;
mod own_split;
mod own_step;
mod run;
mod schemes;
mod step;
mod stepper;
mod stop;
mod surroundings;

pub use bath::{Bath, BathError};
pub use checkpoint::{Checkpoint, Pause, Snapshot};
pub use composition::{Composition, CompositionError, Stage};
pub use drag::{Drag, DragError};
pub use error::IntegrationError;
pub use failure::{Body, FailureKind, RunFailure};
pub use frequency::{FrequencyError, KRYLOV_VECTORS, largest_frequency, largest_frequency_with};
pub use noise::Noise;
pub use observer::{Moment, Observer};
pub use outcome::{Reason, RunOutcome};
pub use own_split::{SplitMoment, SplitOutcome};
pub use own_step::{StepFailure, Stepper};
pub use run::{DEFAULT_CHECK_EVERY, DEFAULT_OBSERVE_EVERY, Run, RunSettingError};
pub use schemes::{
    FOREST_RUTH, PEFRL, POSITION_VERLET, SUZUKI, SUZUKI_WEIGHT, UnknownScheme, VEFRL,
    VELOCITY_VERLET,
};
pub use step::{SAFETY, StepError, stable_step};
pub use stepper::{advance, advance_in};
pub use stop::{StopRule, StopRuleError};

/// The crate of points, frames, loads and interactions that are set in motion.
pub use actin_mechanics as mechanics;
pub use actin_mechanics::{
    Frame, Inertia, Interaction, LoadError, Loads, Point, PointLoad, Residual, Split, Spring,
    Springs, State, System, Thermostat, UnitQuaternion, Vector3, Vectors, Weight,
};

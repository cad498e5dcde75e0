//! Splitting integrators, drag, thermal noise, and a run loop.
//!
//! A method is a [`Composition`]: a table of coefficients of alternating drifts and kicks, with its
//! source. [`advance`] applies all methods to any [`Split`] system, and [`advance_in`] to systems
//! in a [`Bath`]. [`largest_frequency`] and [`stable_step`] determine the time step.
//!
//! A [`Run`] advances a [`System`] and calls [`Observer`]s with synchronised states. It ends at its
//! last step, by a [`StopRule`], by an observer, or with a [`RunFailure`]. A run can be interrupted
//! at a [`Pause`] and resumed from a [`Checkpoint`] with bitwise equal results.
//! [`Run::execute_split`] runs custom [`Split`] systems, and [`Run::execute_from`] custom
//! [`Stepper`]s.
//!
//! Times are in ns, lengths in nm, forces in pN, rates in 1/ns.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod bath;
mod checkpoint;
mod composition;
mod diagnosis;
mod drag;
mod environment;
mod error;
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
pub use run::{DEFAULT_CHECK_EVERY, Run, RunSettingError};
pub use schemes::{
    FOREST_RUTH, PEFRL, POSITION_VERLET, SUZUKI, UnknownScheme, VEFRL, VELOCITY_VERLET,
};
pub use step::{SAFETY, StepError, stable_step};
pub use stepper::{advance, advance_in};
pub use stop::{StopRule, StopRuleError};

/// Re-export of the crate of points, frames, loads and interactions.
pub use actin_mechanics as mechanics;
pub use actin_mechanics::{
    Frame, Inertia, Interaction, LoadError, Loads, Point, PointLoad, Residual, Split, Spring,
    Springs, State, System, Thermostat, UnitQuaternion, Vector3, Vectors, Weight,
};

//! Splitting integrators, drag, thermal noise, and a run loop.
//!
//! A method is a [`Composition`]: a cited table of coefficients of alternating drifts and kicks.
//! One loop, [`advance`], serves all of them, and sees of a system only what
//! [`actin_mechanics::Split`] shows: drift, kick and damp; in a [`Bath`], [`advance_in`] also
//! agitates. [`largest_frequency`] and
//! [`stable_step`] give the time step. A [`Run`] advances a [`actin_mechanics::System`], shows
//! synchronised states to [`Observer`]s, and ends by a [`StopRule`], at its last step, when an
//! observer asks for it, or with a [`RunFailure`] that names what broke. At a [`Pause`] it can be left
//! with a [`Checkpoint`], from which [`Run::resume`] goes on to the same bits.
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
mod execution;
mod failure;
mod frequency;
mod lanczos;
mod noise;
mod observer;
mod outcome;
mod run;
mod schemes;
mod step;
mod stepper;
mod stop;
mod surroundings;

pub use bath::{Bath, BathError};
pub use checkpoint::{Checkpoint, Mark, Pause};
pub use composition::{Composition, CompositionError, Stage, UnknownScheme};
pub use drag::{Drag, DragError};
pub use failure::{Body, Problem, RunFailure};
pub use frequency::{FrequencyError, KRYLOV_VECTORS, largest_frequency, largest_frequency_with};
pub use observer::{Moment, Observer};
pub use outcome::{Outcome, Reason, Residual};
pub use run::{DEFAULT_CHECK_EVERY, DEFAULT_OBSERVE_EVERY, Run, RunError};
pub use schemes::{
    FOREST_RUTH, PEFRL, POSITION_VERLET, SUZUKI, SUZUKI_WEIGHT, VEFRL, VELOCITY_VERLET,
};
pub use step::{SAFETY, StepError, stable_step};
pub use stepper::{advance, advance_in};
pub use stop::{StopRule, StopRuleError};

//! Overdamped motion of points and frames in a fluid: friction, and steps that are implicit in the
//! stiffness.
//!
//! [`Friction`] is made of [`Dashpot`]s between bodies and a fluid, at rest or in a [`Flow`]; a [`Cylinder`] says how strong
//! those of a slender body are. [`Brownian`] makes the steps of an `actin_integrate::Run`, with thermal noise or
//! without; [`Langevin`] makes those of bodies with inertia in the same fluid. [`Relaxation`] says what it has to resolve.
//!
//! Fluid is felt locally: what moves does not drag anything else along.
//!
//! This crate knows nothing of what the bodies stand for. Units are nm, pN and ns; a viscosity of
//! 1 mPa s is 1 pN ns/nm^2.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod cylinder;
mod flow;
mod friction;
mod langevin;
mod progress;
mod relaxation;
mod stepper;
mod stress;

pub use cylinder::{Cylinder, CylinderError};
pub use flow::Flow;
pub use friction::{Dashpot, Friction, TurnDashpot};
pub use langevin::Langevin;
pub use relaxation::Relaxation;
pub use stepper::{Brownian, BrownianError, StepLimits};

pub use actin_equilibrium::{BodyOrder, Layout};
/// The crate of the run loop.
pub use actin_integrate as integrate;
pub use actin_integrate::Stepper;
/// The crate of points, frames, loads and interactions that move.
pub use actin_mechanics as mechanics;
pub use actin_mechanics::{
    Frame, Inertia, Interaction, Loads, Point, Spring, Springs, State, System, UnitQuaternion,
    Vector3,
};

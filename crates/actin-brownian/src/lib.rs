//! Overdamped motion of points and frames in a fluid.
//!
//! [`Friction`] consists of [`Dashpot`]s between bodies and a fluid, at rest or in a [`Flow`]. A
//! [`Cylinder`] computes the friction of slender bodies. [`Brownian`] makes the implicit steps of
//! an `actin_integrate::Run`, with or without thermal noise. [`Langevin`] includes inertia.
//! [`Relaxation`] computes relaxation rates for the choice of the time step.
//!
//! Friction is local; hydrodynamic interaction is neglected. Units are nm, pN and ns; a viscosity
//! of 1 mPa s is 1 pN ns/nm^2.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod components;
mod cylinder;
mod flow;
mod friction;
mod langevin;
mod limits;
mod progress;
mod relaxation;
mod stepper;
mod stress;

pub use cylinder::{Cylinder, CylinderError};
pub use flow::Flow;
pub use friction::{Dashpot, Friction, TurnDashpot};
pub use langevin::Langevin;
pub use limits::StepLimits;
pub use relaxation::Relaxation;
pub use stepper::{Brownian, BrownianError};

pub use actin_equilibrium::{BodyOrder, Layout};
/// Re-export of the crate of the run loop.
pub use actin_integrate as integrate;
pub use actin_integrate::Stepper;
/// Re-export of the crate of points, frames, loads and interactions.
pub use actin_mechanics as mechanics;
pub use actin_mechanics::{
    Frame, Inertia, Interaction, Loads, Point, Spring, Springs, State, System, UnitQuaternion,
    Vector3,
};

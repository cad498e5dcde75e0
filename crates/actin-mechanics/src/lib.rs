//! Points, frames, loads and rotations: the mechanics shared by all models.
//!
//! A **point** has a position, a velocity and an inverse mass. A **frame** has an orientation (body
//! to lab), a body angular momentum and the inverse inertia of a symmetric top. A [`State`] stores
//! both as structures of arrays; a [`Motion`] is its time-dependent part. An [`Interaction`] adds
//! its [`Loads`]: forces in the lab frame, torques in the body frame. A [`System`] is a state with
//! its interactions, and implements [`Split`] (drift and kick) for integrators.
//!
//! Any consistent units may be used; other crates use nm, pN and ns.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod controls;
mod couple;
mod drive;
mod energy_balance;
mod frames;
mod inertia;
mod interaction;
mod internal;
mod load;
mod loads;
mod motion;
mod points;
mod quaternions;
mod random;
mod random_stress;
mod residual;
pub mod rotation;
pub mod segments;
mod shared;
mod slider;
mod spring;
mod state;
mod stats;
mod stiffness;
mod sums;
mod system;
#[cfg(any(test, feature = "testing"))]
pub mod testing;
mod vectors;
mod weight;
pub mod wide;

pub use controls::{ControlId, Controls};
pub use couple::{Couple, CoupleKind};
pub use drive::Drive;
pub use energy_balance::EnergyBalance;
pub use frames::{Frame, Frames};
pub use inertia::{Axis, Inertia, InertiaError};
pub use interaction::{Approach, Interaction};
pub use internal::{InternalCouple, InternalForce};
pub use load::{LoadError, PointLoad};
pub use loads::Loads;
pub use motion::Motion;
pub use points::{Point, Points};
pub use quaternions::Quaternions;
pub use random::{Xorshift, perturb, randomise_velocities};
pub use random_stress::{RandomStress, StepStress, correlate};
pub use residual::Residual;
pub use shared::Shared;
pub use slider::Slider;
pub use spring::{Hooke, Spring, SpringError, Springs};
pub use state::State;
pub use stats::StateStats;
pub use stiffness::{Coordinates, SecondOrder, Stiffness};
pub use system::{Split, StepEnd, System, Thermostat};
pub use vectors::Vectors;
pub use weight::Weight;

/// Vector with three components.
pub type Vector3 = nalgebra::Vector3<f64>;
/// 3x3 matrix.
pub type Matrix3 = nalgebra::Matrix3<f64>;
/// Rotation, body to lab, as a unit quaternion.
pub type UnitQuaternion = nalgebra::UnitQuaternion<f64>;

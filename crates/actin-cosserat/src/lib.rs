//! Discrete Cosserat rods, which stretch, shear, bend and twist.
//!
//! A rod of `n` segments consists of `n + 1` points (nodes) and `n` frames (one per segment) of a
//! [`State`]. [`StraightRod`] builds a rod and returns its [`RodLayout`]. [`EnergyGradient`] and
//! [`PaperBalance`] are force laws of rods that are straight at rest; [`RodElements`] supports any
//! rest shape and topology. [`ShearElement`] and [`BendingElement`] are the elements of rods.
//!
//! Units are nm, pN, ns and rad; masses are in pN ns^2/nm = 1e-21 kg. Body axis d3 of a segment's
//! frame points along the rod.
//!
//! # Source
//! Gunaratne, Floyd, Ni, Papoian and Erban, arXiv 2203.01284, Section 2.2; Gazzola et al.,
//! R. Soc. Open Sci. 5 (2018) 171628.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod bending;
mod build;
mod clamp;
pub mod constants;
mod cross_section;
mod elements;
mod end;
mod energy_gradient;
mod error;
mod extended;
mod fast;
mod homogenised;
mod law;
mod layout;
mod material;
mod paper_balance;
mod random_stress;
mod rigidities;
mod shape;
mod shear;
mod strain_laws;

pub use bending::{BendingElement, BendingLoads, BendingStiffness};
pub use build::{RotaryInertia, StraightRod};
pub use clamp::{HeldBodies, RodClamp};
pub use cross_section::CrossSection;
pub use elements::{RodElements, RodJoint, RodSegment};
pub use end::End;
pub use energy_gradient::EnergyGradient;
pub use error::{RodError, RodParameterError};
pub use extended::{EndShear, JoinedElement, SegmentCurvature, SegmentLaw, TwistStability};
pub use homogenised::{Homogenised, HomogenisedForm, PotentialJet, StrainRange, Term};
pub use law::{
    BendLaw, CubicShear, PolynomialStretch, RootedStretch, SidedTwist, Stiffening, StretchLaw,
    TanhTwist, TwistLaw, TwistRise, TwistStretch,
};
pub use layout::{RodLayout, Walls};
pub use material::RodMaterial;
pub use paper_balance::PaperBalance;
pub use rigidities::{Rigidities, RigidityFactors};
pub use shear::{ShearElement, ShearLoads, ShearStiffness};
pub use strain_laws::StrainLaws;

/// Crate of points, frames, loads and interactions.
pub use actin_mechanics as mechanics;
pub use actin_mechanics::{
    Interaction, LoadError, Loads, PointLoad, SecondOrder, Springs, State, System, UnitQuaternion,
    Vector3, Weight,
};

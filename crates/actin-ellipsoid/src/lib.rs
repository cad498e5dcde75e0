//! Actin filaments resolved into monomers: rigid ellipsoids on a helix, joined by harmonic bonds.
//!
//! [`EllipsoidModel`] constructs the [`Helix`], the [`Monomers`] of a range of lattice indices, the
//! [`Interface`] between two neighbours, and the [`Bonds`] that act on a state. Bonds are sampled
//! at random or placed by quadrature ([`Cubature`]).
//!
//! Units are nm, pN, ns and rad; masses are pN ns^2/nm = 1e-21 kg. The body frame of a monomer is
//! its principal frame: x radial, y tangential, z axial.
//!
//! # Source
//! Gunaratne, Floyd, Ni, Papoian and Erban, arXiv 2203.01284, Section 2 and Appendix A.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod bond;
mod bonds;
mod cell;
pub mod constants;
mod cubature;
mod ellipsoid;
mod gap;
mod helix;
mod interface;
mod interface_kind;
mod kernel;
mod model;
mod monomers;
mod parameters;
mod quasi_harmonic;
mod stream;
mod table;

pub use bond::Bond;
pub use bonds::{Bonds, Pair};
pub use cell::{
    Cell, CellError, CellResponse, Control, Displacements, Heat, HeatResponse, Hold, SixMatrix,
    SixVector,
};
pub use cubature::{Cubature, CubatureError, CubaturePoint, MomentCheck};
pub use ellipsoid::Ellipsoid;
pub use helix::{Helix, Neighbour};
pub use interface::{Interface, InterfaceError};
pub use interface_kind::InterfaceKind;
pub use model::EllipsoidModel;
pub use monomers::{LatticeError, Monomers, Placement};
pub use parameters::{
    Anchors, EllipsoidParameterError, EllipsoidParameters, InterfaceParameters, MAX_POINTS,
    MIN_POINTS,
};
pub use quasi_harmonic::{Fluctuations, FluctuationsError, Link, Pose, QuasiHarmonic};

/// Points, frames, loads and interactions.
pub use actin_mechanics as mechanics;
pub use actin_mechanics::{
    Interaction, LoadError, Loads, PointLoad, State, System, UnitQuaternion, Vector3, Weight,
};

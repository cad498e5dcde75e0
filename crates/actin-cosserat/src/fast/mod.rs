//! Vectorised loads of rods.
//!
//! # Scope
//! The reference is the scalar path of [`EnergyGradient`](crate::EnergyGradient). Kernels exist for
//! constant rigidities (also with rest curvature), published twist and length, laws fitted to
//! monomers with cubic or constant shear, and the potential. All other rods, rods with more than
//! eight joined elements, energies and second derivatives use the scalar path.
//!
//! # Data layout
//! Each lane has one element (see `actin_mechanics::wide`). The first and the second bodies of a
//! group of elements are contiguous slices, shifted by one body. The load on the first body is in
//! the right lane; the load on the second is shifted up by one lane
//! ([`ShiftedUp`](actin_mechanics::wide::ShiftedUp)).
//!
//! ```text
//! segments:  y = Q^T l,  sigma = y / |lhat| - e3,  n = n(sigma, kappa)
//!            forces Q n on the first and -Q n on the second node, torque y x n on the frame
//! bending:   theta = log(Qa^T Qb),  m = m(theta / Dhat)
//!            torques even + odd and -(even - odd)
//!            odd = theta x m / 2,  even = m + c theta x (theta x m)
//! ```
//!
//! Without coupling (`separate.rs`), segments and bending elements have separate loops. With
//! coupling (`coupled.rs`), one loop processes a group of segments with the elements *before* them,
//! and adds the conjugate torques of the segments to `m`. Torques on first frames are shifted down
//! ([`ShiftedDown`](actin_mechanics::wide::ShiftedDown)). A wall at the start is the element before
//! the first group. Elements joined to the ends are processed one by one (`ends.rs`).
//!
//! # Laws
//! `laws/` has vectorised parts of laws, tested against the scalar laws. [`Laws`] combines them,
//! and kernels are compiled for each combination. Laws have no branches. Forces in lanes without a
//! body are set to zero, because the published length causes a force at rest.
#![allow(
    clippy::inline_always,
    reason = "vector code must be compiled into the function that enables the instructions"
)]

mod coupled;
mod elements;
mod ends;
mod kernel;
mod laws;
mod rod;
mod separate;

use crate::extended::ExtendedSegments;
use crate::{RodLayout, RodMaterial};
use actin_mechanics::wide::{self, Arch};
use actin_mechanics::{Loads, State, Vector3};
use laws::{
    Bend, Bent, ConstantBend, ConstantTwist, CubicAcross, Laws, Length, LinearShear, NaturalLength,
    Polynomial, Rooted, Shear, Sided, Tanh, Twist, WideStiffening,
};
pub(crate) use laws::{Law, Potential};
use rod::Rod;

type Constant = Laws<LinearShear, ConstantBend, ConstantTwist, NaturalLength>;
type Published = Laws<LinearShear, ConstantBend, Tanh, Polynomial>;
type Fitted = Laws<CubicAcross, WideStiffening, Sided, Rooted>;
type FittedLinearShear = Laws<LinearShear, WideStiffening, Sided, Rooted>;

#[derive(Clone, Debug)]
pub(crate) struct FastRod(Kind);

#[derive(Clone, Debug)]
enum Kind {
    Constant(Rod<Constant>),
    /// Published or constant twist, with or without published natural length.
    Published(Rod<Published>),
    /// Laws fitted to monomers; each except shear may be constant instead.
    Fitted(Rod<Fitted>),
    /// Fitted laws with constant shear.
    FittedLinearShear(Rod<FittedLinearShear>),
    Bent(Rod<Bent<Constant>>),
    Potential(Box<Rod<Potential>>),
}

impl FastRod {
    /// Returns the first kernel that supports the rod, or `None`.
    pub(crate) fn new(
        layout: &RodLayout,
        material: &RodMaterial,
        extended: Option<&ExtendedSegments>,
    ) -> Option<Self> {
        if material.rest_curvature() != Vector3::zeros() {
            return Self::bent(layout, material, extended);
        }
        if let Some(law) = material.potential() {
            let rod = Rod::new(layout, law.unrolled(), extended)?;
            return Some(Self(Kind::Potential(Box::new(rod))));
        }
        let rod = (layout, material, extended);
        let kind = kind(rod, Kind::Constant)
            .or_else(|| kind(rod, Kind::Published))
            .or_else(|| kind(rod, Kind::Fitted))
            .or_else(|| kind(rod, Kind::FittedLinearShear));
        kind.map(Self)
    }

    fn bent(
        layout: &RodLayout,
        material: &RodMaterial,
        extended: Option<&ExtendedSegments>,
    ) -> Option<Self> {
        let law = Laws::from_law(material, extended.map(|segments| &segments.law))?;
        let rod = Rod::new(layout, Bent::new(law, material), extended)?;
        Some(Self(Kind::Bent(rod)))
    }

    pub(crate) fn add_loads(&self, layout: &RodLayout, state: &State, loads: &mut Loads) {
        self.add_loads_on(wide::arch(), layout, state, loads);
    }

    fn add_loads_on(&self, arch: Arch, layout: &RodLayout, state: &State, loads: &mut Loads) {
        match &self.0 {
            Kind::Constant(rod) => rod.add_loads(arch, layout, state, loads),
            Kind::Published(rod) => rod.add_loads(arch, layout, state, loads),
            Kind::Fitted(rod) => rod.add_loads(arch, layout, state, loads),
            Kind::FittedLinearShear(rod) => rod.add_loads(arch, layout, state, loads),
            Kind::Bent(rod) => rod.add_loads(arch, layout, state, loads),
            Kind::Potential(rod) => rod.add_loads(arch, layout, state, loads),
        }
    }
}

type AsKind<L> = fn(Rod<L>) -> Kind;

fn kind<A: Shear, B: Bend, T: Twist, X: Length>(
    (layout, material, extended): (&RodLayout, &RodMaterial, Option<&ExtendedSegments>),
    kind: AsKind<Laws<A, B, T, X>>,
) -> Option<Kind> {
    let law = Laws::from_law(material, extended.map(|segments| &segments.law))?;
    Rod::new(layout, law, extended).map(kind)
}

#[cfg(test)]
mod tests;

//! The loads of a rod, several elements at a time.
//!
//! # What it does
//! The same as the scalar path of [`EnergyGradient`](crate::EnergyGradient), which stays its
//! reference. A rod gets the loop that was compiled for its laws: constant rigidities; the published
//! twist, the published length that follows it, or both; the laws fitted to monomers or any
//! of them, with cubic or with constant shear. The scalar path is left to a stretch with two sides, to
//! the published twist or length together with fitted laws (stiffening, cubic shear, fitted twist or
//! length), to rods under other laws than constant ones that are bent at rest, to rods whose strain knows of more than eight elements that join them to others, and to
//! the printed balance. The choice falls when the interaction is built, so that no loop asks for the
//! kind of a law. Energies and second derivatives are not in the loop of a motion and stay scalar.
//!
//! # How
//! One element per lane, as `actin_mechanics::wide` explains. Elements of a rod follow one another
//! in the arrays of the state, so a group of elements, of their first and of their second bodies
//! are each a contiguous piece of these arrays, the latter one body further along.
//!
//! An element acts on two neighbouring bodies. A loop therefore goes over the *bodies*: what an
//! element does to its first body stands in the right lane; what it does to its second is moved up
//! one lane ([`ShiftedUp`](actin_mechanics::wide::ShiftedUp)). There is one body more than there
//! are elements; the element of the last body does not exist and has no effect.
//!
//! - Segments (`elements.rs`): with `Q` the rotation of a segment's frame and `y = Q^T l`, the strain is
//!   `sigma = y / |lhat| - e3`; the force `Q n` acts on the first node, its negative on the second,
//!   and the torque `y x n` on the frame, with `n(sigma, kappa)` the law's force.
//! - Bending elements: with `theta = log(Qa^T Qb)` from the quaternions and `m` the law's couple at
//!   `theta / Dhat`, the torques are `even + odd` and `-(even - odd)`, where `odd = theta x m / 2` and
//!   `even = m + c theta x (theta x m)`.
//!
//! Where a law couples nothing (`separate.rs`) these are two loops. Where the strain of a segment has to
//! do with the mean curvature around it (`coupled.rs`) they are one, so that each angle is found once: it
//! enters the mean of the segments on both sides and its own element, and what the segments answer, a
//! couple each, is added to that element's `m` before torques are made of it. The loop treats a group of
//! segments together with the elements *before* them, whose angles are moved up a lane, whose torques on
//! first frames are moved down one ([`ShiftedDown`](actin_mechanics::wide::ShiftedDown)), and
//! which are found one group ahead: everything else waits for them. A wall at the start is the element
//! before the first group. What joins the ends to monomers is not the rod's own, and done one by one
//! (`ends.rs`).
//!
//! # Laws
//! `laws/` holds them part by part (shear and stretch, bending, twist, natural length), each in a few
//! lines beside the scalar law that it is tested against; [`Laws`] puts a choice of them together, and the
//! loops are compiled for each choice in use. They branch nowhere: outside its range a
//! law goes on with its slope there, and which side of rest a lane is on selects numbers. A law in a group's
//! lane without a body sees zeros; forces there are cleared, since the published length pulls at rest.
//!
//! # What it costs
//! Per segment, constant rigidities: about 60 operations for shear (33 of them two turns) and 70 for
//! bending (16 for the relative quaternion, 14 for two polynomials, 27 for the couples); no root, no quotient
//! (rest lengths are stored inverted), no call. What bounds it is the number of these operations, not
//! memory: a thousand segments still lie in the second-level cache. The fitted laws take twice as many
//! instructions (five quotients and two roots among them), the published ones too (three hyperbolic
//! tangents), and are bounded by the length of the chain from quaternions to torques rather than by their number
//! (`docs/numerics.md`, Speed).
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

/// A rod and the loop that was compiled for its laws.
#[derive(Clone, Debug)]
pub(crate) struct FastRod(Kind);

#[derive(Clone, Debug)]
enum Kind {
    /// Every rigidity is constant.
    Constant(Rod<Constant>),
    /// Twist as published or constant, a natural length as published or none.
    Published(Rod<Published>),
    /// As fitted to monomers, each law but that of shear or constant instead.
    Fitted(Rod<Fitted>),
    /// The same with constant shear.
    FittedLinearShear(Rod<FittedLinearShear>),
    /// Every rigidity is constant, with a curvature at rest.
    Bent(Rod<Bent<Constant>>),
    /// One potential for all strains.
    Potential(Box<Rod<Potential>>),
}

impl FastRod {
    /// The loop of the first kind that a rod is of; `None` where it is of none.
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

    /// The loop of a rod that is bent at rest.
    fn bent(
        layout: &RodLayout,
        material: &RodMaterial,
        extended: Option<&ExtendedSegments>,
    ) -> Option<Self> {
        let law = Laws::of(material, extended.map(|segments| &segments.law))?;
        let rod = Rod::new(layout, Bent::new(law, material), extended)?;
        Some(Self(Kind::Bent(rod)))
    }

    /// Adds the loads of all elements.
    pub(crate) fn add_loads(&self, layout: &RodLayout, state: &State, loads: &mut Loads) {
        self.add_loads_on(wide::arch(), layout, state, loads);
    }

    /// The same with a choice of instructions.
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

/// A variant of [`Kind`].
type AsKind<L> = fn(Rod<L>) -> Kind;

/// A rod of one kind, if it is of that.
fn kind<A: Shear, B: Bend, T: Twist, X: Length>(
    (layout, material, extended): (&RodLayout, &RodMaterial, Option<&ExtendedSegments>),
    kind: AsKind<Laws<A, B, T, X>>,
) -> Option<Kind> {
    let law = Laws::of(material, extended.map(|segments| &segments.law))?;
    Rod::new(layout, law, extended).map(kind)
}

#[cfg(test)]
mod tests;

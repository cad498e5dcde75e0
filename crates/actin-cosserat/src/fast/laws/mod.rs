//! The laws of a material, several elements at a time.
//!
//! Loops need first derivatives alone: energies and tangents stay with the scalar laws in
//! `crate::law` and `crate::extended`, which are the references here. No law asks on which side of a switch
//! a lane stands by a branch: both sides are evaluated, or their numbers selected.

mod bend;
mod bent;
mod length;
mod potential;
mod shear;
mod twist;

use crate::{RodMaterial, SegmentLaw};
use actin_mechanics::wide::{Simd, Wide3};
use std::fmt::Debug;

pub(super) use bend::{Bend, ConstantBend, WideStiffening};
pub(super) use bent::Bent;
pub(super) use length::{Length, NaturalLength, Polynomial, Rooted};
pub(crate) use potential::Potential;
pub(super) use shear::{CubicAcross, LinearShear, Shear};
pub(super) use twist::{ConstantTwist, Sided, Tanh, Twist};

/// What the loop asks a material.
pub(crate) trait Law: Copy + Debug {
    /// Whether the curvature around a segment has to do with its strain.
    const COUPLES: bool;

    /// Whether joints beside free ends stand for the half segments there, and segments near ends have factors of
    /// their shear.
    const COVERS: bool = false;

    /// Whether it has couples without curvature: what does not exist is then not zero by itself.
    const BENT: bool = false;

    /// Couple of bending elements (pN nm) at curvature `kappa` (rad/nm). The reference is
    /// [`RodMaterial::bending_couple`].
    fn bending<S: Simd>(&self, simd: S, kappa: Wide3<S>) -> Wide3<S>;

    /// Force (pN) and couple (pN nm) of segments at strain `sigma` and mean curvature `kappa`
    /// (rad/nm). The reference is `SegmentLaw::loads`.
    fn segment<S: Simd>(&self, simd: S, sigma: Wide3<S>, kappa: Wide3<S>) -> [Wide3<S>; 2];
}

/// A law for each deformation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Laws<A, B, T, X> {
    shear: A,
    bend: B,
    twist: T,
    length: X,
}

impl<A: Shear, B: Bend, T: Twist, X: Length> Laws<A, B, T, X> {
    /// Those of a material and of what couples its segments, if they are of these kinds.
    pub(super) fn of(material: &RodMaterial, coupling: Option<&SegmentLaw>) -> Option<Self> {
        let laws = material.laws()?;
        Some(Self {
            shear: A::of(laws.shear(), laws.stretch())?,
            bend: B::of(laws.bend(), coupling.and_then(SegmentLaw::stiffening))?,
            twist: T::of(laws.twist())?,
            length: X::of(coupling.and_then(SegmentLaw::twist_stretch))?,
        })
    }
}

impl<A: Shear, B: Bend, T: Twist, X: Length> Law for Laws<A, B, T, X> {
    const COUPLES: bool = B::COUPLES || X::COUPLES;

    #[inline(always)]
    fn bending<S: Simd>(&self, simd: S, kappa: Wide3<S>) -> Wide3<S> {
        let twist = self.twist.couple(simd, kappa[2]);
        self.bend.couple(simd, kappa, twist)
    }

    #[inline(always)]
    fn segment<S: Simd>(&self, simd: S, sigma: Wide3<S>, kappa: Wide3<S>) -> [Wide3<S>; 2] {
        let [natural, slope] = self.length.extension(simd, kappa[2]);
        let (force, pull) = self.shear.force(simd, sigma, natural);
        let twist = simd.neg_f64s(simd.mul_f64s(pull, slope));
        self.bend.stiffened(simd, [sigma, kappa], force, twist)
    }
}

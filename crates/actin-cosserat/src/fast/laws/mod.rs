//! Vectorised laws of a material.
//!
//! The scalar laws in `crate::law` and `crate::extended` are the references. Branches are replaced
//! by selection.

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

/// Interface between kernels and materials.
pub(crate) trait Law: Copy + Debug {
    /// `true` if the strain of segments is coupled to the curvature around them.
    const COUPLES: bool;

    /// `true` if joints next to free ends cover the half segments there, and shear has factors near
    /// ends.
    const COVERS: bool = false;

    /// `true` if there are torques at zero curvature, so that missing elements must be masked.
    const BENT: bool = false;

    /// Torque of bending elements (pN nm) at curvature `kappa` (rad/nm). Reference:
    /// [`RodMaterial::bending_couple`].
    fn bending<S: Simd>(&self, simd: S, kappa: Wide3<S>) -> Wide3<S>;

    /// Force (pN) and torque (pN nm) of segments at strain `sigma` and mean curvature `kappa`
    /// (rad/nm). Reference: `SegmentLaw::loads`.
    fn segment<S: Simd>(&self, simd: S, sigma: Wide3<S>, kappa: Wide3<S>) -> [Wide3<S>; 2];
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Laws<A, B, T, X> {
    shear: A,
    bend: B,
    twist: T,
    length: X,
}

impl<A: Shear, B: Bend, T: Twist, X: Length> Laws<A, B, T, X> {
    pub(super) fn from_law(material: &RodMaterial, coupling: Option<&SegmentLaw>) -> Option<Self> {
        let laws = material.laws()?;
        Some(Self {
            shear: A::from_law(laws.shear(), laws.stretch())?,
            bend: B::from_law(laws.bend(), coupling.and_then(SegmentLaw::stiffening))?,
            twist: T::from_law(laws.twist())?,
            length: X::from_law(coupling.and_then(SegmentLaw::twist_stretch))?,
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

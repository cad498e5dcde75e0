//! Law of rods that are bent or twisted at rest.

use super::Law;
use crate::RodMaterial;
use actin_mechanics::wide::{self, Simd, Wide3};

/// Law with curvatures relative to a rest curvature.
#[derive(Clone, Copy, Debug)]
pub(in crate::fast) struct Bent<L> {
    law: L,
    rest: [f64; 3],
}

impl<L: Law> Bent<L> {
    pub(in crate::fast) fn new(law: L, material: &RodMaterial) -> Self {
        Self {
            law,
            rest: material.rest_curvature().into(),
        }
    }

    #[inline(always)]
    fn beyond<S: Simd>(&self, simd: S, kappa: Wide3<S>) -> Wide3<S> {
        wide::sub(simd, kappa, self.rest.map(|rest| simd.splat_f64s(rest)))
    }
}

impl<L: Law> Law for Bent<L> {
    const COUPLES: bool = L::COUPLES;
    const COVERS: bool = L::COVERS;
    const BENT: bool = true;

    #[inline(always)]
    fn bending<S: Simd>(&self, simd: S, kappa: Wide3<S>) -> Wide3<S> {
        self.law.bending(simd, self.beyond(simd, kappa))
    }

    #[inline(always)]
    fn segment<S: Simd>(&self, simd: S, sigma: Wide3<S>, kappa: Wide3<S>) -> [Wide3<S>; 2] {
        self.law.segment(simd, sigma, self.beyond(simd, kappa))
    }
}

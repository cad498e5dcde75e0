//! Dependence of the natural length on twist.

use crate::{PolynomialStretch, RootedStretch, TwistStretch};
use actin_mechanics::wide::{self, Simd};
use std::fmt::Debug;

pub(in crate::fast) trait Length: Copy + Debug {
    const COUPLES: bool;

    fn from_law(law: Option<&TwistStretch>) -> Option<Self>;

    /// `xi - 1` and its derivative at twist `k` (rad/nm). Reference: [`TwistStretch::jet`].
    fn extension<S: Simd>(&self, simd: S, k: S::f64s) -> [S::f64s; 2];
}

#[derive(Clone, Copy, Debug)]
pub(in crate::fast) struct NaturalLength;

impl Length for NaturalLength {
    const COUPLES: bool = false;

    fn from_law(law: Option<&TwistStretch>) -> Option<Self> {
        law.is_none().then_some(Self)
    }

    #[inline(always)]
    fn extension<S: Simd>(&self, simd: S, _: S::f64s) -> [S::f64s; 2] {
        [simd.splat_f64s(0.0); 2]
    }
}

#[derive(Clone, Copy, Debug)]
pub(in crate::fast) struct Polynomial(PolynomialStretch);

impl Length for Polynomial {
    const COUPLES: bool = true;

    fn from_law(law: Option<&TwistStretch>) -> Option<Self> {
        match law {
            Some(TwistStretch::Polynomial(law)) => Some(Self(*law)),
            Some(TwistStretch::Rooted(_)) => None,
            None => Some(Self(PolynomialStretch {
                coefficients: [0.0; 7],
                range: f64::MAX,
            })),
        }
    }

    #[inline(always)]
    fn extension<S: Simd>(&self, simd: S, k: S::f64s) -> [S::f64s; 2] {
        let inside = wide::clamp(simd, k, self.0.range);
        let [p0, lower @ .., p6] = self.0.coefficients;
        let (mut value, mut slope) = (simd.splat_f64s(p6), simd.splat_f64s(p6));
        // Horner scheme for value and derivative.
        for p in lower.into_iter().rev() {
            value = simd.mul_add_e_f64s(value, inside, simd.splat_f64s(p));
            slope = simd.mul_add_e_f64s(slope, inside, value);
        }
        let value = simd.mul_add_e_f64s(value, inside, simd.splat_f64s(p0));
        let beyond = simd.sub_f64s(k, inside);
        [simd.mul_add_e_f64s(slope, beyond, value), slope]
    }
}

#[derive(Clone, Copy, Debug)]
pub(in crate::fast) struct Rooted(RootedStretch);

impl Length for Rooted {
    const COUPLES: bool = true;

    fn from_law(law: Option<&TwistStretch>) -> Option<Self> {
        match law {
            Some(TwistStretch::Rooted(law)) => Some(Self(*law)),
            Some(TwistStretch::Polynomial(_)) => None,
            None => Some(Self(RootedStretch {
                slope: 0.0,
                bend: 0.0,
                half: 1.0,
                cubic: 0.0,
                range: f64::MAX,
            })),
        }
    }

    #[inline(always)]
    fn extension<S: Simd>(&self, simd: S, k: S::f64s) -> [S::f64s; 2] {
        let law = &self.0;
        let inside = wide::clamp(simd, k, law.range);
        let half = simd.splat_f64s(law.half);
        let squared = simd.mul_f64s(inside, inside);
        let root = simd.sqrt_f64s(simd.mul_add_e_f64s(half, half, squared));
        let sum = simd.add_f64s(root, half);
        // One division for 1 / root and 1 / (root + half).
        let both = simd.div_f64s(simd.splat_f64s(law.bend), simd.mul_f64s(root, sum));
        let cube = simd.mul_f64s(simd.splat_f64s(law.cubic), squared);
        let straight = simd.add_f64s(simd.splat_f64s(law.slope), cube);
        let bent = simd.mul_f64s(simd.mul_f64s(both, root), inside);
        let value = simd.mul_f64s(inside, simd.sub_f64s(straight, bent));
        let slope = simd.mul_add_e_f64s(simd.splat_f64s(2.0), cube, straight);
        let slope = simd.negate_mul_add_e_f64s(simd.mul_f64s(both, sum), inside, slope);
        let beyond = simd.sub_f64s(k, inside);
        [simd.mul_add_e_f64s(slope, beyond, value), slope]
    }
}

//! Shear and stretch.

use crate::{CubicShear, StretchLaw};
use actin_mechanics::Vector3;
use actin_mechanics::wide::{self, Simd, Wide3};
use std::fmt::Debug;

pub(in crate::fast) trait Shear: Copy + Debug {
    fn from_law(shear: &CubicShear, stretch: &StretchLaw) -> Option<Self>;

    /// Force (pN, body axes), and tension due to stretch beyond `natural`. Reference:
    /// `RodMaterial::shear_force_beyond`.
    fn force<S: Simd>(&self, simd: S, sigma: Wide3<S>, natural: S::f64s) -> (Wide3<S>, S::f64s);
}

#[derive(Clone, Copy, Debug)]
pub(in crate::fast) struct LinearShear {
    /// S1, S2, S3 (pN).
    rigidities: Vector3,
}

impl Shear for LinearShear {
    fn from_law(shear: &CubicShear, stretch: &StretchLaw) -> Option<Self> {
        let ([s1, s2], StretchLaw::Constant { rigidity: s3 }) = (shear.linear, stretch) else {
            return None;
        };
        let rigidities = Vector3::new(s1, s2, *s3);
        (shear.cubic == 0.0).then_some(Self { rigidities })
    }

    #[inline(always)]
    fn force<S: Simd>(&self, simd: S, sigma: Wide3<S>, natural: S::f64s) -> (Wide3<S>, S::f64s) {
        let [x, y, z] = sigma;
        let strain = [x, y, simd.sub_f64s(z, natural)];
        let force = wide::mul_each(simd, wide::splat(simd, self.rigidities), strain);
        (force, force[2])
    }
}

/// Shear with a cubic part, and tension along the segment instead of its frame.
#[derive(Clone, Copy, Debug)]
pub(in crate::fast) struct CubicAcross {
    law: CubicShear,
    /// S3 (pN).
    stretch: f64,
}

impl Shear for CubicAcross {
    fn from_law(shear: &CubicShear, stretch: &StretchLaw) -> Option<Self> {
        let StretchLaw::Constant { rigidity: stretch } = *stretch else {
            return None;
        };
        let law = *shear;
        (shear.cubic != 0.0).then_some(Self { law, stretch })
    }

    #[inline(always)]
    fn force<S: Simd>(&self, simd: S, sigma: Wide3<S>, natural: S::f64s) -> (Wide3<S>, S::f64s) {
        let [x, y, z] = sigma;
        let one = simd.splat_f64s(1.0);
        let across = simd.mul_add_e_f64s(y, y, simd.mul_f64s(x, x));
        // The segment divided by its rest length is e3 + sigma. The strain is computed from the
        // squared length minus 1, to avoid cancellation at small strain.
        let along_d3 = simd.add_f64s(one, z);
        let length = simd.sqrt_f64s(simd.mul_add_e_f64s(along_d3, along_d3, across));
        let twice = simd.add_f64s(z, z);
        let excess = simd.add_f64s(simd.mul_add_e_f64s(z, z, across), twice);
        let more = simd.add_f64s(length, one);
        // One division for 1 / length and 1 / (length + 1).
        let both = simd.div_f64s(one, simd.mul_f64s(length, more));
        let strain = simd.mul_f64s(excess, simd.mul_f64s(both, length));
        let rigidity = simd.splat_f64s(self.stretch);
        let pull = simd.mul_f64s(rigidity, simd.sub_f64s(strain, natural));
        let along = simd.mul_f64s(pull, simd.mul_f64s(both, more));
        let cubic = simd.mul_add_e_f64s(simd.splat_f64s(self.law.cubic), across, along);
        let [s1, s2] = self.law.linear;
        let force = [
            simd.mul_f64s(simd.add_f64s(simd.splat_f64s(s1), cubic), x),
            simd.mul_f64s(simd.add_f64s(simd.splat_f64s(s2), cubic), y),
            simd.mul_f64s(along, along_d3),
        ];
        (force, pull)
    }
}

//! Bending, and its coupling to twist and shear.

use crate::{BendLaw, Stiffening};
use actin_mechanics::wide::{Simd, Wide3};
use std::fmt::Debug;

/// Law of bending.
pub(in crate::fast) trait Bend: Copy + Debug {
    /// `true` if bending is coupled to the strain of segments.
    const COUPLES: bool;

    fn from_law(bend: &BendLaw, in_segments: Option<&Stiffening>) -> Option<Self>;

    /// Torque (pN nm) at curvature `kappa` (rad/nm), plus the torque `twist` about d3. Reference:
    /// [`BendLaw::couple`].
    fn couple<S: Simd>(&self, simd: S, kappa: Wide3<S>, twist: S::f64s) -> Wide3<S>;

    /// Force (pN) and torque (pN nm) of segments with stiffening, plus `force` and the torque
    /// `twist` about d3. Reference: `SegmentLaw::loads`.
    fn stiffened<S: Simd>(
        &self,
        simd: S,
        strain_and_curvature: [Wide3<S>; 2],
        force: Wide3<S>,
        twist: S::f64s,
    ) -> [Wide3<S>; 2];
}

/// Constant rigidities B1, B2 (pN nm^2).
#[derive(Clone, Copy, Debug)]
pub(in crate::fast) struct ConstantBend([f64; 2]);

impl Bend for ConstantBend {
    const COUPLES: bool = false;

    fn from_law(bend: &BendLaw, in_segments: Option<&Stiffening>) -> Option<Self> {
        match (bend, in_segments) {
            (BendLaw::Constant(rigidities), None) => Some(Self(*rigidities)),
            _ => None,
        }
    }

    #[inline(always)]
    fn couple<S: Simd>(&self, simd: S, kappa: Wide3<S>, twist: S::f64s) -> Wide3<S> {
        let [b1, b2] = self.0;
        [
            simd.mul_f64s(simd.splat_f64s(b1), kappa[0]),
            simd.mul_f64s(simd.splat_f64s(b2), kappa[1]),
            twist,
        ]
    }

    #[inline(always)]
    fn stiffened<S: Simd>(
        &self,
        simd: S,
        _: [Wide3<S>; 2],
        force: Wide3<S>,
        twist: S::f64s,
    ) -> [Wide3<S>; 2] {
        let zero = simd.splat_f64s(0.0);
        [force, [zero, zero, twist]]
    }
}

/// Law of [`Stiffening`] with inverse squared scales.
#[derive(Clone, Copy, Debug)]
pub(in crate::fast) struct WideStiffening {
    /// Rigidities at rest (pN nm^2).
    rest: [f64; 2],
    rise: f64,
    curvature: f64,
    twist: f64,
    /// Zero without stiffening by shear.
    shear: f64,
}

impl Bend for WideStiffening {
    const COUPLES: bool = true;

    fn from_law(bend: &BendLaw, in_segments: Option<&Stiffening>) -> Option<Self> {
        match (bend, in_segments) {
            (BendLaw::Constant(rest), None) => Some(Self::constant(*rest)),
            (BendLaw::Stiffening(law), None) => Some(Self::new(law, 0.0)),
            (BendLaw::Stiffening(law), Some(other)) if law == other => {
                Some(Self::new(law, law.shear.powi(-2)))
            }
            _ => None,
        }
    }

    #[inline(always)]
    fn couple<S: Simd>(&self, simd: S, kappa: Wide3<S>, twist: S::f64s) -> Wide3<S> {
        let one = simd.splat_f64s(1.0);
        let (q, p, t) = self.arguments(simd, kappa);
        let rise = simd.splat_f64s(self.rise);
        // rise (q + t) / (1 + q + t), and rise p / ((1 + q + t) (1 + t)) over the squared scale.
        let (sum, less) = (simd.add_f64s(q, t), simd.add_f64s(one, t));
        let all = simd.add_f64s(one, sum);
        let over = simd.div_f64s(rise, simd.mul_f64s(all, less));
        let gained = simd.mul_f64s(simd.mul_f64s(sum, less), over);
        let turning = simd.mul_f64s(simd.mul_f64s(p, over), simd.splat_f64s(self.twist));
        let [r1, r2] = self.rest;
        [
            simd.mul_f64s(simd.add_f64s(simd.splat_f64s(r1), gained), kappa[0]),
            simd.mul_f64s(simd.add_f64s(simd.splat_f64s(r2), gained), kappa[1]),
            simd.mul_add_e_f64s(turning, kappa[2], twist),
        ]
    }

    #[inline(always)]
    fn stiffened<S: Simd>(
        &self,
        simd: S,
        [sigma, kappa]: [Wide3<S>; 2],
        force: Wide3<S>,
        twist: S::f64s,
    ) -> [Wide3<S>; 2] {
        let one = simd.splat_f64s(1.0);
        let (q, p, t) = self.arguments(simd, kappa);
        let shear = simd.splat_f64s(self.shear);
        let across = simd.mul_add_e_f64s(sigma[1], sigma[1], simd.mul_f64s(sigma[0], sigma[0]));
        let g = simd.mul_f64s(across, shear);
        // 1 + q + t and 1 + t, without and with shear.
        let less = simd.add_f64s(one, t);
        let all = simd.add_f64s(less, q);
        let (less_with, all_with) = (simd.add_f64s(less, g), simd.add_f64s(all, g));
        let (product, product_with) =
            (simd.mul_f64s(all, less), simd.mul_f64s(all_with, less_with));
        let over = simd.div_f64s(
            simd.splat_f64s(self.rise),
            simd.mul_f64s(product, product_with),
        );
        // rise g / (all all_with)
        let gained = simd.mul_f64s(simd.mul_f64s(g, over), simd.mul_f64s(less, less_with));
        // rise p / product_with, and its difference from rise p / product
        let p_over = simd.mul_f64s(p, over);
        let pushing = simd.mul_f64s(simd.mul_f64s(p_over, product), shear);
        let turning = simd.mul_f64s(p_over, simd.sub_f64s(product, product_with));
        let turning = simd.mul_f64s(turning, simd.splat_f64s(self.twist));
        let couple = [
            simd.mul_f64s(gained, kappa[0]),
            simd.mul_f64s(gained, kappa[1]),
            simd.mul_add_e_f64s(turning, kappa[2], twist),
        ];
        let [x, y, z] = force;
        let x = simd.mul_add_e_f64s(pushing, sigma[0], x);
        let y = simd.mul_add_e_f64s(pushing, sigma[1], y);
        [[x, y, z], couple]
    }
}

impl WideStiffening {
    fn new(law: &Stiffening, shear: f64) -> Self {
        Self {
            rest: [law.rest; 2],
            rise: law.rise,
            curvature: law.curvature.powi(-2),
            twist: law.twist.powi(-2),
            shear,
        }
    }

    fn constant(rest: [f64; 2]) -> Self {
        Self {
            rest,
            rise: 0.0,
            curvature: 0.0,
            twist: 0.0,
            shear: 0.0,
        }
    }

    /// `q`, `p` and `t` of [`Stiffening`] without shear.
    #[inline(always)]
    fn arguments<S: Simd>(&self, simd: S, kappa: Wide3<S>) -> (S::f64s, S::f64s, S::f64s) {
        let [x, y, z] = kappa;
        let p = simd.mul_add_e_f64s(y, y, simd.mul_f64s(x, x));
        let scales = [self.curvature, self.twist];
        let [q, t] = scaled(simd, [p, simd.mul_f64s(z, z)], scales);
        (q, p, t)
    }
}

#[inline(always)]
fn scaled<S: Simd>(simd: S, values: [S::f64s; 2], scales: [f64; 2]) -> [S::f64s; 2] {
    [
        simd.mul_f64s(values[0], simd.splat_f64s(scales[0])),
        simd.mul_f64s(values[1], simd.splat_f64s(scales[1])),
    ]
}

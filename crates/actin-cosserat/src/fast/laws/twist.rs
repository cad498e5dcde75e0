//! Twist.

use crate::{SidedTwist, TanhTwist, TwistLaw, TwistRise};
use actin_mechanics::wide::{self, Simd};
use std::fmt::Debug;

pub(in crate::fast) trait Twist: Copy + Debug {
    fn from_law(law: &TwistLaw) -> Option<Self>;

    /// Torque (pN nm) at twist `k` (rad/nm). Reference: [`TwistLaw::couple`].
    fn couple<S: Simd>(&self, simd: S, k: S::f64s) -> S::f64s;
}

/// Constant rigidity B3 (pN nm^2).
#[derive(Clone, Copy, Debug)]
pub(in crate::fast) struct ConstantTwist(f64);

impl Twist for ConstantTwist {
    fn from_law(law: &TwistLaw) -> Option<Self> {
        match law {
            TwistLaw::Constant(b3) => Some(Self(*b3)),
            TwistLaw::Tanh(_) | TwistLaw::Sided(_) => None,
        }
    }

    #[inline(always)]
    fn couple<S: Simd>(&self, simd: S, k: S::f64s) -> S::f64s {
        simd.mul_f64s(simd.splat_f64s(self.0), k)
    }
}

/// Linear extrapolation outside the range of a law.
#[derive(Clone, Copy, Debug)]
struct LinearExtrapolation {
    range: f64,
    slopes: [f64; 2],
}

impl LinearExtrapolation {
    fn nowhere(b3: f64) -> Self {
        Self {
            range: f64::MAX,
            slopes: [b3; 2],
        }
    }

    /// Twist clamped to the range, and torque of the extrapolation.
    #[inline(always)]
    fn split<S: Simd>(&self, simd: S, k: S::f64s) -> [S::f64s; 2] {
        let inside = wide::clamp(simd, k, self.range);
        let [under, over] = self.slopes;
        let slope = sided(simd, k, under, over);
        [inside, simd.mul_f64s(slope, simd.sub_f64s(k, inside))]
    }
}

#[inline(always)]
fn sided<S: Simd>(simd: S, k: S::f64s, under: f64, over: f64) -> S::f64s {
    let negative = simd.less_than_f64s(k, simd.splat_f64s(0.0));
    simd.select_f64s(negative, simd.splat_f64s(under), simd.splat_f64s(over))
}

#[derive(Clone, Copy, Debug)]
pub(in crate::fast) struct Tanh {
    mean: f64,
    /// Height, centre and inverse width of each step.
    steps: [[f64; 3]; 3],
    beyond: LinearExtrapolation,
}

impl Twist for Tanh {
    fn from_law(law: &TwistLaw) -> Option<Self> {
        match law {
            TwistLaw::Tanh(law) => Some(Self::new(law)),
            TwistLaw::Constant(b3) => Some(Self::constant(*b3)),
            TwistLaw::Sided(_) => None,
        }
    }

    #[inline(always)]
    fn couple<S: Simd>(&self, simd: S, k: S::f64s) -> S::f64s {
        let [inside, gained] = self.beyond.split(simd, k);
        let mut secant = simd.splat_f64s(self.mean);
        for [height, centre, inverse_width] in self.steps {
            let x = simd.sub_f64s(inside, simd.splat_f64s(centre));
            let tanh = wide::tanh(simd, simd.mul_f64s(x, simd.splat_f64s(inverse_width)));
            secant = simd.mul_add_e_f64s(simd.splat_f64s(height), tanh, secant);
        }
        simd.mul_add_e_f64s(secant, inside, gained)
    }
}

impl Tanh {
    fn new(law: &TanhTwist) -> Self {
        let (mean, steps) = law.steps();
        Self {
            mean,
            steps: steps.map(|[height, centre, width]| [height, centre, width.recip()]),
            beyond: LinearExtrapolation {
                range: law.range,
                slopes: [law.tangent(-law.range), law.tangent(law.range)],
            },
        }
    }

    fn constant(b3: f64) -> Self {
        Self {
            mean: b3,
            steps: [[0.0, 0.0, 1.0]; 3],
            beyond: LinearExtrapolation::nowhere(b3),
        }
    }
}

#[derive(Clone, Copy, Debug)]
pub(in crate::fast) struct Sided {
    rest: f64,
    /// `rise`, `slow` and squared `half` of under-twist, then of over-twist.
    sides: [[f64; 3]; 2],
    beyond: LinearExtrapolation,
}

impl Twist for Sided {
    fn from_law(law: &TwistLaw) -> Option<Self> {
        match law {
            TwistLaw::Sided(law) => Some(Self::new(law)),
            TwistLaw::Constant(b3) => Some(Self::constant(*b3)),
            TwistLaw::Tanh(_) => None,
        }
    }

    #[inline(always)]
    fn couple<S: Simd>(&self, simd: S, k: S::f64s) -> S::f64s {
        let [inside, gained] = self.beyond.split(simd, k);
        let [under, over] = self.sides;
        let rise = sided(simd, k, under[0], over[0]);
        let slow = sided(simd, k, under[1], over[1]);
        let half2 = sided(simd, k, under[2], over[2]);
        let a = simd.abs_f64s(inside);
        let squared = simd.mul_f64s(a, a);
        let denominator = simd.mul_add_e_f64s(a, slow, simd.add_f64s(squared, half2));
        let share = simd.div_f64s(squared, denominator);
        let secant = simd.mul_add_e_f64s(rise, share, simd.splat_f64s(self.rest));
        simd.mul_add_e_f64s(secant, inside, gained)
    }
}

impl Sided {
    fn new(law: &SidedTwist) -> Self {
        let side = |side: TwistRise| [side.rise, side.slow, side.half * side.half];
        Self {
            rest: law.rest,
            sides: [side(law.under), side(law.over)],
            beyond: LinearExtrapolation {
                range: law.range,
                slopes: [law.tangent(-law.range), law.tangent(law.range)],
            },
        }
    }

    fn constant(b3: f64) -> Self {
        Self {
            rest: b3,
            sides: [[0.0, 0.0, 1.0]; 2],
            beyond: LinearExtrapolation::nowhere(b3),
        }
    }
}

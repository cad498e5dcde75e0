//! The law `Fitted`, fitted to measurements on filaments of monomers.
//!
//! `cargo xtask fit-parameters --measure` prints all numbers, for the default monomers with twelve quadrature bonds
//! per interface. `docs/validation.md` states the accuracy of the fit and the reason for each term.

use super::{BendLaw, RodLaws, ShearLaw, TwistLaw};
use actin_cosserat::{
    CubicShear, RootedStretch, SidedTwist, Stiffening, StretchLaw, TwistRise, TwistStretch,
};

/// Returns a law for every deformation. None uses the material of the scene.
pub fn laws() -> RodLaws {
    RodLaws {
        bend: Some(BendLaw::Stiffening(Stiffening {
            rest: 33_467.6,
            rise: 6_456.1,
            curvature: 3.283_8e-3,
            twist: 4.044_1e-3,
            shear: 1.061_32e-2,
            range: 0.015,
        })),
        twist: Some(TwistLaw::Sided(SidedTwist {
            rest: 235.488,
            under: TwistRise {
                rise: 14_168.8,
                half: 1.082_02e-2,
                slow: 2.332_57e-2,
            },
            over: TwistRise {
                rise: 26_502.7,
                half: 1.425_36e-2,
                slow: 2.244_5e-2,
            },
            range: 0.0472,
        })),
        stretch: Some(StretchLaw::Constant {
            rigidity: 3.354_4e4,
        }),
        shear: Some(ShearLaw::Cubic(CubicShear {
            linear: [0.0, 0.0],
            cubic: 5.717_5e5,
        })),
        twist_stretch: Some(TwistStretch::Rooted(RootedStretch {
            slope: -0.296_235,
            bend: 0.463_366,
            half: 6.021_36e-3,
            cubic: 31.715_1,
            range: 0.0472,
        })),
    }
}

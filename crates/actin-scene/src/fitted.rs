//! The law `Fitted`, fitted to measurements on filaments of monomers.
//!
//! `cargo xtask fit-parameters --measure` prints all numbers, for the default monomers with twelve quadrature bonds
//! per interface. `docs/validation.md` states the accuracy of the fit and the reason for each term.

use super::{BendLaw, RodLaws, ShearLaw, StretchLaw, TwistLaw, TwistRise, TwistStretchLaw};

/// Returns a law for every deformation. None uses the material of the scene.
pub fn laws() -> RodLaws {
    RodLaws {
        bend: Some(BendLaw::Stiffening {
            rest_pn_nm2: 33_467.6,
            rise_pn_nm2: 6_456.1,
            curvature_per_nm: 3.283_8e-3,
            twist_per_nm: Some(4.044_1e-3),
            shear: Some(1.061_32e-2),
            range_per_nm: 0.015,
        }),
        twist: Some(TwistLaw::Sided {
            rest_pn_nm2: 235.488,
            under: TwistRise {
                rise_pn_nm2: 14_168.8,
                half_per_nm: 1.082_02e-2,
                slow_per_nm: 2.332_57e-2,
            },
            over: TwistRise {
                rise_pn_nm2: 26_502.7,
                half_per_nm: 1.425_36e-2,
                slow_per_nm: 2.244_5e-2,
            },
            range_per_nm: 0.0472,
        }),
        stretch: Some(StretchLaw::Constant {
            rigidity_pn: 3.354_4e4,
        }),
        shear: Some(ShearLaw::Cubic {
            linear_pn: [0.0, 0.0],
            cubic_pn: 5.717_5e5,
        }),
        twist_stretch: Some(TwistStretchLaw::Rooted {
            slope_nm: -0.296_235,
            bend_nm: 0.463_366,
            half_per_nm: 6.021_36e-3,
            cubic_nm3: 31.715_1,
            range_per_nm: 0.0472,
        }),
    }
}

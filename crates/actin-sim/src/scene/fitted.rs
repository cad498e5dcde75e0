//! The law `Fitted`: what measurements on filaments of monomers say of a rod.
//!
//! Every number was printed by `cargo xtask fit-parameters --measure`, from filaments of the default
//! parameters (64 bonds per interface, drawn for each): `docs/validation.md` says how
//! well they meet the filaments and why each term is there.

use super::{BendLaw, RodLaws, ShearLaw, StretchLaw, TwistLaw, TwistRise, TwistStretchLaw};

/// A law for every deformation; nothing of the scene's material is left.
pub fn laws() -> RodLaws {
    RodLaws {
        bend: Some(BendLaw::Stiffening {
            rest_pn_nm2: 31_717.0,
            rise_pn_nm2: 8_070.5,
            curvature_per_nm: 2.845e-3,
            twist_per_nm: Some(2.871e-3),
            shear: Some(9.922e-3),
            range_per_nm: 0.015,
        }),
        twist: Some(TwistLaw::Sided {
            rest_pn_nm2: 225.65,
            under: TwistRise {
                rise_pn_nm2: 12_877.3,
                half_per_nm: 8.713_5e-3,
                slow_per_nm: 1.862e-2,
            },
            over: TwistRise {
                rise_pn_nm2: 23_082.2,
                half_per_nm: 1.141_46e-2,
                slow_per_nm: 1.843_1e-2,
            },
            range_per_nm: 0.0472,
        }),
        stretch: Some(StretchLaw::Constant {
            rigidity_pn: 3.29e4,
        }),
        shear: Some(ShearLaw::Cubic {
            linear_pn: [0.0, 0.0],
            cubic_pn: 8.282_4e5,
        }),
        twist_stretch: Some(TwistStretchLaw::Rooted {
            slope_nm: -0.288_514,
            bend_nm: 0.460_159,
            half_per_nm: 6.587_3e-3,
            cubic_nm3: 27.601_6,
            range_per_nm: 0.0472,
        }),
    }
}

//! The law `Fitted`: what measurements on filaments of monomers say of a rod.
//!
//! Every number was printed by `cargo xtask fit-parameters --measure`, from filaments of the default
//! parameters (64 bonds per interface, drawn for each): `docs/validation.md` holds the data, the
//! errors and why each term is there.

use super::{BendLaw, RodLaws, ShearLaw, StretchLaw, TwistLaw, TwistRise, TwistStretchLaw};

/// A law for every deformation; nothing of the scene's material is left.
pub fn laws() -> RodLaws {
    RodLaws {
        bend: Some(BendLaw::Stiffening {
            rest_pn_nm2: 3.169e4,
            rise_pn_nm2: 7.90e3,
            curvature_per_nm: 2.73e-3,
            twist_per_nm: Some(2.4e-3),
            shear: Some(9.5e-3),
            range_per_nm: 0.0175,
        }),
        twist: Some(TwistLaw::Sided {
            rest_pn_nm2: 272.0,
            under: TwistRise {
                rise_pn_nm2: 12_880.0,
                half_per_nm: 0.009_05,
                slow_per_nm: 0.0192,
            },
            over: TwistRise {
                rise_pn_nm2: 22_155.0,
                half_per_nm: 0.011_88,
                slow_per_nm: 0.0163,
            },
            range_per_nm: 0.0475,
        }),
        stretch: Some(StretchLaw::Constant {
            rigidity_pn: 3.30e4,
        }),
        shear: Some(ShearLaw::Cubic {
            linear_pn: [0.0, 0.0],
            cubic_pn: 8.27e5,
        }),
        twist_stretch: Some(TwistStretchLaw::Rooted {
            slope_nm: -0.289_76,
            bend_nm: 0.461_95,
            half_per_nm: 0.006_728,
            cubic_nm3: 28.5,
            range_per_nm: 0.0475,
        }),
    }
}

//! Fitted laws as a scene writes them.

use actin_cosserat::{Stiffening, StretchLaw};
use actin_sim::BendLaw;

/// A law of bending.
pub(super) fn stiffening(law: Stiffening) -> BendLaw {
    BendLaw::Stiffening {
        rest_pn_nm2: law.rest,
        rise_pn_nm2: law.rise,
        curvature_per_nm: law.curvature,
        twist_per_nm: law.twist.is_finite().then_some(law.twist),
        shear: law.shear.is_finite().then_some(law.shear),
        range_per_nm: law.range,
    }
}

/// A law of stretching.
pub(super) fn stretch(law: StretchLaw) -> actin_sim::StretchLaw {
    match law {
        StretchLaw::Constant(rigidity_pn) => actin_sim::StretchLaw::Constant { rigidity_pn },
        StretchLaw::Sided {
            tension,
            compression,
            width,
        } => actin_sim::StretchLaw::Sided {
            tension_pn: tension,
            compression_pn: compression,
            width,
        },
    }
}

//! Tables of the composition methods with their sources.
//!
//! Stability limits are those of the harmonic oscillator; the tests recompute them.

use crate::composition::{Composition, Stage};
use thiserror::Error;

/// Position Verlet: half a drift, a kick, half a drift.
pub const POSITION_VERLET: Composition = Composition {
    name: "position-verlet",
    order: 2,
    first: Stage::Drift,
    coefficients: &[0.5, 1.0, 0.5],
    stability_limit: 2.0,
    source: "Tuckerman, Berne and Martyna, J. Chem. Phys. 97 (1992) 1990",
};

/// Velocity Verlet: half a kick, a drift, half a kick.
pub const VELOCITY_VERLET: Composition = Composition {
    name: "velocity-verlet",
    order: 2,
    first: Stage::Kick,
    coefficients: &[0.5, 1.0, 0.5],
    stability_limit: 2.0,
    source: "Swope, Andersen, Berens and Wilson, J. Chem. Phys. 76 (1982) 637",
};

/// Position-extended Forest-Ruth-like method.
pub const PEFRL: Composition = Composition {
    name: "pefrl",
    order: 4,
    first: Stage::Drift,
    coefficients: &extended_forest_ruth(
        0.178_617_895_844_809_1,
        -0.212_341_831_062_605_4,
        -0.066_264_582_669_818_5,
    ),
    stability_limit: 2.989_45,
    source: "Omelyan, Mryglod and Folk, Comput. Phys. Commun. 146 (2002) 188, PEFRL",
};

/// Velocity-extended Forest-Ruth-like method.
pub const VEFRL: Composition = Composition {
    name: "vefrl",
    order: 4,
    first: Stage::Kick,
    coefficients: &extended_forest_ruth(
        0.164_498_651_557_576,
        -0.020_943_339_103_989_89,
        1.235_692_651_138_917,
    ),
    stability_limit: 3.469_64,
    source: "Omelyan, Mryglod and Folk, Comput. Phys. Commun. 146 (2002) 188, VEFRL",
};

/// Method of Forest and Ruth, beginning with a drift.
pub const FOREST_RUTH: Composition = Composition {
    name: "forest-ruth",
    order: 4,
    first: Stage::Drift,
    coefficients: &forest_ruth(FOREST_RUTH_WEIGHT),
    stability_limit: 1.573_40,
    source: "Forest and Ruth, Physica D 43 (1990) 105",
};

/// Fivefold composition of position Verlet by Suzuki.
pub const SUZUKI: Composition = Composition {
    name: "suzuki",
    order: 4,
    first: Stage::Drift,
    coefficients: &suzuki(SUZUKI_WEIGHT),
    stability_limit: 2.720_97,
    source: "Suzuki, Phys. Lett. A 146 (1990) 319",
};

/// All methods, in the order of listings.
const ALL: &[Composition] = &[
    POSITION_VERLET,
    VELOCITY_VERLET,
    PEFRL,
    VEFRL,
    FOREST_RUTH,
    SUZUKI,
];

/// Duration of the outer steps of Forest and Ruth, 1 / (2 - 2^(1/3)).
const FOREST_RUTH_WEIGHT: f64 = 1.351_207_191_959_657_6;

/// Duration of the four outer steps of Suzuki, 1 / (4 - 4^(1/3)); the middle one lasts one minus
/// four times that.
const SUZUKI_WEIGHT: f64 = 0.414_490_771_794_375_74;

/// Symmetric table of the extended methods.
const fn extended_forest_ruth(xi: f64, lambda: f64, chi: f64) -> [f64; 9] {
    let side = 0.5 - lambda;
    let middle = 1.0 - 2.0 * (chi + xi);
    [xi, side, chi, lambda, middle, lambda, chi, side, xi]
}

/// Three second-order steps of durations `t`, `1 - 2 t`, `t`, merged.
const fn forest_ruth(t: f64) -> [f64; 7] {
    let joint = 0.5 - 0.5 * t;
    [0.5 * t, t, joint, 1.0 - 2.0 * t, joint, t, 0.5 * t]
}

/// Five second-order steps of durations `p`, `p`, `1 - 4 p`, `p`, `p`, merged.
const fn suzuki(p: f64) -> [f64; 11] {
    let middle = 1.0 - 4.0 * p;
    let joint = 0.5 * (p + middle);
    [0.5 * p, p, p, p, joint, middle, joint, p, p, p, 0.5 * p]
}

impl Composition {
    /// All methods.
    pub fn all() -> &'static [Self] {
        ALL
    }

    /// Method with the given name.
    ///
    /// # Errors
    /// If no method has this name.
    pub fn by_name(name: &str) -> Result<&'static Self, UnknownScheme> {
        Self::all()
            .iter()
            .find(|scheme| scheme.name == name)
            .ok_or_else(|| UnknownScheme(name.to_owned()))
    }
}

/// Unknown name of a method.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("unknown integration method {0:?}; the methods are {known}", known = known_names())]
pub struct UnknownScheme(pub String);

fn known_names() -> String {
    let names: Vec<_> = Composition::all().iter().map(|s| s.name).collect();
    names.join(", ")
}

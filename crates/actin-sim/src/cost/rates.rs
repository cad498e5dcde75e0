//! How fast loads and Newton steps go, measured: constants of the estimates of time.
//!
//! Printed by `cargo xtask tradeoff rates`: whole steps of motion and Newton's method on one thread,
//! the best of seven, in a release build on an otherwise idle 3.0 GHz x86-64 with AVX2.

use crate::scene::RodLaw;

/// Bonds between monomers per second, in whole steps of a motion.
pub const BONDS_PER_S: f64 = 7.12e8;
/// Elements of rods and junctions per second in whole steps, constant rigidities.
pub const ELEMENTS_PER_S: f64 = 5.85e7;
/// The same where a law follows curvature, twist or shear; mixtures of laws that keep the scalar path
/// take some six times as long (`docs/numerics.md`).
pub const LAW_ELEMENTS_PER_S: f64 = 3.45e7;
/// Points and frames per second that half a step of thermal noise moves.
pub const NOISY_BODIES_PER_S: f64 = 1.64e7;
/// Bonds per second of a Newton step: second derivatives, factorisation and line search.
pub const NEWTON_BONDS_PER_S: f64 = 2.76e7;
/// Elements per second of a Newton step, constant rigidities.
pub const NEWTON_ELEMENTS_PER_S: f64 = 7.29e5;
/// The same where a law follows curvature, twist or shear.
pub const NEWTON_LAW_ELEMENTS_PER_S: f64 = 3.61e5;

/// Elements per second in whole steps under a rod law.
pub(super) fn elements_per_s(law: &RodLaw) -> f64 {
    match law {
        RodLaw::Constant => ELEMENTS_PER_S,
        _ => LAW_ELEMENTS_PER_S,
    }
}

/// Elements per second of a Newton step under a rod law.
pub(super) fn newton_elements_per_s(law: &RodLaw) -> f64 {
    match law {
        RodLaw::Constant => NEWTON_ELEMENTS_PER_S,
        _ => NEWTON_LAW_ELEMENTS_PER_S,
    }
}

//! How fast loads and Newton steps go, measured: constants of the estimates of time.
//!
//! Printed by `cargo xtask tradeoff rates`: whole steps of motion and Newton's method on one thread,
//! the best of seven. These are of the development profile, on a 3.0 GHz x86-64 that other work
//! shared; a release build is faster.

use crate::scene::RodLaw;

/// Bonds between monomers per second, in whole steps of a motion.
pub const BONDS_PER_S: f64 = 2.96e8;
/// Elements of rods and junctions per second in whole steps, constant rigidities.
pub const ELEMENTS_PER_S: f64 = 4.07e6;
/// The same where a law follows curvature, twist or shear.
pub const LAW_ELEMENTS_PER_S: f64 = 1.47e6;
/// Bonds per second of a Newton step: second derivatives, factorisation and line search.
pub const NEWTON_BONDS_PER_S: f64 = 6.07e6;
/// Elements per second of a Newton step, constant rigidities.
pub const NEWTON_ELEMENTS_PER_S: f64 = 5.04e5;
/// The same where a law follows curvature, twist or shear.
pub const NEWTON_LAW_ELEMENTS_PER_S: f64 = 6.19e4;

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

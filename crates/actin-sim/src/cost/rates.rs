//! How fast loads and Newton steps go, measured: constants of the estimates of time.
//!
//! Printed by `cargo xtask tradeoff rates` (release build, one thread of a 3.0 GHz x86-64 that other
//! work shared; whole steps, the best of several runs).

use crate::scene::RodLaw;

/// Bonds between monomers per second, in whole steps of a motion.
pub const BONDS_PER_S: f64 = 2.0e8;
/// Elements of rods and junctions per second in whole steps, constant rigidities.
pub const ELEMENTS_PER_S: f64 = 1.5e7;
/// The same where a law follows curvature, twist or shear.
pub const LAW_ELEMENTS_PER_S: f64 = 5.0e6;
/// Bonds per second of a Newton step: second derivatives, factorisation and line search.
pub const NEWTON_BONDS_PER_S: f64 = 1.8e7;
/// Elements per second of a Newton step.
pub const NEWTON_ELEMENTS_PER_S: f64 = 3.0e5;

/// Elements per second in whole steps under a rod law.
pub(super) fn elements_per_s(law: &RodLaw) -> f64 {
    match law {
        RodLaw::Constant => ELEMENTS_PER_S,
        _ => LAW_ELEMENTS_PER_S,
    }
}

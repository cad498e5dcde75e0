//! How fast loads and Newton steps go, measured: constants of the estimates of time.
//!
//! Printed by `cargo xtask tradeoff rates`: whole steps of motion and Newton's method on one thread,
//! the best of seven, in a release build on the otherwise idle [reference machine](REFERENCE). Rates from
//! `TERMS_PER_S` on are not measured there: they are orders of magnitude, seen in a build without
//! link-time optimisation on a busy machine. `cargo xtask costs` prints by how much estimates miss.

/// The machine of these rates, of which an estimate takes one core.
pub const REFERENCE: &str = "3.0 GHz x86-64 with AVX2";

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
/// Terms (sections, junctions, loads, linkers) per second, in whole steps: what each costs beside its
/// bonds and elements.
pub const TERMS_PER_S: f64 = 1.0e7;
/// The same of a Newton step.
pub const NEWTON_TERMS_PER_S: f64 = 1.0e6;
/// Filaments per second that are read, checked and built, beside their bonds.
pub const FILAMENTS_PER_S: f64 = 2.0e4;
/// Bonds per second that are drawn.
pub const DRAWN_BONDS_PER_S: f64 = 1.0e6;
/// Points and frames per second of a trial motion, beside its loads: see
/// [`largest_frequency`](actin_integrate::largest_frequency).
pub const TRIAL_BODIES_PER_S: f64 = 2.0e7;
/// Points and frames per second that are recorded and written as states and pictures.
pub const RECORDED_BODIES_PER_S: f64 = 2.0e6;
/// Points and frames per second of what is written once: summary and profile.
pub const FINAL_BODIES_PER_S: f64 = 5.0e5;
/// Solid angles of the writhe per second.
pub const SOLID_ANGLES_PER_S: f64 = 9.0e7;

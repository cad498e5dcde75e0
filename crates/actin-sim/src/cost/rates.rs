//! How fast loads and Newton steps go, measured: constants of the estimates of time.
//!
//! Whole steps of motion and Newton's method on one thread of the [reference machine](REFERENCE), in a
//! release build. Rates of bonds, elements and of the bath are those of `cargo xtask tradeoff rates`; the
//! others were chosen so that estimates meet the times that `cargo xtask costs` measures, which prints by how
//! much they miss.

/// The machine of these rates, of which an estimate takes one core.
pub const REFERENCE: &str = "3.0 GHz x86-64 with AVX2";

/// Bonds between monomers per second, in whole steps of a motion, beside their monomers.
pub const BONDS_PER_S: f64 = 8.9e8;
/// Monomers per second in whole steps of a motion, beside their bonds.
pub const MONOMERS_PER_S: f64 = 1.7e7;
/// Elements of rods and junctions per second in whole steps, constant rigidities.
pub const ELEMENTS_PER_S: f64 = 5.6e7;
/// The same where a law follows curvature, twist or shear; mixtures of laws that keep the scalar path
/// take some six times as long (`docs/numerics.md`).
pub const LAW_ELEMENTS_PER_S: f64 = 3.6e7;
/// Points and frames per second that a step in a fluid solves for, with its noise.
pub const FLUID_BODIES_PER_S: f64 = 2.7e6;
/// Points and frames per second that half a step of thermal noise moves.
pub const NOISY_BODIES_PER_S: f64 = 1.5e7;
/// Bonds per second of a Newton step, beside their monomers.
pub const NEWTON_BONDS_PER_S: f64 = 5.0e8;
/// Monomers per second of a Newton step: second derivatives, factorisation and line search.
pub const NEWTON_MONOMERS_PER_S: f64 = 2.0e5;
/// Elements per second of a Newton step, constant rigidities.
pub const NEWTON_ELEMENTS_PER_S: f64 = 5.6e5;
/// The same where a law follows curvature, twist or shear.
pub const NEWTON_LAW_ELEMENTS_PER_S: f64 = 2.5e5;
/// Terms (sections, junctions, loads, linkers) per second, in whole steps: what each costs beside its
/// bonds and elements.
pub const TERMS_PER_S: f64 = 1.0e7;
/// The same of a Newton step.
pub const NEWTON_TERMS_PER_S: f64 = 1.2e6;
/// Pairs of near capsules per second, in whole steps of a motion.
pub const CONTACTS_PER_S: f64 = 4.0e7;
/// The same of a step of overdamped motion, whose matrix they fill.
pub const BROWNIAN_CONTACTS_PER_S: f64 = 5.0e5;
/// The same of a Newton step to an equilibrium.
pub const NEWTON_CONTACTS_PER_S: f64 = 6.0e4;
/// Filaments per second that are read, checked and built, beside their bonds.
pub const FILAMENTS_PER_S: f64 = 4.0e4;
/// Bonds per second that are drawn; weighted ones are known for the default geometry.
pub const DRAWN_BONDS_PER_S: f64 = 1.0e6;
/// Points and frames per second of a trial motion, beside its loads: see
/// [`largest_frequency`](actin_integrate::largest_frequency).
pub const TRIAL_BODIES_PER_S: f64 = 2.0e7;
/// Points and frames per second that are recorded and written as states and pictures.
pub const RECORDED_BODIES_PER_S: f64 = 5.0e6;
/// Points and frames per second of what is written once: summary and profile.
pub const FINAL_BODIES_PER_S: f64 = 1.5e6;
/// Solid angles of the writhe per second.
pub const SOLID_ANGLES_PER_S: f64 = 9.0e7;
/// Points and frames per second of what a motion does once: first records, bounds, a look at rest.
pub const MOVED_BODIES_PER_S: f64 = 1.2e5;
/// Stages of a path per second that are read and checked.
pub const STAGES_PER_S: f64 = 3.0e5;
/// Time of a run directory (s): files that are created, written and flushed to the disk.
pub const DIRECTORY_S: f64 = 6.0e-3;
/// Time of a record and its picture beside its bodies (s).
pub const RECORD_S: f64 = 1.2e-4;

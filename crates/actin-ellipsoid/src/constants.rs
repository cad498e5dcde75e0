//! Parameters of the ellipsoid model with their sources.
//!
//! "Table 1" and "Table 4" refer to Gunaratne, Floyd, Ni, Papoian and Erban, arXiv 2203.01284.
//! Parameters that the tables leave open are marked as choices.

use std::f64::consts::TAU;

/// Thermal energy at 298 K (pN nm).
pub const THERMAL_ENERGY: f64 = 4.114;

/// Length of one period of the filament (nm; Table 1).
pub const PERIOD: f64 = 71.2;

/// Number of monomers per period (Table 1).
pub const MONOMERS_PER_PERIOD: f64 = 26.0;

/// Turns of the left-handed one-start helix per period. The two-start helix is right-handed with 13
/// steps per turn: two monomers advance by 360/13 degrees, one by half of this minus 180 degrees.
pub(crate) const LEFT_HANDED_TURNS_PER_PERIOD: f64 = 12.0;

/// Rise per monomer (nm): 71.2 / 26 = 2.7385.
///
/// Table 1 gives 5.52 nm per step of one strand, that is 2.76 nm per monomer.
pub const RISE: f64 = PERIOD / MONOMERS_PER_PERIOD;

/// Turn about the axis per monomer (rad): -360 x 12 / 26 = -166.154 degrees.
pub(crate) const TURN: f64 = -TAU * LEFT_HANDED_TURNS_PER_PERIOD / MONOMERS_PER_PERIOD;

/// Distance of the monomer centres from the axis (nm): "effective interaction radius" of Table 1.
pub(crate) const RADIUS: f64 = 1.8;

/// Semi-axes along the radial, tangential and axial direction (nm): half of Table 1's dimensions
/// 5.4 x 5.4 x 3.8 nm. Choosing the short axis to be radial is a choice.
pub(crate) const SEMI_AXES: [f64; 3] = [1.9, 2.7, 2.7];

/// Published rigidity of a lateral interface (kBT / nm^2; Table 1).
pub(crate) const PUBLISHED_LATERAL_RIGIDITY: f64 = 392.0;

/// Published rigidity of a longitudinal interface (kBT / nm^2; Table 1).
pub(crate) const PUBLISHED_LONGITUDINAL_RIGIDITY: f64 = 582.4;

/// Ratio of Table 4's rigidities, 2.3e3 and 3.4e3 pN/nm, to the published ones.
pub const RIGIDITY_SCALE: f64 = 1.4;

/// Rigidity of a lateral interface (pN/nm): 392.0 x 1.4 x 4.114 = 2257.8 (Table 4: 2.3e3).
pub const LATERAL_RIGIDITY: f64 = PUBLISHED_LATERAL_RIGIDITY * RIGIDITY_SCALE * THERMAL_ENERGY;

/// Rigidity of a longitudinal interface (pN/nm): 582.4 x 1.4 x 4.114 = 3354.4 (Table 4: 3.4e3).
pub const LONGITUDINAL_RIGIDITY: f64 =
    PUBLISHED_LONGITUDINAL_RIGIDITY * RIGIDITY_SCALE * THERMAL_ENERGY;

/// Minimum bond length of both kinds (nm). A choice: the geometry allows 0.146 nm, which is about
/// the rounding of Table 1 and dominates twist and stretch. With 64 sampled bonds, 0.20 nm
/// reproduces Tables 3 to 5 (`docs/decisions.md`).
pub(crate) const MINIMUM_LENGTH: f64 = 0.20;

/// Maximum length of a lateral bond (nm; Table 1).
pub(crate) const LATERAL_MAXIMUM_LENGTH: f64 = 1.6;

/// Maximum length of a longitudinal bond (nm; Table 1).
pub(crate) const LONGITUDINAL_MAXIMUM_LENGTH: f64 = 2.2;

/// Sampled bonds per interface. A choice: fewer than about 12 make the filament too soft in twist.
/// With 64, the bending rigidity varies by 1 % between samplings.
pub const BONDS_PER_INTERFACE: usize = 64;

/// Quadrature bonds per interface. A choice: 12 is the smallest number whose unknowns (48) suffice
/// for the 46 moments that determine the energy.
pub const POINTS_PER_INTERFACE: usize = 12;

/// Mass of a monomer (1e-21 kg = pN ns^2/nm): 42 kDa.
pub(crate) const MASS: f64 = 0.0697;

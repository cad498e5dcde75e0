//! Published numbers of the ellipsoid model, each with its source.
//!
//! "Table 1" and "Table 4" are those of Gunaratne, Floyd, Ni, Papoian and Erban,
//! arXiv 2203.01284. What the tables leave open is marked as a choice.

use std::f64::consts::TAU;

/// Thermal energy at 298 K (pN nm).
pub const THERMAL_ENERGY: f64 = 4.114;

/// Length of one period of the filament (nm; Table 1).
pub const PERIOD: f64 = 71.2;

/// Monomers in one period (Table 1).
pub const MONOMERS_PER_PERIOD: f64 = 26.0;

/// Turns of the left-handed one-start helix in one period. Each of the two strands turns once,
/// right-handed, in its 13 steps of a period: two monomers further is 360/13 degrees, one is half
/// of that less 180 degrees, and 26 times that is -12 turns.
pub const LEFT_HANDED_TURNS_PER_PERIOD: f64 = 12.0;

/// Rise from one monomer to the next (nm): 71.2 / 26 = 2.7385.
///
/// Table 1 prints 5.52 nm, the step within one strand, that is 2.76 nm from monomer to monomer.
pub const RISE: f64 = PERIOD / MONOMERS_PER_PERIOD;

/// Turn about the axis from one monomer to the next (rad): -360 x 12 / 26 = -166.154 degrees.
pub const TURN: f64 = -TAU * LEFT_HANDED_TURNS_PER_PERIOD / MONOMERS_PER_PERIOD;

/// Distance of the monomers' centres from the axis (nm): Table 1's "effective interaction
/// radius".
pub const RADIUS: f64 = 1.8;

/// Semi-axes along the radial, tangential and axial direction (nm): Table 1's dimensions
/// 5.4 x 5.4 x 3.8 nm, halved. That the thin axis is the radial one is a choice.
pub const SEMI_AXES: [f64; 3] = [1.9, 2.7, 2.7];

/// Rigidity of a lateral interface as published (kBT / nm^2; Table 1).
pub const PUBLISHED_LATERAL_RIGIDITY: f64 = 392.0;

/// Rigidity of a longitudinal interface as published (kBT / nm^2; Table 1).
pub const PUBLISHED_LONGITUDINAL_RIGIDITY: f64 = 582.4;

/// Factor that takes the published rigidities to Table 4's 2.3e3 and 3.4e3 pN/nm.
pub const RIGIDITY_SCALE: f64 = 1.4;

/// Rigidity of a lateral interface (pN/nm): 392.0 x 1.4 x 4.114 = 2257.8 (Table 4: 2.3e3).
pub const LATERAL_RIGIDITY: f64 = PUBLISHED_LATERAL_RIGIDITY * RIGIDITY_SCALE * THERMAL_ENERGY;

/// Rigidity of a longitudinal interface (pN/nm): 582.4 x 1.4 x 4.114 = 3354.4 (Table 4: 3.4e3).
pub const LONGITUDINAL_RIGIDITY: f64 =
    PUBLISHED_LONGITUDINAL_RIGIDITY * RIGIDITY_SCALE * THERMAL_ENERGY;

/// Shortest bond of either kind (nm). A choice: the paper has none, but the shortest one that the
/// geometry allows, 0.146 nm, is about the rounding of Table 1, and rules what the tables measure. With
/// 64 drawn bonds this length meets Tables 3 to 5 (`docs/bonds.md`).
pub const MINIMUM_LENGTH: f64 = 0.20;

/// Longest lateral bond (nm; Table 1).
pub const LATERAL_MAXIMUM_LENGTH: f64 = 1.6;

/// Longest longitudinal bond (nm; Table 1).
pub const LONGITUDINAL_MAXIMUM_LENGTH: f64 = 2.2;

/// Drawn bonds per interface. A choice: fewer than about 12 make the filament too soft in twist, and
/// at 64 the bending rigidity varies by 1 % between samplings.
pub const BONDS_PER_INTERFACE: usize = 64;

/// Weighted bonds per interface. A choice: twelve are the fewest whose places, lengths and weights
/// are as many as the moments that the energy depends on, 48 and 46.
pub const POINTS_PER_INTERFACE: usize = 12;

/// Mass of a monomer (1e-21 kg = pN ns^2/nm): 42 kDa.
pub const MASS: f64 = 0.0697;

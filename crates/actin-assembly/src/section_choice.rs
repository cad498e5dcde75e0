//! Sections that were chosen for a wanted accuracy.

use serde::{Deserialize, Serialize};

/// Chosen sections, with the reasons of the choice.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SectionChoice {
    /// Wanted quantities, with the names of `actin trade`, and their largest relative errors.
    pub wanted: Vec<(String, f64)>,
    /// Limit of the number of monomers; `None` without a limit.
    pub most_monomers: Option<usize>,
    /// True if all wanted errors are met.
    pub is_met: bool,
    /// Name of the chosen resolution.
    pub name: String,
    /// Number of resolved monomers.
    pub monomers: usize,
    /// Largest relative error of each wanted quantity against every monomer; empty if no reference was run.
    pub errors: Vec<f64>,
    /// Fraction of the records of a motion that were compared.
    pub share: f64,
    /// Number of resolutions compared with the reference.
    pub tried: usize,
    /// Time of the choice (s).
    pub wall_s: f64,
}

//! What a filament stores per length, from periodic cells of monomers under uniform strain: against the
//! tables and filaments, on a grid of strains, with its scatter over drawn bonds, as tables and pictures.
//!
//! The cell is in `actin-ellipsoid`. Nothing here is fitted to a load case.

mod axes;
mod checks;
mod filament;
mod fit;
mod grid;
mod heat;
mod law;
mod pictures;
mod region;
mod rows;
mod scatter;
mod states;
pub(crate) mod surface;
mod variants;
mod waves;

use crate::Tell;
use std::fs;
use std::path::PathBuf;
use std::time::Instant;

/// What is computed, and where it goes.
#[derive(Clone, Debug)]
pub struct Options {
    /// Where to write tables and pictures.
    pub out: PathBuf,
    /// A coarser grid and fewer samplings.
    pub quick: bool,
    /// Samplings of drawn bonds, at least two.
    pub samplings: Option<u64>,
    /// Temperature of the part `Heat` (K).
    pub temperature_k: f64,
    /// Parts to compute, all if none is named.
    pub parts: Vec<Part>,
}

/// A part of the study.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Twist, stretch, bending and shear under tension, beside the tables and what is known of filaments.
    Checks,
    /// What must not matter: size of the cell, what ties it to its axis, number of samplings.
    Variants,
    /// Where a cell has several states, and how it bends in a plane.
    States,
    /// Scatter over drawn bonds.
    Scatter,
    /// Energy, loads and tangent over all strains.
    Grid,
    /// A law of rods fitted to strained and loaded cells and to parts of the grid, which is computed if it is not there.
    Law,
    /// The same law fitted to cells of drawn bonds.
    Drawn,
    /// Loads at a temperature.
    Heat,
    /// Filaments of monomers and rods under waves of load, down to two monomers.
    Waves,
}

impl Part {
    const ALL: [Self; 9] = [
        Self::Checks,
        Self::Variants,
        Self::States,
        Self::Scatter,
        Self::Grid,
        Self::Law,
        Self::Drawn,
        Self::Heat,
        Self::Waves,
    ];
}

/// Computes the parts, prints their tables and writes them.
///
/// # Errors
/// A file that cannot be written, and a cell without an equilibrium.
pub fn run(options: &Options, tell: Tell<'_>) -> Result<(), String> {
    let out = &options.out;
    fs::create_dir_all(out).map_err(|e| format!("{}: {e}", out.display()))?;
    let samplings = options
        .samplings
        .unwrap_or(if options.quick { 4 } else { 8 })
        .max(2);
    let axes = axes::Axes::new(options.quick);
    let is_wanted = |part: &Part| options.parts.is_empty() || options.parts.contains(part);
    for part in Part::ALL.into_iter().filter(is_wanted) {
        let clock = Instant::now();
        match part {
            Part::Checks => checks::run(out, samplings, tell)?,
            Part::Variants => variants::run(out, samplings, tell)?,
            Part::States => states::run(out, tell)?,
            Part::Scatter => scatter::run(out, samplings, tell)?,
            Part::Grid => {
                let grid = grid::compute(out, &axes, tell)?;
                pictures::draw(out, &grid)?;
            }
            Part::Law => {
                let grid = grid::compute(out, &axes, tell)?;
                law::run(out, &axes, &grid, samplings, tell)?;
            }
            Part::Drawn => {
                let grid = grid::compute(out, &axes, tell)?;
                law::run_drawn(out, &axes, &grid, tell)?;
            }
            Part::Heat => heat::run(out, options.temperature_k, options.quick, tell)?,
            Part::Waves => waves::run(out, options.quick, tell)?,
        }
        tell(format_args!(
            "{part:?}: {:.0} s\n",
            clock.elapsed().as_secs_f64()
        ));
    }
    Ok(())
}

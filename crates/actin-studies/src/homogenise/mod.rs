//! Energy per length of periodic cells of monomers under uniform strain, on a grid of strains, and the laws of rods fitted
//! to it: the provenance of `Homogenised`, at rest, with drawn bonds and at 298 K.
//!
//! The cell is in `actin-ellipsoid`. Load cases enter no fit.

mod axes;
mod fit;
mod grid;
mod heat;
mod law;
mod region;
mod rows;
mod states;

use anyhow::{Error, Result};
use clap::ValueEnum;
use std::fs;
use std::path::PathBuf;
use std::time::Instant;

/// Parts and output of the study.
#[derive(clap::Args, Debug)]
pub(crate) struct Options {
    /// Parts to compute, all if none is named.
    #[arg(value_enum)]
    parts: Vec<Part>,
    /// Folder of tables; slices of the grid that are there are kept.
    #[arg(long, default_value = "target/homogenise")]
    out: PathBuf,
    /// A coarser grid and fewer samples.
    #[arg(long)]
    quick: bool,
    /// Temperature of the part `heat` (K).
    #[arg(long, default_value_t = 298.0)]
    temperature: f64,
}

/// A part of the study.
#[derive(clap::ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    /// Several states of twisted and bent cells, and their bending in a plane.
    States,
    /// Energy, loads and tangent over all strains.
    Grid,
    /// A law of rods fitted to the grid, which is computed if it is not there.
    Law,
    /// The same law fitted to cells of drawn bonds.
    Drawn,
    /// Mean loads of the filament at a temperature, and the law fitted to them.
    Heat,
}

/// Computes the parts, prints their tables and writes them.
///
/// # Errors
/// A file that cannot be written, and a cell without an equilibrium.
pub(crate) fn run(options: &Options) -> Result<()> {
    compute(options).map_err(Error::msg)
}

fn compute(options: &Options) -> Result<(), String> {
    let (out, quick) = (&options.out, options.quick);
    fs::create_dir_all(out).map_err(|e| format!("{}: {e}", out.display()))?;
    let axes = axes::Axes::new(quick);
    let grid = || grid::compute(out, &axes);
    let is_wanted = |part: &Part| options.parts.is_empty() || options.parts.contains(part);
    for part in Part::value_variants().iter().filter(|part| is_wanted(part)) {
        let clock = Instant::now();
        match part {
            Part::States => states::run(out)?,
            Part::Grid => drop(grid()?),
            Part::Law => law::run(out, &axes, &grid()?)?,
            Part::Drawn => law::run_drawn(out, &axes, &grid()?)?,
            Part::Heat => heat::run(out, options.temperature, quick)?,
        }
        println!("{part:?}: {:.0} s\n", clock.elapsed().as_secs_f64());
    }
    Ok(())
}

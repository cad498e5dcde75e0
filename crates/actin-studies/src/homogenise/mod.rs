//! Energy per length of periodic cells of monomers on a grid of uniform strains, and rod laws fitted to it. Origin of
//! the laws `Homogenised`, athermal, with sampled bonds, and at 298 K.
//!
//! `actin-ellipsoid` contains the cell. Load cases are not used in the fits.

mod axes;
mod fit;
mod grid;
mod heat;
mod law;
mod mesh;
mod region;
mod rows;
mod states;

use anyhow::{Error, Result};
use clap::ValueEnum;
use std::fs;
use std::path::PathBuf;
use std::time::Instant;

#[derive(clap::Args, Debug)]
pub(crate) struct Options {
    /// Parts to compute; all by default.
    #[arg(value_enum)]
    parts: Vec<Part>,
    /// Output folder of tables; existing slices of the grid are reused.
    #[arg(long, default_value = "target/homogenise")]
    out: PathBuf,
    /// Uses a coarser grid and fewer samples.
    #[arg(long)]
    quick: bool,
    /// Temperature of the part `heat` (K).
    #[arg(long, default_value_t = 298.0)]
    temperature: f64,
}

#[derive(clap::ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    /// Multiple states of twisted and bent cells, and their bending in a plane.
    States,
    /// Energy, loads and tangent on a grid of strains.
    Grid,
    /// Law fitted to the grid, which is computed if missing.
    Law,
    /// Law fitted to cells with sampled bonds.
    Drawn,
    /// Mean loads at a temperature, and the law fitted to them.
    Heat,
    /// Dependence of the law at 298 K on the segment length.
    Mesh,
}

/// Computes the parts, and prints and writes their tables.
///
/// # Errors
/// If a file cannot be written, or a cell has no equilibrium.
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
            Part::Mesh => mesh::run(out)?,
        }
        println!("{part:?}: {:.0} s\n", clock.elapsed().as_secs_f64());
    }
    Ok(())
}

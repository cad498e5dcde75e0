//! `cargo xtask homogenise`: what a filament of monomers stores per length under all six strains.

use actin_paper::homogenise;
use anyhow::{Error, Result};
use std::path::PathBuf;

/// What is computed, and where it goes.
#[derive(clap::Args, Debug)]
pub(crate) struct Options {
    /// Parts to compute, all if none is named.
    #[arg(value_enum)]
    parts: Vec<Part>,
    /// Where to write tables and pictures; slices of the grid that are there are kept.
    #[arg(long, default_value = "target/homogenise")]
    out: PathBuf,
    /// A coarser grid and fewer samplings.
    #[arg(long)]
    quick: bool,
    /// Samplings of drawn bonds.
    #[arg(long)]
    samplings: Option<u64>,
    /// Temperature of the part `heat` (K).
    #[arg(long, default_value_t = 298.0)]
    temperature: f64,
}

/// A part of the study.
#[derive(clap::ValueEnum, Clone, Copy, Debug)]
enum Part {
    /// Twist, stretch, bending and shear under tension, beside the paper's tables.
    Checks,
    /// Size of the cell, what ties it to its axis, number of samplings.
    Variants,
    /// Where a twisted and bent cell has several states, and how it bends in a plane.
    States,
    /// Scatter over drawn bonds.
    Scatter,
    /// Energy, loads and tangent over all strains.
    Grid,
    /// A law of rods fitted to the grid.
    Law,
    /// The same law fitted to cells of drawn bonds.
    Drawn,
    /// Mean loads of the filament at a temperature.
    Heat,
    /// Monomers and rods under waves of load.
    Waves,
}

impl From<Part> for homogenise::Part {
    fn from(part: Part) -> Self {
        match part {
            Part::Checks => Self::Checks,
            Part::Variants => Self::Variants,
            Part::States => Self::States,
            Part::Scatter => Self::Scatter,
            Part::Grid => Self::Grid,
            Part::Law => Self::Law,
            Part::Drawn => Self::Drawn,
            Part::Heat => Self::Heat,
            Part::Waves => Self::Waves,
        }
    }
}

/// Computes the parts, prints their tables and writes them.
pub(crate) fn run(options: Options) -> Result<()> {
    let options = homogenise::Options {
        out: options.out,
        quick: options.quick,
        samplings: options.samplings,
        temperature_k: options.temperature,
        parts: options.parts.into_iter().map(Into::into).collect(),
    };
    homogenise::run(&options, &|line| println!("{line}")).map_err(Error::msg)
}

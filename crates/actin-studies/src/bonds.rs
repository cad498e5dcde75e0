//! `cargo xtask bonds`: which bonds the monomers have.

use actin_paper::bonds;
use anyhow::{Error, Result};
use std::path::PathBuf;

/// What is computed, and where it goes.
#[derive(clap::Args, Debug)]
pub(crate) struct Options {
    /// Where to write tables.
    #[arg(long, default_value = "target/bonds")]
    out: PathBuf,
    /// Four samplings instead of 16, and a tenth of the motion.
    #[arg(long)]
    quick: bool,
    /// Samplings of drawn bonds.
    #[arg(long)]
    samplings: Option<u64>,
    /// Parts to compute, all if none is named.
    #[arg(value_enum)]
    parts: Vec<Part>,
    /// Also into `docs/tables/bonds.md`.
    #[arg(long, conflicts_with_all = ["quick", "samplings"])]
    write: bool,
}

/// A part of the study.
#[derive(clap::ValueEnum, Clone, Copy, Debug)]
enum Part {
    /// Tables 3 to 5 against the shortest bond, the number of bonds, rise and radius.
    Shortest,
    /// Tables 3 to 5 against the number of weighted bonds.
    Weighted,
    /// Some of the paper's figures against the number of weighted bonds.
    Figures,
    /// Time step and energy drift.
    Motion,
    /// Stiffness at room temperature.
    Heat,
}

impl From<Part> for bonds::Part {
    fn from(part: Part) -> Self {
        match part {
            Part::Shortest => Self::Shortest,
            Part::Weighted => Self::Weighted,
            Part::Figures => Self::Figures,
            Part::Motion => Self::Motion,
            Part::Heat => Self::Heat,
        }
    }
}

/// Computes the parts, prints their tables and writes them.
pub(crate) fn run(options: Options) -> Result<()> {
    let options = bonds::Options {
        out: options.out,
        quick: options.quick,
        samplings: options.samplings,
        parts: options.parts.into_iter().map(Into::into).collect(),
        write: options.write,
    };
    bonds::run(&options, &|line| println!("{line}")).map_err(Error::msg)
}

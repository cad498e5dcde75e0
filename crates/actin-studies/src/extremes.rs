//! `cargo xtask extremes`: every number that a user can write, taken to where it breaks.

use actin_paper::extremes;
use anyhow::{Error, Result};
use std::path::PathBuf;

/// What is computed, and where it goes.
#[derive(clap::Args, Debug)]
pub(crate) struct Options {
    /// Where to write the table and the pictures.
    #[arg(long, default_value = "target/extremes")]
    out: PathBuf,
    /// Also the rows that take minutes: 1e6 bodies, 1e7 steps.
    #[arg(long)]
    long: bool,
    /// Also into `docs/tables/extremes.md`, with the pictures of `docs/extremes.md`, if all rows are sound.
    #[arg(long, requires = "long")]
    write: bool,
}

/// Computes, prints and writes.
pub(crate) fn run(options: Options) -> Result<()> {
    let Options { out, long, write } = options;
    let options = extremes::Options { out, long, write };
    extremes::run(&options, &|line| println!("{line}")).map_err(Error::msg)
}

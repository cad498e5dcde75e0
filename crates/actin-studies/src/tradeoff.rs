//! `cargo xtask tradeoff`: what a user gives up in accuracy for each saving in time.

use actin_paper::tradeoff;
use anyhow::{Error, Result};
use std::path::PathBuf;

/// What is measured, and where it goes.
#[derive(clap::Args, Clone, Debug)]
pub(crate) struct Options {
    /// Which: names of scenes, `vibration`, `rest`; all by default. `rates` measures how fast loads
    /// and Newton steps go.
    scenes: Vec<String>,
    /// Where to write tables and pictures.
    #[arg(long, default_value = "target/tradeoff")]
    out: PathBuf,
    /// Fewer settings, azimuths and samplings.
    #[arg(long)]
    quick: bool,
}

/// Measures, writes, draws and prints.
pub(crate) fn run(options: Options) -> Result<()> {
    let options = tradeoff::Options {
        scenes: options.scenes,
        out: options.out,
        quick: options.quick,
    };
    tradeoff::run(&options, &|line| println!("{line}")).map_err(Error::msg)
}

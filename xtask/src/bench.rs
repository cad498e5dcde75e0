//! `cargo xtask bench`: how fast fixed cases run, in a release build.

use crate::command::optimised;
use actin_paper::bench;
use anyhow::{Error, Result};

/// Which cases, and how they are printed.
#[derive(clap::Args, Debug)]
pub(crate) struct Options {
    /// Which; all by default.
    #[arg(value_name = "CASE")]
    cases: Vec<String>,
    /// Prints an array of `case`, `rate`, `unit` instead of a table.
    #[arg(long)]
    json: bool,
}

/// Measures and prints.
pub(crate) fn run(options: Options) -> Result<()> {
    let Options { cases, json } = options;
    let options = bench::Options { cases, json };
    optimised(|| bench::run(&options, &|line| println!("{line}")).map_err(Error::msg))
}

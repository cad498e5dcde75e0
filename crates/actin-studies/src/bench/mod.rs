//! `cargo xtask bench`: how fast fixed cases run, in a release build, and other programs beside them.

mod peers;

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
    /// Runs the same cases in other programs where these are installed, and prints ratios.
    #[arg(long, conflicts_with = "json")]
    peers: bool,
}

/// Measures and prints.
pub(crate) fn run(options: Options) -> Result<()> {
    let Options { cases, json, peers } = options;
    let options = bench::Options { cases, json };
    let ours = bench::run(&options, &|line| println!("{line}")).map_err(Error::msg)?;
    if peers {
        println!("");
        peers::compare(&ours, &|line| println!("{line}"));
    }
    Ok(())
}

//! `cargo xtask costs`: what scenes cost beside what `actin check` estimates, in a release build.

use actin_paper::costs;
use anyhow::{Error, Result};

/// What is measured.
#[derive(clap::Args, Debug)]
pub(crate) struct Options {
    /// Which: names of families, `trade`; all by default.
    names: Vec<String>,
    /// The largest size of a family.
    #[arg(long, default_value_t = 1_000_000)]
    largest: usize,
    /// Fewer settings of the scenes of `cargo xtask tradeoff`.
    #[arg(long)]
    quick: bool,
}

/// Measures and prints.
pub(crate) fn run(options: Options) -> Result<()> {
    let Options {
        names,
        largest,
        quick,
    } = options;
    let options = costs::Options {
        names,
        largest,
        quick,
    };
    costs::run(&options, &|line| println!("{line}")).map_err(Error::msg)
}

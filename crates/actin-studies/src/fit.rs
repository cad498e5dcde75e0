//! `cargo xtask fit-parameters`: a rod's laws from tables or from filaments of monomers.

use actin_paper::fit;
use anyhow::{Error, Result};
use std::path::PathBuf;

/// What is fitted, and where the result goes.
#[derive(clap::Args, Debug)]
pub(crate) struct Options {
    /// Fits your table, with its columns of twist, length, bending or stretch
    /// (docs/how-to/fit-a-rod-law.md).
    #[arg(long, value_name = "FILE.csv", conflicts_with_all = ["measure", "all_rows"])]
    data: Option<PathBuf>,
    /// Measures filaments of monomers first and fits what they show, bending and shear included.
    #[arg(long, conflicts_with = "all_rows")]
    measure: bool,
    /// Takes also the rows of the paper's tables above 200 degrees, which it calls unreliable.
    #[arg(long)]
    all_rows: bool,
    /// Accepts these parameters, such as `b3.rest,bend.rise`, at a bound of their search; any other
    /// one there is a failure, and nothing is written.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    allow_bounds: Vec<String>,
    /// Where to write laws, curves and pictures.
    #[arg(long, default_value = "target/fit")]
    out: PathBuf,
}

/// Fits, prints and writes.
pub(crate) fn run(options: Options) -> Result<()> {
    let options = fit::Options {
        data: options.data,
        measure: options.measure,
        all_rows: options.all_rows,
        allow_bounds: options.allow_bounds,
        out: options.out,
    };
    fit::run(&options, &|line| println!("{line}")).map_err(Error::msg)
}

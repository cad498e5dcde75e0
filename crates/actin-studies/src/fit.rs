//! `cargo xtask fit-parameters`: rod laws from tables or from monomer filaments.

use actin_paper::fit;
use anyhow::{Error, Result};
use std::path::PathBuf;

#[derive(clap::Args, Debug)]
pub(crate) struct Options {
    /// Fits a table with columns of twist, length, bending or stretch (docs/how-to/rod-laws.md).
    #[arg(long, value_name = "FILE.csv", conflicts_with_all = ["measure", "all_rows"])]
    data: Option<PathBuf>,
    /// Measures monomer filaments and fits all rigidities, including bending and shear.
    #[arg(long, conflicts_with = "all_rows")]
    measure: bool,
    /// Includes rows above 200 degrees, which the paper calls unreliable.
    #[arg(long)]
    all_rows: bool,
    /// Accepts these parameters, such as `b3.rest,bend.rise`, at a bound of the search. Other parameters at a bound
    /// are an error, and nothing is written.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    allow_bounds: Vec<String>,
    /// Output folder of laws, curves and figures.
    #[arg(long, default_value = "target/fit")]
    out: PathBuf,
}

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

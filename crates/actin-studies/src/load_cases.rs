//! `cargo xtask load-cases`: how far rods under a law are from filaments of monomers.

use actin_paper::load_cases::{self, Subject};
use anyhow::{Error, Result};
use std::path::PathBuf;

/// What is measured, and where it goes.
#[derive(clap::Args, Clone, Debug)]
#[allow(clippy::struct_excessive_bools, reason = "flags of a command line")]
pub(crate) struct Options {
    /// Laws by the names that scenes use.
    #[arg(
        long,
        value_delimiter = ',',
        default_value = "Constant,Fitted,Homogenised"
    )]
    laws: Vec<String>,
    /// Where to write tables and pictures; equilibria of monomers that are there are kept.
    #[arg(long, default_value = "target/load-cases")]
    out: PathBuf,
    /// Fewer cases, azimuths and samplings.
    #[arg(long)]
    quick: bool,
    /// Also into the committed file: `docs/tables/load-cases.md` or, with `--beyond`, the table of the program.
    #[arg(long, conflicts_with = "quick")]
    write: bool,
    /// Instead, how much length is missing at the ends of short spans.
    #[arg(long, conflicts_with = "write")]
    ends: bool,
    /// Instead, errors of cantilevers that leave the data of `Homogenised`, which its warning gives.
    #[arg(long, conflicts_with = "ends")]
    beyond: bool,
}

/// Measures, writes, draws and prints.
pub(crate) fn run(options: Options) -> Result<()> {
    let subject = match (options.ends, options.beyond) {
        (true, _) => Subject::Ends,
        (_, true) => Subject::BeyondData,
        _ => Subject::Cases,
    };
    let options = load_cases::Options {
        out: options.out,
        quick: options.quick,
        laws: options.laws,
        write: options.write,
        subject,
    };
    load_cases::run(&options, &|line| println!("{line}")).map_err(Error::msg)
}

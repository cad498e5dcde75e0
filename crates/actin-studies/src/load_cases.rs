//! `cargo xtask load-cases`: differences between rods with a law and monomer filaments.

use actin_paper::load_cases::{self, Subject};
use anyhow::{Error, Result};
use std::path::PathBuf;

#[derive(clap::Args, Clone, Debug)]
#[allow(clippy::struct_excessive_bools, reason = "flags of a command line")]
pub(crate) struct Options {
    /// Names of laws, as in scenes.
    #[arg(
        long,
        value_delimiter = ',',
        default_value = "Constant,Fitted,Homogenised"
    )]
    laws: Vec<String>,
    /// Output folder of tables and figures; existing equilibria of monomers are reused.
    #[arg(long, default_value = "target/load-cases")]
    out: PathBuf,
    /// Uses fewer cases, azimuths and samples.
    #[arg(long)]
    quick: bool,
    /// Also writes the committed file: `docs/tables/load-cases.md` or, with `--beyond`, the table of the program.
    #[arg(long, conflicts_with = "quick")]
    write: bool,
    /// Measures the length correction at the ends of short spans instead.
    #[arg(long, conflicts_with = "write")]
    ends: bool,
    /// Measures errors of cantilevers beyond the range of the law `Homogenised` instead, for its warning.
    #[arg(long, conflicts_with = "ends")]
    beyond: bool,
}

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

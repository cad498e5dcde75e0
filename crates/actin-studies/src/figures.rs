//! `cargo xtask reproduce-figures`: figures and tables of the paper, recomputed and compared.

use actin_paper::committed;
use actin_paper::figures;
use anyhow::{Error, Result};
use std::path::PathBuf;

#[expect(clippy::struct_excessive_bools, reason = "flags of a command line")]
#[derive(clap::Args, Clone, Debug)]
pub(crate) struct Options {
    /// Artefacts: fig1 to fig10, table1 to table5, law. All by default.
    ids: Vec<String>,
    /// Output folder of figures, tables and reports.
    #[arg(long, default_value = "target/figures")]
    out: PathBuf,
    /// Uses fewer resolutions and samples, and equilibria only.
    #[arg(long)]
    quick: bool,
    /// Writes the numbers of a quick run to docs/report-quick.json.
    #[arg(long, requires = "quick")]
    write: bool,
    /// Number of threads; by default the number of cores. Results are independent of it.
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
    /// Recomputes artefacts that an earlier run has finished.
    #[arg(long)]
    fresh: bool,
    /// Also writes every figure as PDF and PNG; requires Chromium, in CHROME or on the path.
    #[arg(long)]
    print: bool,
    /// Colours of figures and of the viewer.
    #[arg(long, value_enum, default_value_t)]
    palette: Palette,
}

#[derive(Clone, Copy, Debug, Default, clap::ValueEnum)]
enum Palette {
    /// Red (monomers) through yellow to blue (rod), as in the paper.
    #[default]
    Paper,
    /// Light green (monomers) to dark purple (rod), distinguishable with colour blindness and in greyscale.
    ColourBlind,
}

pub(crate) fn run(options: Options) -> Result<()> {
    let (quick, write) = (options.quick, options.write);
    let options = figures::Options {
        ids: options.ids,
        out: options.out,
        quick,
        threads: options.threads,
        fresh: options.fresh,
        print: options.print,
        palette: match options.palette {
            Palette::Paper => figures::Palette::Paper,
            Palette::ColourBlind => figures::Palette::ColourBlind,
        },
    };
    let tell = &|line: std::fmt::Arguments<'_>| println!("{line}");
    let rows = figures::reproduce(&options, tell).map_err(Error::msg)?;
    let compared = if write {
        committed::write_quick(&rows, tell)
    } else {
        committed::compare(&rows, quick, tell)
    };
    compared.map_err(Error::msg)
}

//! `cargo xtask reproduce-figures`: artefacts of the paper, computed and compared.

use actin_paper::committed;
use actin_paper::figures;
use anyhow::{Error, Result};
use std::path::PathBuf;

/// What is computed, and how.
#[expect(clippy::struct_excessive_bools, reason = "flags of a command line")]
#[derive(clap::Args, Clone, Debug)]
pub(crate) struct Options {
    /// Which: fig1 to fig10, table1 to table5, law. All by default.
    ids: Vec<String>,
    /// Where to write pictures, tables and reports.
    #[arg(long, default_value = "target/figures")]
    out: PathBuf,
    /// Fewer resolutions and samplings, and equilibria only.
    #[arg(long)]
    quick: bool,
    /// Takes the numbers of a quick run over into docs/report-quick.json.
    #[arg(long, requires = "quick")]
    write: bool,
    /// Number of threads; one for each core by default. The results do not depend on it.
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
    /// Computes again also what an earlier run has finished.
    #[arg(long)]
    fresh: bool,
    /// Writes every picture as PDF and PNG, too; needs a Chromium, in CHROME or on the path.
    #[arg(long)]
    print: bool,
    /// Colours of pictures and viewer.
    #[arg(long, value_enum, default_value_t)]
    palette: Palette,
}

/// A set of colours.
#[derive(Clone, Copy, Debug, Default, clap::ValueEnum)]
enum Palette {
    /// From red through yellow to blue with the share of rod, as in the paper.
    #[default]
    Paper,
    /// From light green to dark purple; told apart without red and green, and in grey.
    ColourBlind,
}

/// Computes the artefacts, reports, and tells how they differ from the committed ones.
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

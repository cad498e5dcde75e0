//! `cargo xtask reproduce-figures`: figures and tables of the paper, recomputed and compared.

use actin_paper::committed;
use actin_paper::figures;
use anyhow::{Error, Result};

#[derive(clap::Args, Clone, Debug)]
pub(crate) struct Options {
    #[command(flatten)]
    all: figures::Options,
    /// Writes the numbers of a quick run to docs/report-quick.json.
    #[arg(long, requires = "quick")]
    write: bool,
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
    let quick = options.all.quick;
    let chosen = figures::Options {
        palette: match options.palette {
            Palette::Paper => figures::Palette::Paper,
            Palette::ColourBlind => figures::Palette::ColourBlind,
        },
        ..options.all
    };
    let tell = &|line: std::fmt::Arguments<'_>| println!("{line}");
    let rows = figures::reproduce(&chosen, tell).map_err(Error::msg)?;
    let compared = if options.write {
        committed::write_quick(&rows, tell)
    } else {
        committed::compare(&rows, quick, tell)
    };
    compared.map_err(Error::msg)
}

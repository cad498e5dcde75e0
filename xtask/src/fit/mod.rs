//! `cargo xtask fit-parameters`: a rod's laws from tables or from filaments of monomers.

mod bend;
mod column;
mod data;
mod forms;
mod found;
mod measured;
mod own;
mod pictures;
mod print;
mod search;
mod table;
#[cfg(test)]
mod tests;
mod twist;
mod write;

pub(crate) use data::TwistData;
pub(crate) use pictures::{Beside, draw};
pub(crate) use twist::{TwistFits, rms};

use bend::BendFits;
use measured::BendData;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// What is fitted, and where the result goes.
#[derive(clap::Args, Debug)]
pub(crate) struct Options {
    /// Fits a table of one's own, with its columns of twist, length, bending or stretch
    /// (docs/fitting.md).
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
///
/// # Errors
/// Data that cannot be read or fitted, and a fit with a parameter at a bound that is not allowed, or
/// that the data do not determine. Nothing is written then.
pub(crate) fn run(options: &Options) -> Result<(), String> {
    let started = Instant::now();
    let out: &Path = &options.out;
    search::check_keys(&options.allow_bounds)?;
    match &options.data {
        Some(path) => own::run(path, &options.allow_bounds, out)?,
        None => tables(options, out)?,
    }
    println!(
        "written to {} in {:.1} s: laws as RON, curves as CSV, pictures as SVG",
        out.display(),
        started.elapsed().as_secs_f64()
    );
    Ok(())
}

/// Fits the paper's tables, or filaments measured on the spot.
fn tables(options: &Options, out: &Path) -> Result<(), String> {
    let data = if options.measure {
        measured::twisted()?
    } else {
        TwistData::from_paper(options.all_rows)?
    };
    let fits = TwistFits::new(&data)?;
    print::twist(&data, &fits);
    let mut faults = fits.faults();
    let mut bend = None;
    if options.measure {
        println!("measuring bending and shear ...");
        let data = BendData::measure()?;
        let fits = BendFits::new(&data)?;
        print::bend(&data, &fits);
        faults.extend(fits.faults());
        bend = Some((data, fits));
    }
    found::accept(&faults, &options.allow_bounds)?;
    create(out)?;
    if let Some((data, fits)) = &bend {
        write::bend_csv(data, fits, out)?;
    }
    write::laws(&fits, bend.as_ref().map(|(_, fits)| fits), out)?;
    write::curves(&data, &fits, out)?;
    draw(&data, &fits, &[], out)?;
    Ok(())
}

fn create(out: &Path) -> Result<(), String> {
    fs::create_dir_all(out).map_err(|e| format!("{}: {e}", out.display()))
}

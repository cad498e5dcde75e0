//! Fits of rod laws to tables or to filaments of monomers.

mod bend;
mod catalogue;
mod column;
mod forms;
mod groups;
mod measured;
mod parameter_fit;
mod pictures;
mod print;
mod search;
mod table;
#[cfg(test)]
mod tests;
mod twist;
mod write;

pub(crate) use pictures::{UnfittedData, draw};
pub(crate) use table::FitData;
pub(crate) use twist::TwistFits;

use crate::ProgressSink;
use bend::BendFits;
use groups::GroupFits;
use measured::BendData;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Data and output of a fit: the command line of `cargo xtask fit-parameters`.
#[derive(clap::Args, Clone, Debug)]
pub struct Options {
    /// Fits a table with columns of twist, length, bending or stretch (docs/how-to/rod-laws.md).
    #[arg(long, value_name = "FILE.csv", conflicts_with_all = ["measure", "all_rows"])]
    pub data: Option<PathBuf>,
    /// Measures monomer filaments and fits all rigidities, including bending and shear.
    #[arg(long, conflicts_with = "all_rows")]
    pub measure: bool,
    /// Includes rows above 200 degrees, which the paper calls unreliable.
    #[arg(long)]
    pub all_rows: bool,
    /// Accepts these parameters, such as `b3.rest,bend.rise`, at a bound of the search. Other parameters at a bound
    /// are an error, and nothing is written.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub allow_bounds: Vec<String>,
    /// Output folder of laws, curves and figures.
    #[arg(long, default_value = "target/fit")]
    pub out: PathBuf,
}

/// Fits, prints and writes the laws.
///
/// # Errors
/// Unreadable or unsuitable data, an undetermined parameter, or a parameter at a bound that is not
/// allowed. No files are written on error.
pub fn run(options: &Options, tell: ProgressSink<'_>) -> Result<(), String> {
    let started = Instant::now();
    let out: &Path = &options.out;
    search::check_keys(&options.allow_bounds)?;
    match &options.data {
        Some(path) => user_table(path, &options.allow_bounds, out, tell)?,
        None => tables(options, out, tell)?,
    }
    tell(format_args!(
        "written to {} in {:.1} s: laws as RON, curves as CSV, pictures as SVG",
        out.display(),
        started.elapsed().as_secs_f64()
    ));
    Ok(())
}

/// Fits a user's table.
fn user_table(
    path: &Path,
    allowed: &[String],
    out: &Path,
    tell: ProgressSink<'_>,
) -> Result<(), String> {
    let data = FitData::from_csv(path)?;
    let fits = GroupFits::new(&data)?;
    tell(format_args!("data: {}", data.source));
    print::groups(tell, &fits);
    parameter_fit::accept(&fits.faults(), allowed)?;
    write::create(out)?;
    write::groups(&fits, out)
}

/// Fits the paper's tables, or newly measured filaments.
fn tables(options: &Options, out: &Path, tell: ProgressSink<'_>) -> Result<(), String> {
    let data = if options.measure {
        measured::twisted()?
    } else {
        FitData::from_paper(options.all_rows)
    };
    let fits = TwistFits::new(&data)?;
    print::twist(tell, &data, &fits);
    let mut faults = fits.faults();
    let mut bend = None;
    if options.measure {
        tell(format_args!("measuring bending and shear ..."));
        let data = BendData::measure()?;
        let fits = BendFits::new(&data)?;
        print::bend(tell, &data, &fits);
        faults.extend(fits.faults());
        bend = Some((data, fits));
    }
    parameter_fit::accept(&faults, &options.allow_bounds)?;
    write::create(out)?;
    if let Some((data, fits)) = &bend {
        write::bend_csv(data, fits, out)?;
    }
    write::laws(&fits, bend.as_ref().map(|(_, fits)| fits), out)?;
    write::curves(&data, &fits, out)?;
    draw(&data, &fits, &[], out)?;
    Ok(())
}

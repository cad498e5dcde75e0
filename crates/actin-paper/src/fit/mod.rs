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

/// Data and output of a fit.
#[derive(Clone, Debug)]
pub struct Options {
    /// Fits a user's table with columns of twist, length, bending or stretch
    /// (`docs/how-to/rod-laws.md`).
    pub data: Option<PathBuf>,
    /// Measures filaments of monomers and fits the results, including bending and shear.
    pub measure: bool,
    /// Includes the rows of the paper's tables above 200 degrees, which it calls unreliable.
    pub all_rows: bool,
    /// Parameters, such as `b3.rest,bend.rise`, that are accepted at a bound of their search.
    pub allow_bounds: Vec<String>,
    /// Output folder.
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

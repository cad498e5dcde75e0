//! `cargo xtask fit-parameters`: a rod's laws from tables or from filaments of monomers.

mod bend;
mod data;
mod forms;
mod measured;
mod pictures;
mod print;
mod twist;
mod write;

pub(crate) use data::TwistData;
pub(crate) use pictures::draw;
pub(crate) use twist::TwistFits;

use bend::BendFits;
use measured::BendData;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Bond samplings behind measured twist, and behind measured bending.
const SAMPLINGS: [u64; 2] = [16, 8];

/// What is fitted, and where the result goes.
#[derive(clap::Args, Debug)]
pub(crate) struct Options {
    /// Fits a table of one's own: columns `kappa3_rad_per_nm`, `b3_pn_nm2`, `dl_over_l`.
    #[arg(long, value_name = "FILE.csv", conflicts_with_all = ["measure", "all_rows"])]
    data: Option<PathBuf>,
    /// Measures filaments of monomers first and fits what they show, bending and shear included.
    #[arg(long, conflicts_with = "all_rows")]
    measure: bool,
    /// Takes also the rows of the paper's tables above 200 degrees, which it calls unreliable.
    #[arg(long)]
    all_rows: bool,
    /// Where to write laws, curves and pictures.
    #[arg(long, default_value = "target/fit")]
    out: PathBuf,
}

/// Fits, prints and writes.
pub(crate) fn run(options: &Options) -> Result<(), String> {
    let out: &Path = &options.out;
    fs::create_dir_all(out).map_err(|e| format!("{}: {e}", out.display()))?;
    let started = Instant::now();
    let data = match &options.data {
        Some(path) => TwistData::from_csv(path)?,
        None if options.measure => measured::twisted(SAMPLINGS[0])?,
        None => TwistData::from_paper(options.all_rows)?,
    };
    let fits = TwistFits::new(&data)?;
    print::twist(&data, &fits);
    let bend = if options.measure {
        println!("measuring bending and shear ...");
        let bends = BendData::measure(SAMPLINGS[1])?;
        let fits = BendFits::new(&bends)?;
        print::bend(&bends, &fits);
        write::bend_csv(&bends, &fits, out)?;
        Some(fits)
    } else {
        None
    };
    write::laws(&fits, bend.as_ref(), out)?;
    write::curves(&data, &fits, out)?;
    draw(&data, &fits, out)?;
    println!(
        "written to {} in {:.1} s: laws as RON, curves as CSV, pictures as SVG",
        out.display(),
        started.elapsed().as_secs_f64()
    );
    Ok(())
}

//! `actin export`: conversion of a finished run to a file format of another program.

use crate::failure::Failure;
use actin_rundir::{FinishedRun, Format, default_export_path};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

pub(crate) const EXIT_CODES: &str = "Exit codes:
    0  done
    2  bad input: not a run directory, no states.npz in it, or the output file exists
   74  the file could not be written; no partial file remains";

#[derive(Debug, Args)]
pub(crate) struct ExportArguments {
    /// Run directory to convert.
    run: PathBuf,
    /// Output format.
    #[arg(long, value_name = "FORMAT")]
    to: Target,
    /// Output file; by default the name of the run directory with the extension of the format.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Replaces an existing file.
    #[arg(long)]
    overwrite: bool,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Target {
    #[value(help = "GSD: OVITO, MDAnalysis, HOOMD-blue")]
    Gsd,
    #[value(help = "JSON of the Simularium viewer, with meshes")]
    Simularium,
}

impl Target {
    fn format(self) -> Format {
        match self {
            Self::Gsd => Format::Gsd,
            Self::Simularium => Format::Simularium,
        }
    }
}

pub(crate) fn export(arguments: &ExportArguments) -> Result<(), Failure> {
    let format = arguments.to.format();
    let run = FinishedRun::open(&arguments.run)?;
    let by_default = || default_export_path(&arguments.run, format);
    let out = arguments.out.clone().unwrap_or_else(by_default);
    let files = actin_rundir::export(&run, format, &out, arguments.overwrite)?;
    let files: Vec<String> = files
        .iter()
        .map(|file| file.display().to_string())
        .collect();
    println!("{} records written to {}", run.count(), files.join(", "));
    Ok(())
}

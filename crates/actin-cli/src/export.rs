//! `actin export`: a finished run as a file of another program.

use crate::failure::Failure;
use actin_export::{ExportError, FinishedRun, Format};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// What exit codes mean, for the help.
pub(crate) const EXIT_CODES: &str = "Exit codes:
    0  done
    2  bad input: a directory without a run or its states, or a file that exists
   74  the file could not be written; nothing is left of it";

#[derive(Debug, Args)]
pub(crate) struct ExportArguments {
    /// The run directory.
    run: PathBuf,
    /// Format of the file.
    #[arg(long, value_name = "FORMAT")]
    to: Target,
    /// The file; by default beside the run directory, with the format behind its name.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Replace the file if it exists.
    #[arg(long)]
    overwrite: bool,
}

/// Formats of files.
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

/// Writes the file and says where it is.
pub(crate) fn export(arguments: &ExportArguments) -> Result<(), Failure> {
    let format = arguments.to.format();
    let run = FinishedRun::open(&arguments.run).map_err(ExportError::from)?;
    let by_default = || format.beside(&arguments.run);
    let out = arguments.out.clone().unwrap_or_else(by_default);
    let files = actin_export::export(&run, format, &out, arguments.overwrite)?;
    let files: Vec<String> = files
        .iter()
        .map(|file| file.display().to_string())
        .collect();
    println!("{} records written to {}", run.count(), files.join(", "));
    Ok(())
}

impl From<ExportError> for Failure {
    fn from(error: ExportError) -> Self {
        match error {
            ExportError::Io { .. } | ExportError::Output(_) => Self::Unwritten(error.to_string()),
            _ => Self::Input(error.to_string()),
        }
    }
}

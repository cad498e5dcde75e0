//! Tasks of this workspace: `cargo xtask <task>`.

mod check;
mod extremes;
mod figures;
mod fit;
mod tidy;

use clap::{Parser, Subcommand};
use std::path::PathBuf;
use std::process::ExitCode;

/// Tasks of this workspace.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask")]
struct Arguments {
    #[command(subcommand)]
    task: Task,
}

#[derive(Debug, Subcommand)]
enum Task {
    /// Formatting, lints as errors, documentation, benches that build, random input, tidiness.
    Check,
    /// Takes every number of a scene to where it breaks and writes what becomes of it.
    Extremes(extremes::Options),
    /// Fits a rod's laws to tables or to filaments of monomers.
    FitParameters(fit::Options),
    /// Computes figures and tables of the paper and compares them with it.
    ReproduceFigures {
        /// Which: fig1 to fig10, table1 to table5. All by default.
        ids: Vec<String>,
        /// Where to write pictures, tables and reports.
        #[arg(long, default_value = "target/figures")]
        out: PathBuf,
        /// Fewer resolutions and shorter runs.
        #[arg(long)]
        quick: bool,
    },
}

fn main() -> ExitCode {
    let outcome = match Arguments::parse().task {
        Task::Check => check::run(),
        Task::Extremes(options) => extremes::run(&options),
        Task::FitParameters(options) => fit::run(&options),
        Task::ReproduceFigures { ids, out, quick } => figures::reproduce(&ids, &out, quick),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

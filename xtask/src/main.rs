//! Tasks of this workspace: `cargo xtask <task>`.

mod check;
mod docs;
mod figures;
mod fit;
mod tidy;

use clap::{Parser, Subcommand};
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
    /// Formatting, lints as errors, documentation, benches that build, tidiness.
    Check,
    /// Fits a rod's laws to tables or to filaments of monomers.
    FitParameters(fit::Options),
    /// Computes figures and tables of the paper and compares them with it.
    ReproduceFigures(figures::Options),
    /// Compares the numbers that the documents mark with a report.
    CheckDocs(docs::Options),
}

fn main() -> ExitCode {
    let outcome = match Arguments::parse().task {
        Task::Check => check::run(),
        Task::FitParameters(options) => fit::run(&options),
        Task::ReproduceFigures(options) => figures::reproduce(&options),
        Task::CheckDocs(options) => docs::run(&options),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

//! Tasks of this workspace: `cargo xtask <task>`.
//!
//! This crate depends on no other crate of the workspace, so that `cargo xtask check` compiles each of them only
//! once.

mod check;
mod command;
mod trials;

use clap::{Parser, Subcommand};
use std::ffi::OsString;
use std::process::ExitCode;

/// Tasks of this workspace.
#[derive(Debug, Parser)]
#[command(
    name = "cargo xtask",
    after_help = "Studies (`cargo xtask STUDY --help`): bench, docs, extremes, fit-parameters, homogenise, \
        load-cases, reproduce-figures, tradeoff"
)]
struct Arguments {
    #[command(subcommand)]
    task: Task,
}

#[derive(Debug, Subcommand)]
enum Task {
    /// Checks formatting, lints, documentation, benches and tidiness.
    Check,
    /// Builds the wheel of the Python package and checks its size and its manylinux tag.
    Wheel,
    /// Tests the program with random input and kills.
    Trials(trials::Options),
    /// Runs a study in the release profile.
    #[command(external_subcommand)]
    Study(Vec<OsString>),
}

fn main() -> ExitCode {
    let outcome = match Arguments::parse().task {
        Task::Check => check::run(),
        Task::Wheel => command::wheel(),
        Task::Trials(options) => trials::run(&options),
        Task::Study(arguments) => return command::study(&arguments),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

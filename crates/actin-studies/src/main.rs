//! Studies of the book: `cargo xtask <study>` runs this program in the release profile. A closed pipe on standard
//! output does not end it.

#[macro_use]
#[path = "../../actin-cli/src/streams.rs"]
mod streams;

mod bench;
mod docs;
mod extremes;
mod figures;
mod homogenise;
mod tidy;
mod tradeoff;

use actin_paper::{fit, load_cases};
use anyhow::{Error, Result};
use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// Studies of the book.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask")]
struct Arguments {
    #[command(subcommand)]
    task: Task,
}

#[derive(Debug, Subcommand)]
enum Task {
    /// Measures rates of fixed cases and compares them with targets.
    Bench(bench::Options),
    /// Tests every number of a scene at its limits and tabulates the outcomes.
    Extremes(extremes::Options),
    /// Fits rod laws to tables or to monomer filaments.
    FitParameters(fit::Options),
    /// Measures the energy per length of monomer filaments on a grid of strains, and fits rod laws to it.
    Homogenise(homogenise::Options),
    /// Measures differences between rods with a law and monomer filaments for a list of load cases.
    LoadCases(load_cases::Options),
    /// Recomputes figures and tables of the paper and compares them with the published values.
    ReproduceFigures(figures::Options),
    /// Compares all-monomer models with cheaper ones in the scenes of `scenarios/trade`.
    Tradeoff(tradeoff::Options),
    /// Checks or writes generated pages of the book: keys of scenes, tables of results.
    Docs(docs::Options),
}

fn main() -> ExitCode {
    match carry_out(Arguments::parse().task) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn carry_out(task: Task) -> Result<()> {
    actin_sim::mechanics::wide::chosen_arch().map_err(Error::msg)?;
    let tell = &|line: std::fmt::Arguments<'_>| println!("{line}");
    match task {
        Task::Bench(options) => bench::run(&options),
        Task::Extremes(options) => extremes::run(&options),
        Task::FitParameters(options) => fit::run(&options, tell).map_err(Error::msg),
        Task::Homogenise(options) => homogenise::run(&options),
        Task::LoadCases(options) => load_cases::run(&options, tell).map_err(Error::msg),
        Task::ReproduceFigures(options) => figures::run(options),
        Task::Tradeoff(options) => tradeoff::run(&options),
        Task::Docs(options) => docs::run(&options).map_err(Error::msg),
    }?;
    streams::ending().map_err(Error::msg)
}

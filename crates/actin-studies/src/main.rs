//! Studies behind the documents: `cargo xtask <study>` runs this program in the release profile. A closed pipe on
//! standard output does not end it.

#[macro_use]
#[path = "../../actin-cli/src/streams.rs"]
mod streams;

mod bench;
mod docs;
mod extremes;
mod figures;
mod fit;
mod homogenise;
mod load_cases;
mod tidy;
mod tradeoff;

use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// Studies behind the documents.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask")]
struct Arguments {
    #[command(subcommand)]
    task: Task,
}

#[derive(Debug, Subcommand)]
enum Task {
    /// Measures rates of fixed cases beside their targets.
    Bench(bench::Options),
    /// Takes every number of a scene to its limits and lists the outcomes.
    Extremes(extremes::Options),
    /// Fits a rod's laws to tables or to filaments of monomers.
    FitParameters(fit::Options),
    /// Measures the energy per length of monomers under all strains, on a grid, and fits laws of rods to it.
    Homogenise(homogenise::Options),
    /// Measures how far rods under a law are from filaments of monomers, load case by load case.
    LoadCases(load_cases::Options),
    /// Computes figures and tables of the paper and compares them with it.
    ReproduceFigures(figures::Options),
    /// Compares every monomer with cheaper candidates in the scenes of `scenarios/trade`.
    Tradeoff(tradeoff::Options),
    /// Checks or writes the generated pages of the book: keys of scenes, tables of results.
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

fn carry_out(task: Task) -> anyhow::Result<()> {
    actin_sim::mechanics::wide::chosen_arch().map_err(anyhow::Error::msg)?;
    match task {
        Task::Bench(options) => bench::run(&options),
        Task::Extremes(options) => extremes::run(&options),
        Task::FitParameters(options) => fit::run(options),
        Task::Homogenise(options) => homogenise::run(&options),
        Task::LoadCases(options) => load_cases::run(options),
        Task::ReproduceFigures(options) => figures::run(options),
        Task::Tradeoff(options) => tradeoff::run(&options),
        Task::Docs(options) => docs::run(&options).map_err(anyhow::Error::msg),
    }?;
    streams::ending().map_err(anyhow::Error::msg)
}

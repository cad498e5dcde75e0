//! Tasks of this workspace: `cargo xtask <task>`. A closed pipe on standard output ends none of them.

#[macro_use]
#[path = "../../crates/actin-cli/src/streams.rs"]
mod streams;

mod bench;
mod bonds;
mod check;
mod command;
mod costs;
mod docs;
mod extremes;
mod figures;
mod fit;
mod homogenise;
mod load_cases;
mod tidy;
mod tradeoff;
mod trials;

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
    /// Measures rates of fixed cases beside their targets.
    Bench(bench::Options),
    /// Measures what scenes cost beside their estimates, and how that grows with their size.
    Costs(costs::Options),
    /// Compares drawn and weighted bonds, and the shortest bond, on the paper's tables and figures.
    Bonds(bonds::Options),
    /// Formatting, lints as errors, documentation, benches that build, random input, tidiness, the book.
    Check,
    /// Takes every number of a scene to its limits and lists the outcomes.
    Extremes(extremes::Options),
    /// Fits a rod's laws to tables or to filaments of monomers.
    FitParameters(fit::Options),
    /// Measures what monomers store per length under all strains, on a grid.
    Homogenise(homogenise::Options),
    /// Measures how far rods under a law are from filaments of monomers, load case by load case.
    LoadCases(load_cases::Options),
    /// Computes figures and tables of the paper and compares them with it.
    ReproduceFigures(figures::Options),
    /// Checks or writes the generated pages of the book: keys of scenes, tables of results.
    Docs(docs::Options),
    /// Measures what each saving of time costs in accuracy, scene by scene.
    Tradeoff(tradeoff::Options),
    /// Tests the program with random input, kills, damaged files and equivalent scenes.
    Trials(trials::Options),
}

fn main() -> ExitCode {
    let outcome = match Arguments::parse().task {
        Task::Bench(options) => bench::run(options),
        Task::Bonds(options) => bonds::run(options),
        Task::Check => check::run(),
        Task::Costs(options) => costs::run(options),
        Task::Extremes(options) => extremes::run(options),
        Task::FitParameters(options) => fit::run(options),
        Task::Homogenise(options) => homogenise::run(options),
        Task::LoadCases(options) => load_cases::run(options),
        Task::ReproduceFigures(options) => figures::run(options),
        Task::Docs(options) => docs::run(&options).map_err(anyhow::Error::msg),
        Task::Tradeoff(options) => tradeoff::run(options),
        Task::Trials(options) => trials::run(&options),
    };
    match outcome.and_then(|()| streams::ending().map_err(anyhow::Error::msg)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

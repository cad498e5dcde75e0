//! The `actin` program: runs and checks scenes.
//!
//! Exit codes: 0 done, 2 bad input, 3 numerical failure.

mod check;
mod failure;
mod progress;
mod run;

use clap::{Parser, Subcommand};
use std::path::PathBuf;
use std::process::ExitCode;

/// Simulates actin filaments at two resolutions.
#[derive(Debug, Parser)]
#[command(name = "actin", version)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Runs a scene and writes a run directory.
    Run {
        /// The scene.
        scene: PathBuf,
        /// Run directory; by default `runs/` and the name of the scene.
        #[arg(long)]
        out: Option<PathBuf>,
        /// Replace the files of an earlier run in that directory.
        #[arg(long)]
        overwrite: bool,
    },
    /// Validates a scene; prints what it resolves to and what it would cost. Runs nothing.
    Check {
        /// The scene.
        scene: PathBuf,
    },
}

fn main() -> ExitCode {
    let outcome = match Arguments::parse().command {
        Command::Run {
            scene,
            out,
            overwrite,
        } => run::run(&scene, out, overwrite),
        Command::Check { scene } => check::check(&scene),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("error: {failure}");
            failure.exit_code()
        }
    }
}

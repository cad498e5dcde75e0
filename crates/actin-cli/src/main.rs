//! The `actin` program: runs and checks scenes.
//!
//! Exit codes: 0 done, 2 bad input, 3 numerical failure, 130 interrupted with a checkpoint written.

mod check;
mod failure;
mod progress;
mod run;
mod signals;

use clap::{Args, Parser, Subcommand};
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

/// What exit codes mean, for the help.
const EXIT_CODES: &str = "Exit codes:
    0  done (or --resume of a run that is)
    2  bad input: scene, arguments, directory or checkpoint; nothing has been computed or written over
    3  numerical failure: the message names step, time, body and term; or the run ended on a saddle, a
       filament lost twist, or a load is lost in the forces left over in an equilibrium; what was good
       is on disk
  130  interrupted (SIGINT, SIGTERM): --resume goes on; a second signal ends the program at once";

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
    #[command(after_help = EXIT_CODES)]
    Run(RunArguments),
    /// Validates a scene; prints what it resolves to and what it would cost. Runs nothing.
    Check {
        /// The scene.
        scene: PathBuf,
    },
}

#[derive(Debug, Args)]
struct RunArguments {
    /// The scene.
    scene: PathBuf,
    /// Run directory; by default `runs/` and the name of the scene.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Replace the files of an earlier run in that directory.
    #[arg(long)]
    overwrite: bool,
    /// Go on from the checkpoint in that directory: the results are those of a run that was not
    /// interrupted, bit for bit.
    #[arg(long, conflicts_with = "overwrite")]
    resume: bool,
    /// Time between checkpoints.
    #[arg(long, value_name = "SECONDS", default_value = "60", value_parser = seconds)]
    checkpoint_every: Duration,
}

fn seconds(text: &str) -> Result<Duration, String> {
    let seconds: f64 = text.parse().map_err(|_| "not a number".to_owned())?;
    Duration::try_from_secs_f64(seconds).map_err(|error| error.to_string())
}

fn main() -> ExitCode {
    let outcome = match Arguments::parse().command {
        Command::Run(arguments) => run::run(&arguments),
        Command::Check { scene } => check::check(&scene),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("{failure}");
            failure.exit_code()
        }
    }
}

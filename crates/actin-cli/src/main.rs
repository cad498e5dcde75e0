//! The `actin` program: runs and checks scenes, sweeps over them, and shows runs.
//!
//! Exit codes: 0 done, 2 bad input, 3 numerical failure, 74 output that could not be written, 130
//! interrupted with a checkpoint written. A closed pipe on standard output changes nothing.

#[macro_use]
mod streams;

mod check;
mod excerpt;
mod export;
mod failure;
mod follow;
mod manual;
mod progress;
mod run;
mod signals;
mod sweep;
mod told;
mod trade;
mod view;

use actin_sim::Override;
use clap::{Args, Parser, Subcommand};
use failure::Failure;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

/// What exit codes mean, for the help.
const EXIT_CODES: &str = "Exit codes:
    0  done (or --resume of a run that is done)
    2  bad input: scene, arguments, directory or checkpoint; nothing was computed
    3  numerical failure: the message names step, time, body and term; or the run ended on a saddle, a
       filament lost twist, a load is below 100 times the residual, or neighbours moved against each
       other by their own size. What was computed before is on disk
   74  the run has ended, but its results could not be written (disk full, limit on file sizes): the
       message says whether a checkpoint holds them; if so, --resume writes them
  130  interrupted (SIGINT, SIGTERM, SIGHUP): --resume continues; a second SIGINT or SIGTERM ends the
       program at once";

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
    /// Runs a scene for many values of its keys and many seeds, on all cores, into one table.
    #[command(after_help = sweep::EXIT_CODES)]
    Sweep(sweep::SweepArguments),
    /// Writes a finished run as a file of another program.
    #[command(after_help = export::EXIT_CODES)]
    Export(export::ExportArguments),
    /// Prints completions of commands and options for a shell.
    #[command(hide = true)]
    Completions {
        /// The shell.
        shell: clap_complete::Shell,
    },
    /// Writes manual pages, one for each command, into a folder.
    #[command(hide = true)]
    Man {
        /// The folder.
        folder: PathBuf,
    },
    /// Validates a scene; prints every default, what it resolves to, its time step and cost. Runs nothing.
    Check {
        #[command(flatten)]
        source: SceneArguments,
    },
    /// Runs a scene with every monomer and in cheaper ways beside it: what each costs, and how far it is off.
    Trade(trade::TradeArguments),
    /// Writes a page that shows a run in three dimensions, plays through its records and draws its curves.
    View(view::ViewArguments),
}

#[derive(Debug, Args)]
struct SceneArguments {
    /// The scene; `-` reads it from standard input.
    scene: PathBuf,
    /// Sets a key of the scene, whether it is written there or not: a path of keys, with indices of lists
    /// and vectors in brackets, and a value in RON, as in `loads[0].force_pn[2]=-4.0`.
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<Override>,
    /// Sets the seed of everything that the scene draws: bonds, thermal noise, imperfections.
    #[arg(long)]
    seed: Option<u64>,
}

impl SceneArguments {
    fn is_standard_input(&self) -> bool {
        self.scene.as_os_str() == "-"
    }

    /// Whether the file alone is the scene.
    fn is_as_written(&self) -> bool {
        !self.is_standard_input() && self.set.is_empty() && self.seed.is_none()
    }
}

#[derive(Debug, Args)]
struct RunArguments {
    #[command(flatten)]
    source: SceneArguments,
    /// Run directory; by default `runs/` and the name of the scene, `stdin` for standard input.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Replace an earlier run in that directory: only the files that its actin-run.json lists.
    #[arg(long)]
    overwrite: bool,
    /// Continue from the checkpoint in that directory: the results are those of an uninterrupted run,
    /// bit for bit. Without a checkpoint the run begins.
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
    let command = Arguments::parse().command;
    match carry_out(command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("{failure}");
            failure.exit_code()
        }
    }
}

fn carry_out(command: Command) -> Result<(), Failure> {
    actin_sim::mechanics::wide::chosen_arch().map_err(Failure::Input)?;
    signals::outlive_file_size_limit()
        .map_err(|error| Failure::Input(format!("cannot install signal handlers: {error}")))?;
    match command {
        Command::Run(arguments) => run::run(&arguments)?,
        Command::Sweep(arguments) => sweep::sweep(&arguments)?,
        Command::Export(arguments) => export::export(&arguments)?,
        Command::Completions { shell } => manual::completions(shell),
        Command::Man { folder } => manual::pages(&folder)?,
        Command::Check { source } => check::check(&source)?,
        Command::Trade(arguments) => trade::trade(&arguments)?,
        Command::View(arguments) => view::view(&arguments)?,
    }
    streams::ending().map_err(Failure::Unwritten)
}

//! The `actin` program: checks, runs, sweeps, compares, exports and shows scenes of actin filaments.
//!
//! Exit codes: 0 done, 2 bad input, 3 numerical failure, 74 output could not be written, 130 interrupted with a
//! checkpoint. A closed pipe on standard output does not change the exit code.

#[macro_use]
mod streams;

mod check;
mod excerpt;
mod export;
mod failure;
mod manual;
mod progress;
mod report;
mod run;
mod signals;
mod sweep;
mod trade;
mod view;

use actin_sim::Override;
use clap::{Args, Parser, Subcommand};
use failure::Failure;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

const EXIT_CODES: &str = "Exit codes:
    0  done, also for --resume of a finished run
    2  bad input: scene, arguments, directory or checkpoint; nothing was computed
    3  numerical failure; the message states step, time, body and force term. Other causes: the final
       state is a saddle, a filament lost its twist, a load is below 100 times the residual, or
       neighbouring monomers moved relative to each other by more than their size. Earlier results
       are on disk
   74  the run has ended, but its results could not be written (disk full, file size limit); if the
       message mentions a checkpoint, --resume writes them
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
    /// Runs a scene for many values of its keys and many seeds, on all cores, and writes one table.
    #[command(after_help = sweep::EXIT_CODES)]
    Sweep(sweep::SweepArguments),
    /// Converts a finished run to a file format of another program.
    #[command(after_help = export::EXIT_CODES)]
    Export(export::ExportArguments),
    /// Prints shell completions.
    #[command(hide = true)]
    Completions {
        /// Shell to complete for.
        shell: clap_complete::Shell,
    },
    /// Writes the manual pages, one for each command.
    #[command(hide = true)]
    Man {
        /// Output folder.
        folder: PathBuf,
    },
    /// Validates a scene without running it; prints all defaults, the resolved sections, the time step and the cost.
    Check {
        #[command(flatten)]
        source: SceneArguments,
    },
    /// Compares error and run time of cheaper models of a scene with the all-monomer model.
    Trade(trade::TradeArguments),
    /// Writes an HTML page with a 3D view, the records and the curves of a run, or the pictures of a film.
    View(view::ViewArguments),
}

#[derive(Debug, Args)]
struct SceneArguments {
    /// Scene file; `-` reads standard input.
    scene: PathBuf,
    /// Replaces or adds a key of the scene. KEY is a path with indices of lists and vectors in
    /// brackets, `[*]` for all elements of a list; VALUE is RON. Example:
    /// `loads[0].force_pn[2]=-4.0`.
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<Override>,
    /// Sets all seeds of the scene: sampled bonds, thermal noise, imperfections, linker events.
    #[arg(long)]
    seed: Option<u64>,
}

impl SceneArguments {
    fn is_standard_input(&self) -> bool {
        self.scene.as_os_str() == "-"
    }

    fn is_as_written(&self) -> bool {
        !self.is_standard_input() && self.set.is_empty() && self.seed.is_none()
    }
}

#[derive(Debug, Args)]
struct RunArguments {
    #[command(flatten)]
    source: SceneArguments,
    /// Run directory; by default `runs/` and the name of the scene (`runs/stdin` for standard input).
    #[arg(long)]
    out: Option<PathBuf>,
    /// Replaces an earlier run in that directory. Only files listed in its actin-run.json are removed.
    #[arg(long)]
    overwrite: bool,
    /// Continues from the checkpoint in that directory. The results are bitwise identical to an uninterrupted
    /// run. Without a checkpoint the run starts from the beginning. A completed motion is extended if the scene
    /// differs in a longer duration only.
    #[arg(long, conflicts_with = "overwrite")]
    resume: bool,
    /// Wall-clock time between checkpoints.
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

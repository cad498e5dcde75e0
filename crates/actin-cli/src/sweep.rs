//! `actin sweep`: many runs of a scene, and one table.

use crate::failure::{self, Failure};
use crate::{seconds, signals};
use actin_sim::{RunDirectoryError, SceneText};
use actin_sweep::{Design, Ended, Opened, Priced, Progress, Settings, SweepDirectory, SweepError};
use clap::{Args, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// What exit codes mean, for the help.
pub(crate) const EXIT_CODES: &str = "Exit codes:
    0  done; runs that failed are rows of runs.csv, with the reason
    2  bad input: sweep, scene, arguments or directory
    3  every run failed; runs.csv has the reasons
   74  results could not be written; once the cause is removed, --resume goes on
  130  interrupted: runs that have ended stay, the others have checkpoints; --resume continues";

/// Points that `--check` shows of one key, and refusals that it shows.
const SHOWN: usize = 8;

/// Points that `--check` builds at most.
const BUILT: usize = 1000;

#[derive(Debug, Args)]
pub(crate) struct SweepArguments {
    /// The sweep.
    sweep: PathBuf,
    /// Sweep directory; by default `sweeps/` and the name of the sweep.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Continue: runs that have ended stay, the others go on from their checkpoints. The tables are those of
    /// a sweep that was not interrupted, byte for byte. Where there is nothing to continue the sweep begins.
    #[arg(long)]
    resume: bool,
    /// Say how many runs there are and what they cost; run nothing.
    #[arg(long, conflicts_with_all = ["resume", "only", "emit"])]
    check: bool,
    /// Runs made at the same time, each on one core; as many as there are cores by default.
    #[arg(long, value_name = "N")]
    jobs: Option<NonZeroUsize>,
    /// Make or continue these runs alone, as in 3,10-19, and no table. Several processes may do so in one
    /// directory.
    #[arg(long, value_name = "RUNS", value_parser = numbers, conflicts_with = "emit")]
    only: Option<Numbers>,
    /// Write a workflow that makes the runs into the directory, and run nothing.
    #[arg(long, value_name = "ENGINE")]
    emit: Option<Engine>,
    /// Time between checkpoints of a run.
    #[arg(long, value_name = "SECONDS", default_value = "60", value_parser = seconds)]
    checkpoint_every: Duration,
}

/// What runs a workflow.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Engine {
    /// Snakemake 9: one machine, or Slurm, Kubernetes and others through its executors.
    Snakemake,
}

/// Numbers of runs.
#[derive(Clone, Debug)]
struct Numbers(Vec<usize>);

/// Numbers and ranges of numbers with commas between them.
fn numbers(text: &str) -> Result<Numbers, String> {
    let mut all = Vec::new();
    for part in text.split(',') {
        let (from, to) = part.split_once('-').unwrap_or((part, part));
        let number = |text: &str| text.trim().parse::<usize>();
        let (Ok(from), Ok(to)) = (number(from), number(to)) else {
            return Err(format!(
                "{part:?} is neither a number nor a range such as 10-19"
            ));
        };
        if from > to {
            return Err(format!("{part:?} runs backwards: write {to}-{from}"));
        }
        all.extend(from..=to);
    }
    all.sort_unstable();
    all.dedup();
    Ok(Numbers(all))
}

/// Makes the runs of a sweep, or does with it what else the arguments say.
pub(crate) fn sweep(arguments: &SweepArguments) -> Result<(), Failure> {
    let opened = Opened::open(&arguments.sweep)?;
    if arguments.check {
        check(&opened);
        return Ok(());
    }
    let stem = arguments.sweep.file_stem().unwrap_or_default();
    let by_default = || Path::new("sweeps").join(stem);
    let out = arguments.out.clone().unwrap_or_else(by_default);
    let resume = arguments.resume || arguments.only.is_some() || arguments.emit.is_some();
    let directory = SweepDirectory::create(&out, &opened, resume)?;
    if let Some(Engine::Snakemake) = arguments.emit {
        directory.write_snakemake(&opened, &opened.price(usize::MAX))?;
        println!(
            "a workflow of {} runs is in {out}; to run it: cd {out} && snakemake --cores all",
            opened.design.len(),
            out = out.display()
        );
        return Ok(());
    }
    let ended = make(arguments, &opened, &directory)?;
    finish(arguments, &out, ended)
}

/// Makes the runs, with a progress bar on a terminal.
fn make(
    arguments: &SweepArguments,
    opened: &Opened,
    directory: &SweepDirectory,
) -> Result<Ended, Failure> {
    let interrupted = signals::interruption()
        .map_err(|error| Failure::Input(format!("cannot install signal handlers: {error}")))?;
    let settings = Settings {
        jobs: arguments.jobs,
        checkpoint_every: arguments.checkpoint_every,
        interrupted,
        warn: |error| eprintln!("warning: {error}; the run goes on without it"),
    };
    let bar = ProgressBar::new(0);
    let style = ProgressStyle::with_template("{bar:32} {pos} of {len} runs  remaining {eta}")
        .expect("the template names known fields only");
    bar.set_style(style);
    let progress = |progress: Progress| {
        bar.set_length(progress.of as u64);
        bar.set_position(progress.ended as u64);
        if progress.ended == progress.before {
            bar.reset_eta();
        }
    };
    let ended = match &arguments.only {
        None => directory.carry_out(opened, &settings, &progress),
        Some(Numbers(runs)) => directory.make_runs(opened, runs, &settings, &progress),
    };
    bar.finish_and_clear();
    Ok(ended?)
}

/// Says how it ended.
fn finish(arguments: &SweepArguments, out: &Path, ended: Ended) -> Result<(), Failure> {
    let (out, sweep) = (out.display(), arguments.sweep.display());
    if ended.is_interrupted() {
        let (done, of) = (ended.ended, ended.of);
        let table = match arguments.only {
            None => " and are in runs.csv and table.csv",
            Some(_) => "",
        };
        return Err(Failure::Interrupted(format!(
            "{done} of {of} runs have ended{table}, the others that had begun have checkpoints; to continue: \
             actin sweep {sweep} --out {out} --resume"
        )));
    }
    let (runs, failed) = (ended.of, ended.failed);
    if failed == runs && arguments.only.is_none() {
        return Err(Failure::Numerical(format!(
            "all {runs} run(s) failed: {out}/runs.csv says why"
        )));
    }
    let failures = match failed {
        0 => "none failed".to_owned(),
        failed => format!("{failed} failed, runs.csv says why"),
    };
    let table = match arguments.only {
        None => format!("{out}/table.csv"),
        Some(_) => format!("{out}/runs"),
    };
    println!("{runs} run(s), {failures}; written to {table}");
    Ok(())
}

/// Prints the first values of each key.
fn print_values(design: &Design) {
    for (k, key) in design.keys.iter().enumerate() {
        let mut values: Vec<&str> = Vec::new();
        for point in &design.points {
            if !values.contains(&point[k].as_str()) && values.len() <= SHOWN {
                values.push(&point[k]);
            }
        }
        let more = if values.len() > SHOWN { ", ..." } else { "" };
        let shown = values[..values.len().min(SHOWN)].join(", ");
        println!("  {key}: {shown}{more}");
    }
}

/// How many runs there are and what they cost.
fn check(opened: &Opened) {
    let design = &opened.design;
    println!(
        "{} runs: {} point(s), {} run(s) of each",
        design.len(),
        design.points.len(),
        design.runs_of_point()
    );
    print_values(design);
    if let (Some(first), Some(last)) = (design.seeds.first(), design.seeds.last()) {
        println!("  seeds {first} to {last}");
    }
    let priced = opened.price(BUILT);
    let refused = priced.refused.len();
    print_cost(design, &priced);
    let of_points = if priced.points < design.points.len() {
        format!(" of these {}", priced.points)
    } else {
        String::new()
    };
    if refused > 0 {
        println!("{refused} point(s){of_points} will fail:");
    }
    for (point, why) in priced.refused.iter().take(SHOWN) {
        println!("  point {point}: {why}");
    }
}

/// Prints memory, and the time of one point times the number of runs.
fn print_cost(design: &Design, priced: &Priced) {
    println!("at most {:.0} MB for each run", (priced.bytes / 1e6).ceil());
    let (Some(point), Some(timing)) = (priced.timed, priced.timing) else {
        return;
    };
    let built = priced.points - priced.refused.len();
    println!("a run of point {point}, the largest of {built} built: {timing}");
    if let Some(run_s) = priced.run_s() {
        let runs = design.len();
        println!(
            "all {runs} runs, each as long as this one: {:.2} s on one core",
            run_s * runs as f64
        );
    }
}

impl From<SweepError> for Failure {
    fn from(error: SweepError) -> Self {
        let message = error.to_string();
        match error {
            SweepError::Refused {
                file,
                text,
                mistakes,
            } if !text.is_empty() => {
                let name = file.display().to_string();
                failure::listed(&name, &SceneText::new(&text), &mistakes)
            }
            SweepError::Io { source, .. } if source.kind() == std::io::ErrorKind::NotFound => {
                Self::Input(message)
            }
            SweepError::Io { .. }
            | SweepError::Run(RunDirectoryError::Io { .. } | RunDirectoryError::Unreadable(_)) => {
                Self::Unwritten(message)
            }
            _ => Self::Input(message),
        }
    }
}

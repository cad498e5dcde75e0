//! `actin sweep`: runs a scene many times and tabulates the results.

use crate::failure::{self, Failure};
use crate::{seconds, signals};
use actin_rundir::RunDirectoryError;
use actin_sim::{RecordsError, SceneText};
use actin_sweep::{
    Design, Progress, Settings, SweepCost, SweepDirectory, SweepError, SweepOutcome, ValidatedSweep,
};
use clap::{Args, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::time::Duration;

pub(crate) const EXIT_CODES: &str = "Exit codes:
    0  done; runs.csv lists failed runs with the reason
    2  bad input: sweep, scene, arguments or directory
    3  every run failed; the reasons are in runs.csv
   74  results could not be written; once the cause is removed, --resume continues
  130  interrupted: finished runs are kept, other started runs have checkpoints; --resume continues";

const SHOWN: usize = 8;

const BUILT: usize = 1000;

#[derive(Debug, Args)]
pub(crate) struct SweepArguments {
    /// Sweep file.
    sweep: PathBuf,
    /// Sweep directory; by default `sweeps/` and the name of the sweep.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Continues an earlier sweep: finished runs are kept, others continue from their checkpoints. The tables are
    /// identical to those of an uninterrupted sweep. Without an earlier sweep, a new one begins.
    #[arg(long)]
    resume: bool,
    /// Prints the number of runs and their cost without running them.
    #[arg(long, conflicts_with_all = ["resume", "only", "emit"])]
    check: bool,
    /// Number of simultaneous runs, each on one core; by default the number of cores.
    #[arg(long, value_name = "N")]
    jobs: Option<NonZeroUsize>,
    /// Runs or continues only these runs, for example 3,10-19, and writes no table. Several processes can use
    /// this option in one directory.
    #[arg(long, value_name = "RUNS", value_parser = numbers, conflicts_with = "emit")]
    only: Option<Numbers>,
    /// Writes a workflow for this engine into the directory without running it.
    #[arg(long, value_name = "ENGINE")]
    emit: Option<Engine>,
    /// Wall-clock time between checkpoints of a run.
    #[arg(long, value_name = "SECONDS", default_value = "60", value_parser = seconds)]
    checkpoint_every: Duration,
}

/// Workflow engines.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Engine {
    /// Snakemake 9, on one machine or through its executors for Slurm, Kubernetes and others.
    Snakemake,
}

#[derive(Clone, Debug)]
struct Numbers(Vec<usize>);

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
            return Err(format!("{part:?} is a reversed range: write {to}-{from}"));
        }
        all.extend(from..=to);
    }
    all.sort_unstable();
    all.dedup();
    Ok(Numbers(all))
}

pub(crate) fn sweep(arguments: &SweepArguments) -> Result<(), Failure> {
    let opened = ValidatedSweep::open(&arguments.sweep)?;
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
        directory.write_snakemake(&opened, &opened.estimate_cost(usize::MAX))?;
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

fn make(
    arguments: &SweepArguments,
    opened: &ValidatedSweep,
    directory: &SweepDirectory,
) -> Result<SweepOutcome, Failure> {
    let interrupted = signals::interruption()?;
    let settings = Settings {
        jobs: arguments.jobs,
        checkpoint_every: arguments.checkpoint_every,
        interrupted,
        warn: |error| eprintln!("warning: {error}; the run continues without it"),
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
        None => directory.run_all(opened, &settings, &progress),
        Some(Numbers(runs)) => directory.make_runs(opened, runs, &settings, &progress),
    };
    bar.finish_and_clear();
    Ok(ended?)
}

fn finish(arguments: &SweepArguments, out: &Path, ended: SweepOutcome) -> Result<(), Failure> {
    let (out, sweep) = (out.display(), arguments.sweep.display());
    if ended.is_interrupted() {
        let (done, of) = (ended.ended, ended.of);
        let table = match arguments.only {
            None => " and are in runs.csv and table.csv",
            Some(_) => "",
        };
        return Err(Failure::Interrupted(format!(
            "{done} of {of} runs have ended{table}; other started runs have checkpoints; to continue: \
             actin sweep {sweep} --out {out} --resume"
        )));
    }
    let (runs, failed) = (ended.of, ended.failed);
    if failed == runs && arguments.only.is_none() {
        return Err(Failure::Numerical(format!(
            "all {runs} run(s) failed: the reasons are in {out}/runs.csv"
        )));
    }
    let failures = match failed {
        0 => "none failed".to_owned(),
        failed => format!("{failed} failed (reasons in runs.csv)"),
    };
    let table = match arguments.only {
        None => format!("{out}/table.csv"),
        Some(_) => format!("{out}/runs"),
    };
    println!("{runs} run(s), {failures}; written to {table}");
    Ok(())
}

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

fn check(opened: &ValidatedSweep) {
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
    let priced = opened.estimate_cost(BUILT);
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

/// Prints the memory of a run and the run time of the whole sweep, estimated from one point.
fn print_cost(design: &Design, priced: &SweepCost) {
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
            | SweepError::Run(
                RunDirectoryError::Io { .. }
                | RunDirectoryError::Records(RecordsError::Unreadable(_)),
            ) => Self::Unwritten(message),
            _ => Self::Input(message),
        }
    }
}

//! `cargo xtask trials`: the program itself under random input, kills, damaged files, and changes of a
//! scene that must not change its answer.
//!
//! Every case is a process of `actin` that is judged from outside: by its exit code, its message and
//! its files. A case depends on its number and the seed only, so one that fails fails again; its
//! folder is kept. Call [`run`]. Unit tests of readers and builders live with their crates.

mod kills;
mod metamorphic;
mod program;
mod scenes;
mod spoil;
mod spoilt;

use crate::check::workspace_root;
use clap::ValueEnum;
use indicatif::{ProgressBar, ProgressStyle};
use program::Program;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// What is tried, and how often.
#[derive(clap::Args, Debug)]
pub(crate) struct Options {
    /// Which trials; all by default.
    kinds: Vec<Kind>,
    /// Cases of each trial; by default some minutes' worth on two cores.
    #[arg(long)]
    cases: Option<u64>,
    /// Seed of all cases.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// The program to try; by default it is built (release).
    #[arg(long)]
    program: Option<PathBuf>,
    /// Where cases run; the folders of those that fail stay.
    #[arg(long, default_value = "target/trials")]
    out: PathBuf,
}

/// A kind of trial.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Kind {
    /// Scenes of the repository, spoilt in a few places, under `actin check`.
    Check,
    /// The same under `actin run`, interrupted when they take long.
    Run,
    /// Runs that are killed at random moments until they are done: the same bytes.
    Kill,
    /// Interrupted runs whose checkpoint or records are damaged: refused, or the same bytes.
    Damage,
    /// Scenes changed in ways that must not change the answer.
    Metamorphic,
}

impl Kind {
    /// Cases unless told otherwise.
    const fn default_cases(self) -> u64 {
        match self {
            Self::Check => 4000,
            Self::Run => 400,
            Self::Kill => 20,
            Self::Damage => 60,
            Self::Metamorphic => 200,
        }
    }

    /// Tries one case.
    fn attempt(self, case: &mut Case<'_>) -> Result<Tally, String> {
        match self {
            Self::Check => spoilt::check(case),
            Self::Run => spoilt::run(case),
            Self::Kill => kills::kill(case),
            Self::Damage => kills::damage(case),
            Self::Metamorphic => metamorphic::compare(case),
        }
    }
}

/// How often each thing happened.
type Tally = BTreeMap<&'static str, u64>;

/// The tally of one thing that happened once.
fn once(what: &'static str) -> Tally {
    Tally::from([(what, 1)])
}

/// What a case is given.
struct Case<'a> {
    /// The program that is tried.
    program: &'a Program,
    /// Texts of the scenes of the repository.
    corpus: &'a [String],
    /// An empty folder of its own.
    folder: &'a Path,
    /// Its random numbers.
    random: ChaCha8Rng,
}

/// Runs the trials, prints what happened how often, and fails if any case did.
pub(crate) fn run(options: &Options) -> Result<(), String> {
    let program = match &options.program {
        Some(path) => Program::at(path)?,
        None => Program::build()?,
    };
    let corpus = scenes::repository(&workspace_root().join("scenarios"))?;
    let kinds = match &options.kinds[..] {
        [] => Kind::value_variants(),
        chosen => chosen,
    };
    let mut failures = 0;
    for &kind in kinds {
        failures += try_all(kind, options, &program, &corpus);
    }
    match failures {
        0 => Ok(()),
        _ => Err(format!("{failures} cases failed")),
    }
}

/// All cases of a kind; the number of those that failed.
fn try_all(kind: Kind, options: &Options, program: &Program, corpus: &[String]) -> usize {
    let name = format!("{kind:?}").to_lowercase();
    let cases = options.cases.unwrap_or(kind.default_cases());
    let style = ProgressStyle::with_template("{prefix:12} {bar:32} {pos}/{len} cases, {elapsed}")
        .expect("the template is well formed");
    let bar = ProgressBar::new(cases)
        .with_style(style)
        .with_prefix(name.clone());
    let clock = Instant::now();
    let outcomes: Vec<Result<Tally, String>> = (0..cases)
        .into_par_iter()
        .map(|number| {
            let folder = options.out.join(&name).join(number.to_string());
            let outcome = try_one(kind, number, options.seed, program, corpus, &folder);
            bar.inc(1);
            outcome
        })
        .collect();
    bar.finish_and_clear();
    let mut tally = Tally::new();
    let mut failures = 0;
    for outcome in outcomes {
        match outcome {
            Ok(one) => one
                .into_iter()
                .for_each(|(what, n)| *tally.entry(what).or_default() += n),
            Err(why) => {
                eprintln!("{why}");
                failures += 1;
            }
        }
    }
    let counted = tally.iter().map(|(what, n)| format!("{n} {what}"));
    let counts: Vec<String> = counted.collect();
    println!(
        "{name}: {cases} cases in {:.0} s: {}; {failures} failed",
        clock.elapsed().as_secs_f64(),
        counts.join(", ")
    );
    failures
}

/// One case in a folder of its own, which goes if all is well.
fn try_one(
    kind: Kind,
    number: u64,
    seed: u64,
    program: &Program,
    corpus: &[String],
    folder: &Path,
) -> Result<Tally, String> {
    let told = |error: std::io::Error| format!("{}: {error}", folder.display());
    if folder.exists() {
        fs::remove_dir_all(folder).map_err(told)?;
    }
    fs::create_dir_all(folder).map_err(told)?;
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(number);
    let mut case = Case {
        program,
        corpus,
        folder,
        random,
    };
    let outcome = kind.attempt(&mut case);
    match outcome {
        Ok(tally) => fs::remove_dir_all(folder).map_err(told).map(|()| tally),
        Err(why) => Err(format!("{}: {why}", folder.display())),
    }
}

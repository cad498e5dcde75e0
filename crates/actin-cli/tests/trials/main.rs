//! Randomised trials: corrupted scenes and kills.
//!
//! Each case runs `actin` as a process and checks its exit code, message and files. A case is reproducible from its
//! number and the seed; the folder of a failed case is kept. The other tests include a few cases of each kind, and
//! `cargo xtask trials` runs thousands.

#[path = "../integration/common/mod.rs"]
mod common;
mod kills;
mod program;
mod scenes;
mod spoil;
mod spoilt;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

type Tally = BTreeMap<&'static str, u64>;

type Outcome = Result<Tally, String>;

fn once(what: &'static str) -> Tally {
    Tally::from([(what, 1)])
}

struct Case<'a> {
    corpus: &'a [String],
    folder: &'a Path,
    random: ChaCha8Rng,
}

#[test]
fn spoilt_scenes_are_checked() {
    try_all("check", (100, 4000), spoilt::check);
}

#[test]
fn spoilt_scenes_are_run() {
    try_all("run", (10, 400), spoilt::run);
}

#[test]
fn killed_runs_are_resumed() {
    let tally = try_all("kill", (2, 20), kills::kill);
    assert!(
        tally["kills"] > 0,
        "every run was done before it was killed"
    );
}

fn number(variable: &str) -> Option<u64> {
    let text = std::env::var(variable).ok()?;
    Some(
        text.parse()
            .unwrap_or_else(|_| panic!("{variable}={text} is no number")),
    )
}

/// Runs `few` cases of a kind, `many` if `ACTIN_TRIALS` is `all`, or as many as `ACTIN_TRIALS` specifies.
fn try_all(kind: &str, (few, many): (u64, u64), attempt: fn(&mut Case<'_>) -> Outcome) -> Tally {
    let cases = match std::env::var("ACTIN_TRIALS") {
        Err(_) => few,
        Ok(all) if all == "all" => many,
        Ok(_) => number("ACTIN_TRIALS").expect("it is there"),
    };
    let seed = number("ACTIN_TRIALS_SEED").unwrap_or(1);
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let corpus = scenes::repository(&root.join("scenarios"));
    let clock = Instant::now();
    let outcomes: Vec<Outcome> = (0..cases)
        .into_par_iter()
        .map(|number| try_one(kind, number, seed, &corpus, attempt))
        .collect();
    let mut tally = Tally::new();
    let mut failures = Vec::new();
    for outcome in outcomes {
        match outcome {
            Ok(one) => one
                .into_iter()
                .for_each(|(what, n)| *tally.entry(what).or_default() += n),
            Err(why) => failures.push(why),
        }
    }
    println!(
        "{kind}: {cases} cases in {:.0} s: {tally:?}; {} failed",
        clock.elapsed().as_secs_f64(),
        failures.len()
    );
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    tally
}

fn try_one(
    kind: &str,
    number: u64,
    seed: u64,
    corpus: &[String],
    attempt: fn(&mut Case<'_>) -> Outcome,
) -> Outcome {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR"))
        .join(format!("trials/{kind}"))
        .join(number.to_string());
    if folder.exists() {
        fs::remove_dir_all(&folder).unwrap();
    }
    fs::create_dir_all(&folder).unwrap();
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(number);
    let outcome = attempt(&mut Case {
        corpus,
        folder: &folder,
        random,
    });
    match outcome {
        Ok(tally) => {
            fs::remove_dir_all(&folder).unwrap();
            Ok(tally)
        }
        Err(why) => Err(format!("{}: {why}", folder.display())),
    }
}

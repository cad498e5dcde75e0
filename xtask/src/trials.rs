//! `cargo xtask trials`: thousands of cases of the trials in `crates/actin-cli/tests/trials`, which try
//! the program with random input, kills, damaged files and scenes changed without effect.

use crate::command::cargo;

/// What is tried, and how often.
#[derive(clap::Args, Debug)]
pub(crate) struct Options {
    /// Which trials, by a part of the name of their test (`check`, `run`, `kill`, `damage`, `agree`);
    /// all by default.
    names: Vec<String>,
    /// Cases of each trial; by default some minutes' worth on two cores.
    #[arg(long)]
    cases: Option<u64>,
    /// Seed of all cases.
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

/// Runs the trials; fails if any case did.
pub(crate) fn run(options: &Options) -> anyhow::Result<()> {
    let cases = options
        .cases
        .map_or_else(|| "all".to_owned(), |cases| cases.to_string());
    let mut test = cargo(&["test", "--workspace", "--test", "trials", "--"]);
    test.args(["--nocapture", "--test-threads", "1"])
        .args(&options.names)
        .env("ACTIN_TRIALS", cases)
        .env("ACTIN_TRIALS_SEED", options.seed.to_string());
    crate::command::execute(&mut test)
}

//! `cargo xtask trials`: thousands of cases of the trials in `crates/actin-cli/tests/trials`, which try
//! the program with random input, kills and scenes changed without effect.

use crate::command::cargo;

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
}

/// A kind of trial.
#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum Kind {
    /// Spoilt scenes under `actin check`.
    Check,
    /// The same under `actin run`.
    Run,
    /// Runs that are killed until they are done.
    Kill,
    /// Scenes changed in ways that must not change the answer.
    Metamorphic,
}

impl Kind {
    /// The test that tries it.
    fn test(self) -> &'static str {
        match self {
            Self::Check => "spoilt_scenes_are_checked",
            Self::Run => "spoilt_scenes_are_run",
            Self::Kill => "killed_runs_are_resumed",
            Self::Metamorphic => "scenes_changed_without_effect_agree",
        }
    }
}

/// Runs the trials; fails if any case did.
pub(crate) fn run(options: &Options) -> anyhow::Result<()> {
    let cases = options.cases.map(|cases| cases.to_string());
    let mut test = cargo(&["test", "--workspace", "--test", "trials", "--"]);
    test.args(["--nocapture", "--test-threads", "1", "--exact"])
        .args(options.kinds.iter().map(|kind| kind.test()))
        .env("ACTIN_TRIALS", cases.as_deref().unwrap_or("all"))
        .env("ACTIN_TRIALS_SEED", options.seed.to_string());
    crate::command::execute(&mut test)
}

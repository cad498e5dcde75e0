//! `cargo xtask trials`: thousands of cases of the randomised tests in `crates/actin-cli/tests/trials`.

use crate::command::cargo;

/// Options of `cargo xtask trials`.
#[derive(clap::Args, Debug)]
pub(crate) struct Options {
    /// Kinds of trials; all by default.
    kinds: Vec<Kind>,
    /// Number of cases of each kind; by default a few minutes of work on two cores.
    #[arg(long)]
    cases: Option<u64>,
    /// Seed of all cases.
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum Kind {
    /// Corrupted scenes under `actin check`.
    Check,
    /// Corrupted scenes under `actin run`.
    Run,
    /// Runs that are killed and resumed until they are done.
    Kill,
}

impl Kind {
    fn test(self) -> &'static str {
        match self {
            Self::Check => "spoilt_scenes_are_checked",
            Self::Run => "spoilt_scenes_are_run",
            Self::Kill => "killed_runs_are_resumed",
        }
    }
}

pub(crate) fn run(options: &Options) -> anyhow::Result<()> {
    let cases = options.cases.map(|cases| cases.to_string());
    let mut test = cargo(&["test", "--workspace", "--test", "trials", "--"]);
    test.args(["--nocapture", "--test-threads", "1", "--exact"])
        .args(options.kinds.iter().map(|kind| kind.test()))
        .env("ACTIN_TRIALS", cases.as_deref().unwrap_or("all"))
        .env("ACTIN_TRIALS_SEED", options.seed.to_string());
    crate::command::execute(&mut test)
}

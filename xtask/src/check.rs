//! `cargo xtask check`: all checks before a commit except the tests.

use crate::command::{cargo, execute};
use anyhow::{Context, Result};

/// A step, which is a cargo command.
struct Step {
    purpose: &'static str,
    arguments: &'static [&'static str],
    /// An environment variable and its value.
    variable: Option<(&'static str, &'static str)>,
}

const STEPS: [Step; 5] = [
    Step {
        purpose: "formatting",
        arguments: &["fmt", "--all", "--check"],
        variable: None,
    },
    Step {
        purpose: "lints",
        arguments: &[
            "clippy",
            "--workspace",
            "--all-targets",
            "--",
            "--deny",
            "warnings",
        ],
        variable: None,
    },
    Step {
        purpose: "documentation",
        arguments: &["doc", "--workspace", "--no-deps"],
        variable: Some(("RUSTDOCFLAGS", "--deny warnings")),
    },
    Step {
        purpose: "benches build",
        // The test profile shares the compiled libraries of the tests.
        arguments: &["test", "--workspace", "--benches", "--no-run"],
        variable: None,
    },
    Step {
        purpose: "tidy",
        arguments: &["test", "--workspace", "--bins", "tidy::"],
        variable: None,
    },
];

/// Runs the steps in order; stops at the first failure.
pub(crate) fn run() -> Result<()> {
    for step in STEPS {
        let (purpose, arguments) = (step.purpose, step.arguments);
        println!("check: {purpose}: cargo {}", arguments.join(" "));
        execute(cargo(arguments).envs(step.variable)).context(purpose)?;
    }
    println!("check: all steps passed");
    Ok(())
}

//! `cargo xtask check`: everything that must hold before a commit, of the tests only those
//! with random input.

use crate::command::{cargo, execute, workspace_root};
use crate::tidy;
use anyhow::{Context, Result, bail};
use std::process::Command;

/// A step that cargo carries out.
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
        // In the profile of the tests, which build the same libraries.
        arguments: &["test", "--workspace", "--benches", "--no-run"],
        variable: None,
    },
    Step {
        purpose: "random input",
        // All tests of the workspace, so that what is built serves them; `--lib` would build one for Python too.
        arguments: &["test", "--workspace", "--tests", "extremes::fuzz"],
        variable: Some(("ACTIN_FUZZ_CASES", "100")),
    },
];

/// Runs all steps; the first that fails ends it.
pub(crate) fn run() -> Result<()> {
    for step in STEPS {
        let (purpose, arguments) = (step.purpose, step.arguments);
        println!("check: {purpose}: cargo {}", arguments.join(" "));
        execute(cargo(arguments).envs(step.variable)).context(purpose)?;
    }
    book()?;
    println!("check: tidy");
    let findings = tidy::findings(&workspace_root()).map_err(anyhow::Error::msg)?;
    if findings.is_empty() {
        println!("check: all steps passed");
        return Ok(());
    }
    bail!("tidy:\n  {}", findings.join("\n  "))
}

/// Builds the book where there is an mdBook; with `ACTIN_REQUIRE_MDBOOK` there has to be one.
fn book() -> Result<()> {
    println!("check: book: mdbook build docs");
    let mut command = Command::new("mdbook");
    command
        .args(["build", "docs"])
        .current_dir(workspace_root());
    match Command::new("mdbook").arg("--version").output() {
        Ok(_) => execute(&mut command),
        Err(error) if std::env::var_os("ACTIN_REQUIRE_MDBOOK").is_none() => {
            println!("check: book: not built: mdbook: {error}");
            Ok(())
        }
        Err(error) => Err(error).context("mdbook"),
    }
}

//! `cargo xtask check`: everything that must hold before a commit, of the tests only those
//! with random input.

use crate::tidy;
use std::io::{self, BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Stdio};

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
        // Of the whole workspace, so that what is built serves all tests.
        arguments: &["test", "--workspace", "--test", "extremes", "fuzz::"],
        variable: Some(("ACTIN_FUZZ_CASES", "100")),
    },
];

/// Runs all steps; the first that fails ends it.
pub(crate) fn run() -> Result<(), String> {
    let root = workspace_root();
    for step in STEPS {
        let Step {
            purpose,
            arguments,
            variable,
        } = step;
        println!("check: {purpose}: cargo {}", arguments.join(" "));
        let mut command = Command::new("cargo");
        command.args(arguments).current_dir(&root);
        if let Some((name, value)) = variable {
            command.env(name, value);
        }
        let status = status(&mut command).map_err(|error| format!("{purpose}: cargo: {error}"))?;
        if !status.success() {
            return Err(format!("{purpose}: cargo {} failed", arguments.join(" ")));
        }
    }
    println!("check: tidy");
    let findings = tidy::findings(&root)?;
    if findings.is_empty() {
        println!("check: all steps passed");
        return Ok(());
    }
    Err(format!("tidy:\n  {}", findings.join("\n  ")))
}

/// How a command ends. Its lines go through this program's standard output, so that it does not fail where
/// its reader has gone.
fn status(command: &mut Command) -> io::Result<ExitStatus> {
    let mut child = command.stdout(Stdio::piped()).spawn()?;
    let output = child.stdout.take().expect("it is piped");
    for line in BufReader::new(output).split(b'\n') {
        println!("{}", String::from_utf8_lossy(&line?));
    }
    child.wait()
}

/// The folder of the workspace's manifest.
pub(crate) fn workspace_root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .parent()
        .expect("xtask lies one folder below the workspace")
        .to_path_buf()
}

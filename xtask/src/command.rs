//! Cargo commands in this workspace.

use anyhow::{Context, Result, bail};
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

fn workspace_root() -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).parent();
    folder
        .expect("xtask is a subfolder of the workspace")
        .to_path_buf()
}

pub(crate) fn cargo(arguments: &[&str]) -> Command {
    let mut command = Command::new("cargo");
    command.args(arguments).current_dir(workspace_root());
    command
}

/// Runs a command.
///
/// # Errors
/// If the command does not start or fails.
pub(crate) fn execute(command: &mut Command) -> Result<()> {
    let status = command
        .status()
        .with_context(|| format!("{} did not start", command.get_program().display()))?;
    if status.success() {
        return Ok(());
    }
    bail!("{command:?} failed")
}

/// Builds and checks the wheel of the Python package, below `target/wheels`.
///
/// # Errors
/// If `crates/actin-python/test.sh` fails.
pub(crate) fn wheel() -> Result<()> {
    let mut command = Command::new("bash");
    command.args(["crates/actin-python/test.sh", "wheel"]);
    execute(command.current_dir(workspace_root()))
}

/// Runs a study of `actin-studies` in the release profile and returns its exit code.
pub(crate) fn study(arguments: &[OsString]) -> ExitCode {
    let mut command = cargo(&[
        "run",
        "--quiet",
        "--release",
        "--package",
        "actin-studies",
        "--",
    ]);
    match command.args(arguments).status() {
        Ok(status) => status.code().map_or(ExitCode::FAILURE, |code| {
            ExitCode::from(u8::try_from(code).unwrap_or(1))
        }),
        Err(error) => {
            eprintln!("error: cargo did not start: {error}");
            ExitCode::FAILURE
        }
    }
}

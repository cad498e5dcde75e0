//! Commands of cargo in this workspace.

use anyhow::{Context, Result, bail};
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The folder of the workspace's manifest.
pub(crate) fn workspace_root() -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).parent();
    folder.expect("xtask lies one folder below").to_path_buf()
}

/// A command of cargo, to be executed in the workspace.
pub(crate) fn cargo(arguments: &[&str]) -> Command {
    let mut command = Command::new("cargo");
    command.args(arguments).current_dir(workspace_root());
    command
}

/// Executes a command. Its lines go through this program's standard output, so that it does not fail
/// where its reader has gone.
///
/// # Errors
/// If it does not start or does not succeed.
pub(crate) fn execute(command: &mut Command) -> Result<()> {
    let mut child = command
        .stdout(Stdio::piped())
        .spawn()
        .with_context(|| format!("{} did not start", command.get_program().display()))?;
    let output = child.stdout.take().expect("it is piped");
    for line in BufReader::new(output).split(b'\n') {
        println!("{}", String::from_utf8_lossy(&line?));
    }
    if child.wait()?.success() {
        return Ok(());
    }
    bail!("{command:?} failed")
}

/// Executes this task again in a program that is compiled as a user's is, if this one is not.
///
/// # Errors
/// If it fails there.
pub(crate) fn optimised(task: impl FnOnce() -> Result<()>) -> Result<()> {
    if !cfg!(debug_assertions) {
        return task();
    }
    let mut command = cargo(&["run", "--quiet", "--release", "--package", "xtask", "--"]);
    execute(command.args(std::env::args_os().skip(1)))
}

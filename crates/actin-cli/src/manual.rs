//! Shell completions and manual pages, generated from the argument definitions.

use crate::Arguments;
use crate::failure::Failure;
use clap::CommandFactory;
use clap_complete::Shell;
use std::path::Path;

pub(crate) fn completions(shell: Shell) {
    let mut text = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "actin", &mut text);
    println!("{}", String::from_utf8_lossy(&text).trim_end());
}

/// Writes `actin.1` and one page for each command, such as `actin-run.1`, into a folder. Existing pages are replaced.
pub(crate) fn pages(folder: &Path) -> Result<(), Failure> {
    let unwritten = |error| Failure::Unwritten(format!("{}: {error}", folder.display()));
    std::fs::create_dir_all(folder).map_err(unwritten)?;
    let command = Arguments::command().disable_help_subcommand(true);
    clap_mangen::generate_to(command, folder).map_err(unwritten)
}

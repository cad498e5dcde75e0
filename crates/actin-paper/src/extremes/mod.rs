//! Every number that a user can write, taken to where it breaks, as a table with pictures: the result
//! is right to a stated accuracy, or a message says why there is none.
//!
//! Each number has a file of its own. The short rows are tests, in `tests.rs`; `fuzz` tries random
//! input.

mod certificates;
mod compression;
mod contrast;
mod directories;
mod drag;
mod drift;
mod fields;
mod forces;
#[cfg(test)]
mod fuzz;
mod guards;
mod lengths;
mod origin;
mod pictures;
mod row;
mod scenes;
mod sizes;
mod stability;
mod straight;
mod table;
#[cfg(test)]
mod tests;
mod text;
mod turns;
mod verdict;
mod write;

use crate::{Tell, workspace_root};
use std::fs;
use std::path::PathBuf;
use std::time::Instant;

/// What is computed, and where it goes.
#[derive(Clone, Debug)]
pub struct Options {
    /// Where to write the table and the pictures.
    pub out: PathBuf,
    /// Also the rows that take minutes: 1e6 bodies, 1e7 steps.
    pub long: bool,
    /// Also into `docs/tables/extremes.md`, with the pictures of `docs/extremes.md`, if all rows are sound.
    pub write: bool,
}

/// Computes the table, tells what is wrong in it, and writes it with its pictures.
///
/// # Errors
/// A row that is neither right nor refused, and a file that cannot be written.
pub fn run(options: &Options, tell: Tell<'_>) -> Result<(), String> {
    let out = &options.out;
    fs::create_dir_all(out).map_err(|e| format!("{}: {e}", out.display()))?;
    let clock = Instant::now();
    let rows = table::table(options.long, tell);
    write::csv(&rows, out)?;
    write::markdown(&rows, out)?;
    pictures::limits(out)?;
    pictures::energy(out)?;
    tell(format_args!(
        "{} rows in {:.0} s, written to {}",
        rows.len(),
        clock.elapsed().as_secs_f64(),
        out.display()
    ));
    let unsound = rows.iter().filter(|row| !row.outcome.is_sound());
    let wrong: Vec<String> = unsound
        .map(|row| format!("{}, {}: {}", row.varied, row.case, row.outcome.words()))
        .collect();
    if wrong.is_empty() {
        let docs = workspace_root().join("docs");
        let write = options.write.then(|| write::document(&rows, out, &docs));
        return write.unwrap_or(Ok(()));
    }
    Err(format!(
        "neither right nor refused:\n  {}",
        wrong.join("\n  ")
    ))
}

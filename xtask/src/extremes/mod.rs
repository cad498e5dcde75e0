//! `cargo xtask extremes`: every number that a user can write, taken to where it breaks, as a table
//! with pictures. What is measured lives with the tests, in `tests/extremes/cases`.

#[expect(dead_code, reason = "some of it is for tests alone")]
#[path = "../../../tests/extremes/cases/mod.rs"]
mod cases;
mod pictures;
mod write;

use crate::check::workspace_root;
use std::fs;
use std::path::PathBuf;
use std::time::Instant;

/// What is computed, and where it goes.
#[derive(clap::Args, Debug)]
pub(crate) struct Options {
    /// Where to write the table and the pictures.
    #[arg(long, default_value = "target/extremes")]
    out: PathBuf,
    /// Also the rows that take minutes: 1e6 bodies, 1e7 steps.
    #[arg(long)]
    long: bool,
    /// Also into `docs/extremes.md`, tables and pictures, if all rows are sound.
    #[arg(long, requires = "long")]
    write: bool,
}

/// Computes the table, prints what is wrong in it, and writes it with its pictures.
pub(crate) fn run(options: &Options) -> Result<(), String> {
    let out = &options.out;
    fs::create_dir_all(out).map_err(|e| format!("{}: {e}", out.display()))?;
    let clock = Instant::now();
    let rows = cases::table(options.long);
    write::csv(&rows, out)?;
    write::markdown(&rows, out)?;
    pictures::limits(out)?;
    pictures::energy(out)?;
    println!(
        "{} rows in {:.0} s, written to {}",
        rows.len(),
        clock.elapsed().as_secs_f64(),
        out.display()
    );
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

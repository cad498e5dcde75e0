//! `cargo xtask extremes`: tests every number of a scene at its limits and writes a table with
//! pictures. A result must have its stated accuracy, or a message must explain why there is none.

mod directories;
mod fields;
#[cfg(test)]
mod fuzz_tests;
mod loads;
mod motion;
mod row;
mod scenes;
mod sizes;
mod states;
mod steps;
mod write;

use actin_paper::workspace_root;
use anyhow::{Context, Error, Result, bail};
use rayon::prelude::*;
use row::Row;
use std::fs;
use std::path::PathBuf;
use std::time::Instant;

#[derive(clap::Args, Debug)]
pub(crate) struct Options {
    /// Output folder of the table and the pictures.
    #[arg(long, default_value = "target/extremes")]
    out: PathBuf,
    /// Includes rows that take minutes: 1e6 bodies, 1e7 steps.
    #[arg(long)]
    long: bool,
    /// Also writes `docs/extremes.csv` and the pictures of `docs/numerics.md`, if all rows are
    /// sound.
    #[arg(long, requires = "long")]
    write: bool,
}

/// Computes the table, prints defects, and writes the table with its pictures.
///
/// # Errors
/// A row that is neither correct nor refused, or a file that cannot be written.
pub(crate) fn run(options: &Options) -> Result<()> {
    let out = &options.out;
    fs::create_dir_all(out).with_context(|| out.display().to_string())?;
    let clock = Instant::now();
    let rows = table(options.long);
    write::table(&rows, out).map_err(Error::msg)?;
    steps::draw(out).map_err(Error::msg)?;
    println!(
        "{} rows in {:.0} s, written to {}",
        rows.len(),
        clock.elapsed().as_secs_f64(),
        out.display()
    );
    let wrong = defects(&rows);
    if !wrong.is_empty() {
        bail!("neither right nor refused:\n  {}", wrong.join("\n  "));
    }
    if options.write {
        let docs = workspace_root().join("docs");
        write::document(out, &docs).map_err(Error::msg)?;
    }
    Ok(())
}

type Group<'a> = (&'static str, &'a (dyn Fn() -> Vec<Row> + Sync));

/// The table in print order. Tests omit the rows that take long.
fn table(is_long: bool) -> Vec<Row> {
    let is_test = cfg!(test);
    let steps = match (is_test, is_long) {
        (true, _) => 50_000,
        (false, false) => 100_000,
        (false, true) => 10_000_000,
    };
    // Not in parallel with other groups, since the rows measure time and memory.
    let sizes = timed(&("sizes", &|| sizes::sizes(is_long)));
    let groups: [Group<'_>; 20] = [
        ("time steps", &steps::limits),
        ("energy below the limit", &steps::energies),
        ("time steps of scenes", &steps::asked),
        ("stiffness contrast", &loads::contrast),
        ("twist", &|| states::twist(!is_test)),
        ("turns of a segment", &states::one_segment),
        ("turns that slip", &states::slipping),
        ("straight rods", &states::straight),
        ("segments", &loads::segments),
        ("bonds", &loads::bonds),
        ("forces", &loads::forces),
        ("neutral modes", &states::neutral_modes),
        ("compression", &states::compression),
        ("sizes, as above", &|| sizes.clone()),
        ("drag", &motion::drag),
        ("undamped motion", &|| motion::undamped(steps)),
        ("origin", &sizes::origin),
        ("fields", &fields::rows),
        ("guards", &sizes::guards),
        ("directories", &directories::rows),
    ];
    let rows = groups.par_iter().with_max_len(1).map(timed);
    rows.collect::<Vec<_>>().concat()
}

fn timed((name, rows): &Group<'_>) -> Vec<Row> {
    let clock = Instant::now();
    let rows = rows();
    println!("{name}: {:.1} s", clock.elapsed().as_secs_f64());
    rows
}

fn defects(rows: &[Row]) -> Vec<String> {
    let defects = rows.iter().filter(|row| !row.is_sound());
    defects.map(Row::words).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_case_ends_as_expected() {
        let rows = table(false);
        for row in &rows {
            println!("{}", row.words());
        }
        assert_eq!(defects(&rows), Vec::<String>::new());
    }
}

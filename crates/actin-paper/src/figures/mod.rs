//! Artefacts of the paper, its figures and tables, computed and compared.
//!
//! Each artefact is a function that runs simulations, writes its pictures and tables into a
//! folder and returns rows that set our number beside the paper's. Nothing here is drawn from
//! anything but a simulation of that run. Artefacts follow one another; the runs of each are spread
//! over threads and put together in an order that does not depend on them.

mod bounds;
mod buckling;
mod claims;
mod figure4;
mod figure7;
mod figure9;
mod html;
mod kept;
mod law;
pub(crate) mod linked;
mod print;
mod progress;
mod schematics;
mod settles;
mod surface;
mod tables;

pub use crate::palette::Palette;
pub(crate) use html::unexplained;

use crate::Tell;
use actin_draw::report::{self, Artefact, Row};
use kept::{Kept, Reason, Shelf};
use progress::Progress;
use std::fs;
use std::path::{Path, PathBuf};

/// What is computed, and how.
#[derive(Clone, Debug)]
pub struct Options {
    /// Which: fig1 to fig10, table1 to table5, law; all if none is named.
    pub ids: Vec<String>,
    /// Where to write pictures, tables and reports.
    pub out: PathBuf,
    /// Fewer resolutions and samplings, and equilibria only.
    pub quick: bool,
    /// Number of threads; one for each core by default. The results do not depend on it.
    pub threads: Option<usize>,
    /// Computes again also what an earlier run has finished.
    pub fresh: bool,
    /// Writes every picture as PDF and PNG, too.
    pub print: bool,
    /// Colours of pictures and viewer.
    pub palette: Palette,
}

impl Options {
    /// All that changes an artefact.
    fn choices(&self) -> String {
        format!("quick: {}, palette: {:?}", self.quick, self.palette)
    }
}

/// What a recipe is given.
#[derive(Clone, Copy, Debug)]
struct Run<'a> {
    /// Folder for pictures and tables.
    out: &'a Path,
    /// Fewer resolutions and samplings, and equilibria only.
    quick: bool,
    /// Counts its runs.
    progress: &'a Progress,
}

/// An artefact: its name, and what computes it.
type Recipe = (&'static str, fn(Run<'_>) -> Result<Artefact, String>);

/// The artefacts that exist.
const RECIPES: [Recipe; 16] = [
    ("fig1", schematics::figure1),
    ("fig2", schematics::figure2),
    ("fig3", schematics::figure3),
    ("fig4", figure4::reproduce),
    ("fig5", linked::figure5),
    ("fig6", linked::figure6),
    ("fig7", figure7::reproduce),
    ("fig8", buckling::figure8),
    ("fig9", figure9::reproduce),
    ("fig10", buckling::figure10),
    ("table1", tables::table1),
    ("table2", tables::table2),
    ("table3", tables::table3),
    ("table4", tables::table4),
    ("table5", tables::table5),
    ("law", law::reproduce),
];

/// Computes the artefacts that are asked for, or takes them from an earlier run, and writes pictures,
/// tables, `report.json` and `report.html`; the rows of all.
///
/// # Errors
/// An artefact that is not known, a scene without a result, and a file that cannot be written.
pub fn reproduce(options: &Options, tell: Tell<'_>) -> Result<Vec<Row>, String> {
    let known: Vec<&str> = RECIPES.iter().map(|(id, _)| *id).collect();
    let is_known = |id: &&String| known.contains(&id.as_str());
    if let Some(unknown) = options.ids.iter().find(|id| !is_known(id)) {
        return Err(format!(
            "no artefact `{unknown}`: there is {}",
            known.join(", ")
        ));
    }
    crate::palette::choose(options.palette);
    let artefacts = on_threads(options.threads, || artefacts(&RECIPES, options, tell))?;
    let out = &options.out;
    report::write(&artefacts, out)?;
    if options.print {
        let count = on_threads(options.threads, || print::write(&artefacts, out))?;
        tell(format_args!("printed: {count} pictures as PDF and PNG"));
    }
    html::write(&artefacts, out, options.quick)?;
    tell(format_args!(
        "written: {}",
        out.join("report.html").display()
    ));
    Ok(artefacts.into_iter().flat_map(|a| a.rows).collect())
}

/// Does `work` on so many threads.
fn on_threads<T: Send>(
    threads: Option<usize>,
    work: impl FnOnce() -> Result<T, String> + Send,
) -> Result<T, String> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0));
    pool.build().map_err(|e| e.to_string())?.install(work)
}

/// The chosen artefacts, in the order of the recipes.
fn artefacts(
    recipes: &[Recipe],
    options: &Options,
    tell: Tell<'_>,
) -> Result<Vec<Artefact>, String> {
    fs::create_dir_all(&options.out).map_err(|e| format!("{}: {e}", options.out.display()))?;
    let shelf = Shelf::new(&options.out, kept::fingerprint(&options.choices())?)?;
    let chosen = |id: &str| options.ids.is_empty() || options.ids.iter().any(|wanted| wanted == id);
    let chosen = recipes.iter().filter(|(id, _)| chosen(id));
    chosen
        .map(|&recipe| {
            let (kept, _) = artefact(recipe, &shelf, options, tell)?;
            Ok(kept.artefact)
        })
        .collect()
}

/// One artefact, and why it was computed if it was.
fn artefact(
    (id, recipe): Recipe,
    shelf: &Shelf<'_>,
    options: &Options,
    tell: Tell<'_>,
) -> Result<(Kept, Option<Reason>), String> {
    let found = if options.fresh {
        Err(Reason::Asked)
    } else {
        shelf.find(id)
    };
    let reason = match found {
        Ok(kept) => {
            tell(format_args!(
                "{id}: kept from an earlier run ({})",
                effort(&kept)
            ));
            return Ok((kept, None));
        }
        Err(reason) => reason,
    };
    tell(format_args!("{id}: started, {reason}"));
    let kept = shelf.compute(id, |out| {
        let progress = Progress::new(id);
        let run = Run {
            out,
            quick: options.quick,
            progress: &progress,
        };
        let mut artefact = recipe(run)?;
        artefact.rows.extend(claims::rows(id, &artefact.rows));
        Ok((artefact, progress.finish()))
    })?;
    tell(format_args!("{id}: finished, {}", effort(&kept)));
    Ok((kept, Some(reason)))
}

/// Runs and time of an artefact, in words.
fn effort(kept: &Kept) -> String {
    format!("{} runs in {:.1} s", kept.runs, kept.artefact.wall_s)
}

#[cfg(test)]
mod repeats;
#[cfg(test)]
mod tests;

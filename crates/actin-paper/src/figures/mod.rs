//! Figures and tables of the paper, computed and compared.
//!
//! Each artefact is an `Experiment`. It solves scenes, measures quantities and draws pictures into a `Draft`. Expected
//! numbers are in `data/expected.csv` and `data/claims.csv`. Artefacts are computed one after the other; the runs of
//! each are distributed over threads. Results do not depend on the number of threads.

mod buckling;
mod cache;
mod cantilever;
mod charts;
mod draft;
mod expected;
mod law;
mod linkers;
mod middle;
mod model;
mod motion;
mod page;
mod print;
mod progress;
mod schematics;
mod tables;
mod texts;
mod twist_fits;

pub use crate::palette::Palette;
pub(crate) use page::unexplained;

use crate::ProgressSink;
use actin_draw::report::{self, Artefact, Row};
use cache::{Cache, CachedArtefact};
use draft::Draft;
use progress::Progress;
use std::fs;
use std::path::PathBuf;
use std::time::Instant;

/// Options of [`reproduce`], as on the command line of `cargo xtask reproduce-figures`.
#[derive(clap::Args, Clone, Debug)]
pub struct Options {
    /// Artefacts: fig1 to fig10, table1 to table5, law. All by default.
    pub ids: Vec<String>,
    /// Output folder of figures, tables and reports.
    #[arg(long, default_value = "target/figures")]
    pub out: PathBuf,
    /// Uses fewer resolutions and samples, and equilibria only.
    #[arg(long)]
    pub quick: bool,
    /// Number of threads; by default the number of cores. Results are independent of it.
    #[arg(long, value_name = "N")]
    pub threads: Option<usize>,
    /// Recomputes artefacts that an earlier run has finished.
    #[arg(long)]
    pub fresh: bool,
    /// Also writes every figure as PDF and PNG; requires Chromium, in CHROME or on the path.
    #[arg(long)]
    pub print: bool,
    /// Colours of figures and of the viewer.
    #[arg(skip)]
    pub palette: Palette,
}

impl Options {
    fn choices(&self) -> String {
        format!("quick: {}, palette: {:?}", self.quick, self.palette)
    }
}

/// Id of an artefact and its computation.
type Experiment = (&'static str, fn(&mut Draft<'_>) -> Result<(), String>);

const EXPERIMENTS: [Experiment; 16] = [
    ("fig1", schematics::figure1),
    ("fig2", schematics::figure2),
    ("fig3", schematics::figure3),
    ("fig4", cantilever::figure4),
    ("fig5", linkers::figure5),
    ("fig6", linkers::figure6),
    ("fig7", middle::figure7),
    ("fig8", buckling::figure8),
    ("fig9", twist_fits::figure9),
    ("fig10", buckling::figure10),
    ("table1", tables::table1),
    ("table2", tables::table2),
    ("table3", tables::table3),
    ("table4", tables::table4),
    ("table5", tables::table5),
    ("law", law::law),
];

/// Computes the chosen artefacts or reads them from the cache, and writes pictures, tables, `report.json` and
/// `report.html`. Returns the rows of all artefacts.
///
/// # Errors
/// An artefact is unknown, a scene cannot be solved, or a file cannot be written.
pub fn reproduce(options: &Options, tell: ProgressSink<'_>) -> Result<Vec<Row>, String> {
    let known: Vec<&str> = EXPERIMENTS.iter().map(|e| e.0).collect();
    let is_known = |id: &&String| known.contains(&id.as_str());
    if let Some(unknown) = options.ids.iter().find(|id| !is_known(id)) {
        return Err(format!(
            "unknown artefact `{unknown}`: choose from {}",
            known.join(", ")
        ));
    }
    crate::palette::choose(options.palette);
    let artefacts = on_threads(options.threads, || artefacts(&EXPERIMENTS, options, tell))?;
    let out = &options.out;
    report::write(&artefacts, out)?;
    if options.print {
        let count = on_threads(options.threads, || print::write(&artefacts, out))?;
        tell(format_args!("printed: {count} pictures as PDF and PNG"));
    }
    page::write(&artefacts, out, options.quick)?;
    tell(format_args!(
        "written: {}",
        out.join("report.html").display()
    ));
    Ok(artefacts.into_iter().flat_map(|a| a.rows).collect())
}

fn on_threads<T: Send>(
    threads: Option<usize>,
    work: impl FnOnce() -> Result<T, String> + Send,
) -> Result<T, String> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0));
    pool.build().map_err(|e| e.to_string())?.install(work)
}

fn artefacts(
    experiments: &[Experiment],
    options: &Options,
    tell: ProgressSink<'_>,
) -> Result<Vec<Artefact>, String> {
    fs::create_dir_all(&options.out).map_err(|e| format!("{}: {e}", options.out.display()))?;
    let cache = Cache::new(&options.out, cache::fingerprint(&options.choices())?)?;
    let is_chosen =
        |e: &&Experiment| options.ids.is_empty() || options.ids.iter().any(|wanted| wanted == e.0);
    let chosen = experiments.iter().filter(is_chosen);
    chosen
        .map(|experiment| Ok(artefact(experiment, &cache, options, tell)?.0.artefact))
        .collect()
}

/// Computes or reads one artefact. The reason is `None` if it was read from the cache.
fn artefact(
    &(id, run): &Experiment,
    cache: &Cache<'_>,
    options: &Options,
    tell: ProgressSink<'_>,
) -> Result<(CachedArtefact, Option<String>), String> {
    let found = if options.fresh {
        Err("recomputation requested".to_owned())
    } else {
        cache.find(id)
    };
    let reason = match found {
        Ok(cached) => {
            tell(format_args!(
                "{id}: reused from an earlier run ({})",
                effort(&cached)
            ));
            return Ok((cached, None));
        }
        Err(reason) => reason,
    };
    tell(format_args!("{id}: started, {reason}"));
    let computed = cache.compute(id, |out| {
        let progress = Progress::new(id);
        let started = Instant::now();
        let mut draft = Draft::new(id, out, options.quick, &progress);
        run(&mut draft)?;
        let artefact = draft.finish(started.elapsed().as_secs_f64())?;
        Ok((artefact, progress.finish()))
    })?;
    tell(format_args!("{id}: finished, {}", effort(&computed)));
    Ok((computed, Some(reason)))
}

fn effort(cached: &CachedArtefact) -> String {
    format!("{} runs in {:.1} s", cached.runs, cached.artefact.wall_s)
}

#[cfg(test)]
mod repeats_tests;
#[cfg(test)]
mod tests;

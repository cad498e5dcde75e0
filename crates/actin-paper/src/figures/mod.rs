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
mod surface;
mod tables;
mod twist_fits;

pub use crate::palette::Palette;
pub(crate) use page::unexplained;

use crate::ProgressSink;
use actin_draw::report::{self, Artefact, Row};
use cache::{Cache, CachedArtefact, Reason};
use draft::Draft;
use progress::Progress;
use std::fs;
use std::path::PathBuf;
use std::time::Instant;

/// Options of [`reproduce`].
#[derive(Clone, Debug)]
pub struct Options {
    /// Artefacts: fig1 to fig10, table1 to table5, law; all if the list is empty.
    pub ids: Vec<String>,
    /// Output folder of pictures, tables and reports.
    pub out: PathBuf,
    /// Computes fewer resolutions and samplings, and equilibria only.
    pub quick: bool,
    /// Number of threads, by default one per core. Results do not depend on it.
    pub threads: Option<usize>,
    /// Ignores results of earlier runs.
    pub fresh: bool,
    /// Also writes every picture as PDF and PNG.
    pub print: bool,
    /// Colours of pictures and viewer.
    pub palette: Palette,
}

impl Options {
    fn choices(&self) -> String {
        format!("quick: {}, palette: {:?}", self.quick, self.palette)
    }
}

#[derive(Clone, Copy, Debug)]
struct Experiment {
    id: &'static str,
    title: &'static str,
    run: fn(&mut Draft<'_>) -> Result<(), String>,
}

const fn experiment(
    id: &'static str,
    title: &'static str,
    run: fn(&mut Draft<'_>) -> Result<(), String>,
) -> Experiment {
    Experiment { id, title, run }
}

const EXPERIMENTS: [Experiment; 16] = [
    experiment(
        "fig1",
        "The two models and their combination",
        schematics::figure1,
    ),
    experiment(
        "fig2",
        "The junction of monomers and rod",
        schematics::figure2,
    ),
    experiment("fig3", "Three kinds of scenes", schematics::figure3),
    experiment(
        "fig4",
        "Cantilever of 160 nm under a tip force, resolved in seven ways",
        cantilever::figure4,
    ),
    experiment(
        "fig5",
        "Free filament of 160 nm on three linkers in one plane",
        linkers::figure5,
    ),
    experiment(
        "fig6",
        "Free filament of 210 nm on four linkers on all sides",
        linkers::figure6,
    ),
    experiment(
        "fig7",
        "Filament turned in the middle: energy of both halves",
        middle::figure7,
    ),
    experiment(
        "fig8",
        "Twisted and compressed filaments: constant rigidities",
        buckling::figure8,
    ),
    experiment(
        "fig9",
        "Twisting rigidity and change of length against twist, fitted",
        twist_fits::figure9,
    ),
    experiment(
        "fig10",
        "Twisted and compressed filaments: twist-dependent rods",
        buckling::figure10,
    ),
    experiment(
        "table1",
        "Parameters of the ellipsoid model",
        tables::table1,
    ),
    experiment(
        "table2",
        "Parameters of the preceding paper's Cosserat rod",
        tables::table2,
    ),
    experiment(
        "table3",
        "Secant twisting rigidity of the ellipsoid filament",
        tables::table3,
    ),
    experiment(
        "table4",
        "Rigidities of the multi-resolution model, measured on the monomers",
        tables::table4,
    ),
    experiment(
        "table5",
        "Change of length of the twisted ellipsoid filament",
        tables::table5,
    ),
    experiment(
        "law",
        "The rod law in load cases that were not used for fitting",
        law::law,
    ),
];

/// Computes the chosen artefacts or reads them from the cache, and writes pictures, tables, `report.json` and
/// `report.html`. Returns the rows of all artefacts.
///
/// # Errors
/// An artefact is unknown, a scene cannot be solved, or a file cannot be written.
pub fn reproduce(options: &Options, tell: ProgressSink<'_>) -> Result<Vec<Row>, String> {
    let known: Vec<&str> = EXPERIMENTS.iter().map(|e| e.id).collect();
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
        |e: &&Experiment| options.ids.is_empty() || options.ids.iter().any(|wanted| wanted == e.id);
    let chosen = experiments.iter().filter(is_chosen);
    chosen
        .map(|experiment| Ok(artefact(experiment, &cache, options, tell)?.0.artefact))
        .collect()
}

/// Computes or reads one artefact. The reason is `None` if it was read from the cache.
fn artefact(
    &Experiment { id, title, run }: &Experiment,
    cache: &Cache<'_>,
    options: &Options,
    tell: ProgressSink<'_>,
) -> Result<(CachedArtefact, Option<Reason>), String> {
    let found = if options.fresh {
        Err(Reason::Requested)
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
        let artefact = draft.finish(title, started.elapsed().as_secs_f64());
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

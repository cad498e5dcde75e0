//! Sweeps in a directory.

use crate::errors;
use crate::scene::Scene;
use crate::watch::{Watch, callback, finish};
use actin_sweep::{
    Axis, Ron, Samples, Settings, Sweep, SweepDirectory, SweepError, SweepOutcome, ValidatedSweep,
};
use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;

/// Interval of progress updates.
const LOOK: Duration = Duration::from_millis(50);

fn refused(py: Python<'_>, error: &SweepError) -> PyErr {
    match error {
        SweepError::Io { .. } | SweepError::Run(_) => PyOSError::new_err(error.to_string()),
        SweepError::Refused { mistakes, .. } => {
            let lines: Vec<String> = mistakes.iter().map(ToString::to_string).collect();
            errors::raise(py, "SceneError", &lines.join("\n"), &PyDict::new(py))
        }
        _ => PyValueError::new_err(error.to_string()),
    }
}

/// Values of keys that are varied together.
type Varied = (Vec<String>, Vec<Vec<String>>);

/// Validates a sweep and creates its directory.
fn open(
    py: Python<'_>,
    scene: &Bound<'_, Scene>,
    (vary, results): (Vec<Varied>, Vec<String>),
    (samples, first_seed): (usize, u64),
    (out, resume): (PathBuf, bool),
) -> PyResult<(SweepDirectory, ValidatedSweep)> {
    let scene = scene.get();
    let axis = |(keys, rows): (Vec<String>, Vec<Vec<String>>)| Axis::Rows {
        keys,
        rows: rows
            .into_iter()
            .map(|row| row.into_iter().map(Ron).collect())
            .collect(),
    };
    let sweep = Sweep {
        title: scene.inner.title.clone(),
        scene: "scene.ron".to_owned(),
        results,
        set: Vec::new(),
        vary: vary.into_iter().map(axis).collect(),
        samples: (samples > 0).then(|| Samples {
            number: samples,
            first_seed,
            of: actin_sim::RandomPart::ALL.to_vec(),
        }),
    };
    let opened = py.detach(|| ValidatedSweep::new(sweep, scene.inner.to_ron()));
    let opened = opened.map_err(|problem| errors::problem(py, &problem))?;
    let directory = SweepDirectory::create(&out, &opened, resume);
    let directory = directory.map_err(|error| refused(py, &error))?;
    Ok((directory, opened))
}

/// Writes a sweep with a Snakemake workflow into a directory. Returns the number of runs.
#[pyfunction]
pub(crate) fn emit_snakemake(
    py: Python<'_>,
    scene: &Bound<'_, Scene>,
    out: PathBuf,
    vary: Vec<Varied>,
    results: Vec<String>,
    samples: usize,
    first_seed: u64,
) -> PyResult<usize> {
    let seeds = (samples, first_seed);
    let (directory, opened) = open(py, scene, (vary, results), seeds, (out, true))?;
    let cost = py.detach(|| opened.estimate_cost(usize::MAX));
    let written = directory.write_snakemake(&opened, &cost);
    written.map_err(|error| refused(py, &error))?;
    Ok(opened.design.len())
}

/// Makes the runs of a sweep in a directory. Returns the numbers of runs and of failed runs.
#[pyfunction]
#[pyo3(signature = (scene, out, vary, results, samples, first_seed, jobs, resume, progress))]
#[expect(clippy::too_many_arguments, reason = "called by the package alone")]
pub(crate) fn carry_out(
    py: Python<'_>,
    scene: &Bound<'_, Scene>,
    out: PathBuf,
    vary: Vec<Varied>,
    results: Vec<String>,
    samples: usize,
    first_seed: u64,
    jobs: Option<NonZeroUsize>,
    resume: bool,
    progress: Option<Py<PyAny>>,
) -> PyResult<(usize, usize)> {
    let seeds = (samples, first_seed);
    let (directory, opened) = open(py, scene, (vary, results), seeds, (out, resume))?;
    let interrupted = Arc::new(AtomicBool::new(false));
    let settings = Settings {
        jobs,
        interrupted: Arc::clone(&interrupted),
        ..Settings::default()
    };
    let progress = callback(py, progress)?;
    let watch = Watch::new(progress.as_ref().map(|progress| progress.clone_ref(py)));
    let (ended, error) = py.detach(|| make(&directory, &opened, &settings, watch));
    finish(py, progress.as_ref())?;
    let ended = ended.map_err(|error| refused(py, &error))?;
    match error {
        Some(error) if ended.is_interrupted() => Err(error),
        _ => Ok((ended.of, ended.failed)),
    }
}

/// Makes the runs on worker threads. Signals are handled by the main thread.
fn make(
    directory: &SweepDirectory,
    opened: &ValidatedSweep,
    settings: &Settings,
    mut watch: Watch,
) -> (Result<SweepOutcome, SweepError>, Option<PyErr>) {
    let (done, of) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let note = |progress: actin_sweep::Progress| {
        of.store(progress.of, Ordering::Relaxed);
        done.store(progress.ended, Ordering::Relaxed);
    };
    let ended = std::thread::scope(|scope| {
        let runs = scope.spawn(|| directory.run_all(opened, settings, &note));
        while !runs.is_finished() {
            std::thread::sleep(LOOK);
            watch.runs(done.load(Ordering::Relaxed), of.load(Ordering::Relaxed));
            if watch.is_interrupted() {
                settings.interrupted.store(true, Ordering::Relaxed);
            }
        }
        runs.join()
    });
    let ended = ended.unwrap_or_else(|panic| std::panic::resume_unwind(panic));
    (ended, watch.into_error())
}

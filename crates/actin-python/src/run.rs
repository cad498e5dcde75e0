//! Runs of scenes in memory or in a run directory.

use crate::errors;
use crate::records::{arrays, bodies};
use crate::scene::Scene;
use crate::watch::{Watch, callback, finish};
use actin_rundir::{CheckpointError, Checkpoints, Existing, OpenedRun, RunDirectory};
use actin_sim::{
    Assembly, FailedRun, Failure, Outcome, Plan, Progress, Record, RecordSummary, Records,
    RunError, RunPosition, SavedRun, Sink, Status, Summary, Trajectory,
};
use pyo3::exceptions::{PyRuntimeWarning, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::ffi::CString;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// A sink that also reports progress and checks for signals.
struct Observed<'a, S> {
    inner: &'a mut S,
    watch: Watch,
}

impl<S: Sink> Sink for Observed<'_, S> {
    fn record(&mut self, record: &Record) {
        self.inner.record(record);
    }

    fn progress(&mut self, progress: &Progress) {
        self.inner.progress(progress);
        self.watch.progress(progress);
    }

    fn is_interrupted(&mut self) -> bool {
        self.inner.is_interrupted() || self.watch.is_interrupted()
    }

    fn is_checkpoint_due(&mut self) -> bool {
        self.inner.is_checkpoint_due()
    }

    fn checkpoint(&mut self, position: &RunPosition, recorded: &RecordSummary, wall_s: f64) {
        self.inner.checkpoint(position, recorded, wall_s);
    }
}

/// A scene to run.
struct Job<'a> {
    scene: &'a Scene,
    assembly: &'a Assembly,
    plan: &'a Plan<'a>,
    progress: Option<Py<PyAny>>,
}

/// End of a run: outcome, failure if any, and the exception that interrupted it.
struct RunEnd {
    outcome: Outcome,
    failure: Option<Failure>,
    error: Option<PyErr>,
}

impl Job<'_> {
    /// Runs the scene without holding the interpreter lock.
    fn advance<S: Sink + Send>(
        &self,
        py: Python<'_>,
        saved: Option<SavedRun>,
        sink: &mut S,
    ) -> PyResult<RunEnd> {
        let progress = self
            .progress
            .as_ref()
            .map(|progress| progress.clone_ref(py));
        let watch = Watch::new(progress);
        let mut observed = Observed { inner: sink, watch };
        let plan = self.plan;
        let result = py.detach(|| match saved {
            None => plan.run_into(&mut observed),
            Some(saved) => plan.resume_into(saved, &mut observed),
        });
        finish(py, self.progress.as_ref())?;
        let error = observed.watch.into_error();
        match result {
            Ok(outcome) => Ok(RunEnd {
                outcome,
                failure: None,
                error,
            }),
            Err(RunError::Failed(failed)) => {
                let FailedRun { failure, outcome } = *failed;
                Ok(RunEnd {
                    outcome,
                    failure: Some(failure),
                    error,
                })
            }
            Err(RunError::Refused(problem)) => Err(self.scene.refuse(py, &problem)),
        }
    }

    /// Returns the run, or raises an exception that contains it.
    fn conclude(
        &self,
        py: Python<'_>,
        ended: RunEnd,
        records: &dyn Records,
        summary: Option<Summary>,
    ) -> PyResult<Py<PyAny>> {
        let RunEnd {
            outcome,
            failure,
            error,
        } = ended;
        let run = if records.count() > 0 {
            Some(self.run(py, &outcome, records, summary)?)
        } else {
            None
        };
        if outcome.status == Status::Interrupted {
            return Err(interrupted(py, error, ("run", run)));
        }
        match failure {
            None => {
                let run = run.ok_or_else(|| PyValueError::new_err("the run has no record"))?;
                py.import("actin_filaments.results")?
                    .call_method1("emit_warnings", (&run,))?;
                Ok(run)
            }
            Some(failure) => Err(failed(py, &failure, run)),
        }
    }

    /// Converts the run to a Python object.
    fn run(
        &self,
        py: Python<'_>,
        outcome: &Outcome,
        records: &dyn Records,
        summary: Option<Summary>,
    ) -> PyResult<Py<PyAny>> {
        let of_run = || Summary::from_run(self.assembly, records, outcome);
        let summary = summary.map_or_else(of_run, Ok);
        let summary = summary.map_err(|error| errors::directory(&error.into()))?;
        let summary = serde_json::to_string(&summary).map_err(errors::value)?;
        let summary = py.import("json")?.call_method1("loads", (summary,))?;
        let scene = Scene::from(self.plan.scene().clone());
        let arrays = arrays(py, self.assembly, records)?;
        let arguments = PyDict::new(py);
        arguments.set_item("scene", scene)?;
        arguments.set_item("summary", summary)?;
        arguments.set_item("arrays", arrays)?;
        arguments.set_item("bodies", bodies(py, self.assembly)?)?;
        let class = py.import("actin_filaments.results")?.getattr("Run")?;
        Ok(class.call((), Some(&arguments))?.unbind())
    }
}

/// Returns the exception of an interrupted run or trade, with its partial result as the attribute `name`.
pub(crate) fn interrupted(
    py: Python<'_>,
    error: Option<PyErr>,
    (name, so_far): (&str, Option<Py<PyAny>>),
) -> PyErr {
    let by_callback =
        error.filter(|error| !error.is_instance_of::<pyo3::exceptions::PyKeyboardInterrupt>(py));
    if let Some(error) = by_callback {
        return error;
    }
    let attributes = PyDict::new(py);
    let message = format!("the {name} was interrupted");
    match attributes.set_item(name, so_far) {
        Ok(()) => errors::raise(py, "Interrupted", &message, &attributes),
        Err(error) => error,
    }
}

/// Returns the exception of a failed run, with its records.
fn failed(py: Python<'_>, failure: &Failure, run: Option<Py<PyAny>>) -> PyErr {
    let attributes = PyDict::new(py);
    let set = attributes.set_item("run", run);
    let mut set = set.and_then(|()| attributes.set_item("code", code(failure)));
    if let Failure::Diverged { failure, body } = failure {
        set = set.and_then(|()| errors::locate(&attributes, failure, body));
    }
    if let Failure::LoadBelowResidual(problem) | Failure::Saddle(problem) = failure {
        set = set
            .and_then(|()| attributes.set_item("key", &problem.key))
            .and_then(|()| attributes.set_item("value", &problem.value));
    }
    match set {
        Ok(()) => errors::raise(py, "RunFailed", &failure.to_string(), &attributes),
        Err(error) => error,
    }
}

/// Returns the code of a failure in exceptions.
fn code(failure: &Failure) -> &'static str {
    match failure {
        Failure::PathEnded { .. } => "path-ended",
        Failure::LoadBelowResidual(_) => "load-below-residual",
        Failure::ModelLimitExceeded(_) => "model-limit",
        Failure::Saddle(_) => "saddle",
        Failure::TwistLost { .. } => "twist-lost",
        Failure::HingeSlipped { .. } => "hinge-slipped",
        Failure::Diverged { .. } => "diverged",
        _ => "run-failed",
    }
}

/// Output directory and its options.
#[derive(Debug)]
struct Target {
    path: PathBuf,
    existing: Existing,
    every: Duration,
}

/// Runs a scene in memory, or in the run directory `out`.
///
/// - `overwrite`: replaces an earlier run.
/// - `resume`: continues an interrupted run, or extends a completed motion to a longer duration; the results are
///   bitwise identical to those of a single run.
/// - `progress`: `True` shows a bar (the default on a terminal), `False` shows nothing; a function is called
///   with a `Progress`.
///
/// Raises `SceneError`; `OSError` for the directory; `RunFailed`, and on Ctrl-C `Interrupted`, with the results
/// so far.
#[pyfunction]
#[pyo3(signature = (scene, out = None, *, overwrite = false, resume = false, checkpoint_every_s = 60.0, progress = None))]
pub(crate) fn run(
    py: Python<'_>,
    scene: &Bound<'_, Scene>,
    out: Option<PathBuf>,
    overwrite: bool,
    resume: bool,
    checkpoint_every_s: f64,
    progress: Option<Py<PyAny>>,
) -> PyResult<Py<PyAny>> {
    let scene = scene.get();
    let every = Duration::try_from_secs_f64(checkpoint_every_s).map_err(errors::value)?;
    let existing = match (overwrite, resume) {
        (false, false) => Existing::Refuse,
        (true, false) => Existing::Overwrite,
        (false, true) => Existing::Resume,
        (true, true) => {
            let message = "resume and overwrite exclude each other";
            return Err(PyValueError::new_err(message));
        }
    };
    let assembly = scene.build(py)?;
    let plan = py.detach(|| Plan::new(&assembly));
    let plan = plan.map_err(|problem| scene.refuse(py, &problem))?;
    let job = Job {
        scene,
        assembly: &assembly,
        plan: &plan,
        progress: callback(py, progress)?,
    };
    match out {
        None => {
            let mut records = Trajectory::default();
            let ended = job.advance(py, None, &mut records)?;
            job.conclude(py, ended, &records, None)
        }
        Some(path) => into_directory(
            py,
            &job,
            &Target {
                path,
                existing,
                every,
            },
        ),
    }
}

fn into_directory(py: Python<'_>, job: &Job<'_>, target: &Target) -> PyResult<Py<PyAny>> {
    let refused = |error| errors::directory(&error);
    let directory = RunDirectory::existing(&target.path);
    let mut checkpoints = Checkpoints::new(
        &directory,
        job.plan,
        target.every,
        Arc::new(AtomicBool::new(false)),
        warn,
    );
    let opened = checkpoints.open(job.plan, target.existing);
    let OpenedRun::Begun { saved, lock: _lock } = opened.map_err(refused)? else {
        let load = py.import("actin_filaments.results")?.getattr("load")?;
        return Ok(load.call1((&target.path,))?.unbind());
    };
    let ended = job.advance(py, saved.map(|saved| *saved), &mut checkpoints)?;
    let status = ended.outcome.status;
    let mut summary = None;
    if checkpoints.count() > 0 {
        let written = py.detach(|| directory.write(job.plan, &checkpoints, &ended.outcome));
        summary = Some(written.map_err(refused)?);
    }
    let concluded = job.conclude(py, ended, &checkpoints, summary);
    if status != Status::Interrupted {
        checkpoints.finish(status).map_err(refused)?;
    }
    let run = concluded?;
    run.setattr(py, "directory", &target.path)?;
    Ok(run)
}

/// Issues a Python warning for a checkpoint that could not be written.
fn warn(error: &CheckpointError) {
    let message = CString::new(format!("no checkpoint: {error}; the run continues"));
    Python::attach(|py| {
        let warning = py.get_type::<PyRuntimeWarning>();
        // The run continues even if warnings are errors.
        if let Ok(message) = message {
            let _ = PyErr::warn(py, &warning, &message, 2);
        }
    });
}

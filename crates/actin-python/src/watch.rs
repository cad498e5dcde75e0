//! Signals and progress callbacks of a computation, polled while the interpreter lock is released.

use actin_sim::{At, Progress as Inner};
use pyo3::prelude::*;
use std::time::{Duration, Instant};

/// Interval of checks for signals.
const SIGNALS: Duration = Duration::from_millis(50);
/// Interval of progress callbacks.
const SHOWN: Duration = Duration::from_millis(100);

/// Progress of a run.
#[pyclass(module = "actin_filaments", frozen)]
#[derive(Debug)]
pub(crate) struct Progress {
    /// Completed fraction of the run, from 0 to 1.
    #[pyo3(get)]
    share: f64,
    /// Time (ns), stages of a path, or runs of a sweep.
    #[pyo3(get)]
    at: f64,
    /// Final value of `at`.
    #[pyo3(get)]
    end: f64,
    /// Unit of `at`: `ns`, `stages` or `runs`.
    #[pyo3(get)]
    unit: &'static str,
    /// Number of time steps made.
    #[pyo3(get)]
    steps: u64,
    /// Largest force on a free point (pN).
    #[pyo3(get)]
    residual_force_pn: f64,
    /// Time since the start of the run (s).
    #[pyo3(get)]
    seconds: f64,
}

#[pymethods]
impl Progress {
    fn __repr__(&self) -> String {
        let (percent, at, end, unit) = (100.0 * self.share, self.at, self.end, self.unit);
        format!("Progress({percent:.0} %, {at:.4} of {end:.4} {unit})")
    }
}

/// Signal checks and progress callback.
#[derive(Debug)]
pub(crate) struct Watch {
    started: Instant,
    signals: Instant,
    shown: Option<Instant>,
    progress: Option<Py<PyAny>>,
    /// Exception that ended the computation: `KeyboardInterrupt` or an exception of the callback.
    error: Option<PyErr>,
}

impl Watch {
    pub(crate) fn new(progress: Option<Py<PyAny>>) -> Self {
        let now = Instant::now();
        Self {
            started: now,
            signals: now,
            shown: None,
            progress,
            error: None,
        }
    }

    /// Checks for signals and returns whether the computation should end.
    pub(crate) fn is_interrupted(&mut self) -> bool {
        if self.error.is_none() && self.signals.elapsed() >= SIGNALS {
            self.error = signals().err();
            self.signals = Instant::now();
        }
        self.error.is_some()
    }

    /// Reports the progress of a run.
    pub(crate) fn progress(&mut self, at: &Inner) {
        let unit = match at.at {
            At::Time(_) => "ns",
            At::Path(_) => "stages",
        };
        let place = at.at.value();
        self.tell((place, at.end, unit), at.steps, at.residual_force_pn);
    }

    /// Reports the number of finished runs.
    pub(crate) fn runs(&mut self, ended: usize, of: usize) {
        self.tell((ended as f64, of as f64, "runs"), ended as u64, 0.0);
    }

    /// Calls the callback with the name of the next run, unless an exception has ended the computation.
    pub(crate) fn begins(&mut self, name: &str) {
        if let (Some(callback), None) = (&self.progress, &self.error) {
            let called = Python::attach(|py| callback.call1(py, (name,)).map(drop));
            self.error = called.err();
        }
    }

    fn tell(&mut self, (at, end, unit): (f64, f64, &'static str), steps: u64, residual: f64) {
        let is_new = self.shown.is_none_or(|last| last.elapsed() >= SHOWN);
        let Some(callback) = self.progress.as_ref().filter(|_| is_new || at >= end) else {
            return;
        };
        self.shown = Some(Instant::now());
        let share = if end > 0.0 { at / end } else { 1.0 };
        let progress = Progress {
            share: share.clamp(0.0, 1.0),
            at,
            end,
            unit,
            steps,
            residual_force_pn: residual,
            seconds: self.started.elapsed().as_secs_f64(),
        };
        let told = Python::attach(|py| callback.call1(py, (progress,)).map(drop));
        if let Err(error) = told {
            self.error.get_or_insert(error);
        }
    }

    /// Returns the exception that ended the computation, if any.
    pub(crate) fn into_error(self) -> Option<PyErr> {
        self.error
    }
}

/// Runs the Python signal handlers.
fn signals() -> PyResult<()> {
    Python::attach(|py| {
        py.check_signals()?;
        Ok(())
    })
}

/// Returns the progress callback: a terminal bar for `None`, no callback for `False`.
pub(crate) fn callback(py: Python<'_>, progress: Option<Py<PyAny>>) -> PyResult<Option<Py<PyAny>>> {
    let chosen = py
        .import("actin_filaments._progress")?
        .call_method1("callback", (progress,))?;
    Ok((!chosen.is_none()).then(|| chosen.unbind()))
}

/// Removes the terminal bar.
pub(crate) fn finish(py: Python<'_>, progress: Option<&Py<PyAny>>) -> PyResult<()> {
    match progress {
        Some(progress) => py
            .import("actin_filaments._progress")?
            .call_method1("finish", (progress,))
            .map(drop),
        None => Ok(()),
    }
}

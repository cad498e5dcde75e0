//! Trades: error and run time of models of a scene.

use crate::errors;
use crate::run::interrupted;
use crate::scene::Scene;
use crate::watch::{Watch, callback, finish};
use actin_sim::Scene as Inner;
use actin_sim::trade::{self as sim, Item, Measure, Options, Reference, Trade, TradeError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::cell::RefCell;
use std::convert::Infallible;
use std::time::Duration;

/// Names of arguments, whose problems have no position in the text of the scene.
const ARGUMENTS: [&str; 3] = ["quantity", "error", "loads"];

/// Compares the error and run time of cheaper models of a scene with the all-monomer model.
///
/// - `quantities`: `tip`, `height`, `end-force`, `end-couple`, `energy`, `curvature`, `linker-force`, or
///   prefixes of observables; by default the observables of the scene and the tip displacements.
/// - `error`: largest accepted relative error.
/// - `loads`: fractions of the loads at which models within the error run again.
/// - `budget_s`: longest time of one run (s).
/// - `all`: also compares models with finer meshes and other rod laws.
/// - `progress`: `True` prints the name of each run (the default on a terminal), `False` prints nothing; a
///   function is called with the name.
///
/// Raises `SceneError`; `RunFailed` if the reference has no result; on Ctrl-C `Interrupted` with the `trade` so
/// far.
#[pyfunction]
#[pyo3(signature = (scene, *, quantities = Vec::new(), error = 0.02, loads = vec![0.5], budget_s = 60.0, all = false, progress = None))]
#[expect(clippy::too_many_arguments, reason = "keywords of Python")]
pub(crate) fn trade(
    py: Python<'_>,
    scene: &Bound<'_, Scene>,
    quantities: Vec<String>,
    error: f64,
    loads: Vec<f64>,
    budget_s: f64,
    all: bool,
    progress: Option<Py<PyAny>>,
) -> PyResult<Py<PyAny>> {
    let options = Options {
        measures: quantities.iter().map(|name| measure(name)).collect(),
        error,
        budget: Duration::try_from_secs_f64(budget_s).map_err(errors::value)?,
        load_shares: loads,
        is_all: all,
    };
    let scene = scene.get();
    let progress = callback(py, progress)?;
    let watch = Watch::new(progress.as_ref().map(|progress| progress.clone_ref(py)));
    let (found, error) = py.detach(|| watched(&scene.inner, &options, watch));
    finish(py, progress.as_ref())?;
    let found = match found {
        Ok(trade) => to_python(py, &trade)?,
        Err(TradeError::Interrupted) => return Err(interrupted(py, error, ("trade", None))),
        Err(TradeError::Refused(problem)) if ARGUMENTS.contains(&problem.key.as_str()) => {
            return Err(errors::problem(py, &problem));
        }
        Err(TradeError::Refused(problem)) => return Err(scene.refuse(py, &problem)),
        Err(failure @ TradeError::ReferenceFails { .. }) => {
            let message = failure.to_string();
            return Err(errors::raise(py, "RunFailed", &message, &PyDict::new(py)));
        }
    };
    if error.is_some() {
        return Err(interrupted(py, error, ("trade", Some(found))));
    }
    py.import("actin_filaments.results")?
        .call_method1("emit_warnings", (&found,))?;
    Ok(found)
}

fn measure(name: &str) -> Measure {
    let parsed: Result<Measure, Infallible> = name.parse();
    parsed.unwrap_or_else(|never| match never {})
}

/// Runs the trade without the interpreter lock; returns the exception of signals and the callback, if any.
fn watched(
    scene: &Inner,
    options: &Options,
    watch: Watch,
) -> (Result<Trade, TradeError>, Option<PyErr>) {
    let watch = RefCell::new(watch);
    let observer = sim::TradeCallbacks {
        report: &|name| watch.borrow_mut().begins(name),
        is_interrupted: &|| watch.borrow_mut().is_interrupted(),
    };
    let found = sim::trade(scene, options, &observer);
    (found, watch.into_inner().into_error())
}

/// Converts the trade to an object of the class in `_trade.py`.
fn to_python(py: Python<'_>, trade: &Trade) -> PyResult<Py<PyAny>> {
    let python_scene = |inner: &Inner| Scene::from(inner.clone());
    let scenes = trade.candidates.iter().map(|one| python_scene(&one.scene));
    let units = PyDict::new(py);
    for item in &trade.items {
        units.set_item(&item.name, item.unit)?;
    }
    let scatter = trade.scatter.as_deref();
    let scatter = scatter.map(|errors| by_item(py, &trade.items, errors));
    let arguments = PyDict::new(py);
    arguments.set_item("text", trade.to_string())?;
    arguments.set_item("csv", trade.to_csv())?;
    arguments.set_item("units", units)?;
    arguments.set_item("scenes", scenes.collect::<Vec<_>>())?;
    arguments.set_item("best", trade.best)?;
    let reference = reference(py, &trade.items, &trade.reference)?;
    reference.set_item("scene", python_scene(&trade.reference.scene))?;
    arguments.set_item("reference", reference)?;
    arguments.set_item("left_out", &trade.left_out)?;
    arguments.set_item("scatter", scatter.transpose()?)?;
    arguments.set_item("wanted_error", trade.options.error)?;
    let class = py.import("actin_filaments._trade")?.getattr("Trade")?;
    Ok(class.call((), Some(&arguments))?.unbind())
}

/// Converts the reference, without its scene.
fn reference<'py>(
    py: Python<'py>,
    items: &[Item],
    reference: &Reference,
) -> PyResult<Bound<'py, PyDict>> {
    let own_errors = by_item(py, items, &reference.own_errors)?;
    let keys = PyDict::new(py);
    keys.set_item("name", &reference.name)?;
    keys.set_item("monomers", reference.counts.monomers)?;
    keys.set_item("segments", reference.counts.segments)?;
    keys.set_item("wall_s", reference.wall_s)?;
    keys.set_item("own_errors", own_errors)?;
    keys.set_item("share", reference.share)?;
    keys.set_item("is_settled", reference.is_settled)?;
    Ok(keys)
}

/// Converts errors to a dictionary by item names.
fn by_item<'py>(
    py: Python<'py>,
    items: &[Item],
    errors: &[Option<f64>],
) -> PyResult<Bound<'py, PyDict>> {
    let named = PyDict::new(py);
    for (item, error) in items.iter().zip(errors) {
        named.set_item(&item.name, error)?;
    }
    Ok(named)
}

//! `Scene`: conversion from and to RON and dictionaries, changes and checks.

use crate::errors::{self, Source};
use crate::value::{from_python, to_python};
use actin_sim::{
    Assembly, Plan, RandomPart, Scene as Inner, SceneKind, SceneProblem, SceneText, SceneValue,
};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyMapping};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Model and task: filaments, clamps, loads, linkers, and the computation.
///
/// Keys and rules are those of scene files. In dictionaries, a choice with keys is a dictionary with one entry
/// (`{"Rod": {"from_nm": 0.0, "to_nm": 40.0}}`), and a choice without keys is a string (`"Start"`). Scenes are
/// immutable: `set` and `reseed` return new scenes. Invalid scenes raise `SceneError`.
#[pyclass(module = "actin_filaments", frozen, eq)]
#[derive(Debug)]
pub(crate) struct Scene {
    pub(crate) inner: Inner,
    /// Text that the scene was read from, which locates problems.
    pub(crate) text: Option<Source>,
    /// Keys as written of a scene with arrangements or sets of linkers, and the folder of their files of points, for
    /// `set`.
    arranged: Option<(SceneValue, Option<PathBuf>)>,
}

/// A scene without the text that it was read from.
impl From<Inner> for Scene {
    fn from(inner: Inner) -> Self {
        Self {
            inner,
            text: None,
            arranged: None,
        }
    }
}

impl PartialEq for Scene {
    fn eq(&self, other: &Self) -> bool {
        self.inner == other.inner
    }
}

impl Scene {
    fn of_value(py: Python<'_>, value: &SceneValue, folder: Option<&Path>) -> PyResult<Self> {
        let inner = Inner::from_value(value, folder).map_err(|p| errors::problem(py, &p))?;
        Ok(Self {
            arranged: arranged(value, folder),
            ..inner.into()
        })
    }

    fn of_text(py: Python<'_>, text: &str, file: String, folder: &Path) -> PyResult<Self> {
        let text = SceneText::new(text);
        let mut source = Source { text, file };
        let read = source.text.resolve_paths(folder);
        let inner = read.and_then(|()| source.text.scene());
        let inner = inner.map_err(|error| errors::mistakes(py, &source, error))?;
        Ok(Self {
            inner,
            arranged: arranged(source.text.value(), Some(folder)),
            text: Some(source),
        })
    }

    /// Reads a scene file.
    pub(crate) fn read(py: Python<'_>, path: &Path) -> PyResult<Self> {
        // The kind of the error selects the Python exception.
        let named =
            |error: io::Error| io::Error::new(error.kind(), format!("{}: {error}", path.display()));
        let bytes = std::fs::read(path).map_err(named)?;
        let file = format!("{}:", path.display());
        let text = Inner::text(bytes).map_err(|error| errors::unread(py, &file, &error))?;
        Self::of_text(py, &text, file, path.parent().unwrap_or(path))
    }

    /// Reports a problem that was found when the scene was built or run.
    pub(crate) fn refuse(&self, py: Python<'_>, problem: &SceneProblem) -> PyErr {
        errors::placed(py, self.text.as_ref(), problem)
    }

    /// Builds bodies and interactions.
    pub(crate) fn build(&self, py: Python<'_>) -> PyResult<Arc<Assembly>> {
        let built = py.detach(|| actin_rundir::build(&self.inner));
        built.map(Arc::new).map_err(|p| self.refuse(py, &p))
    }
}

#[pymethods]
impl Scene {
    #[new]
    #[pyo3(signature = (**keys))]
    fn new(py: Python<'_>, keys: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let value = match keys {
            Some(keys) => from_python(keys.as_any())?,
            None => SceneValue::keys(Vec::new()),
        };
        Self::of_value(py, &value, Some(Path::new("")))
    }

    /// Creates a scene from a dictionary. Paths of point files are relative to `folder`.
    #[staticmethod]
    #[pyo3(signature = (keys, folder = PathBuf::new()))]
    fn from_dict(py: Python<'_>, keys: &Bound<'_, PyMapping>, folder: PathBuf) -> PyResult<Self> {
        Self::of_value(py, &from_python(keys.as_any())?, Some(&folder))
    }

    /// Creates a scene from the text of a scene file.
    #[staticmethod]
    #[pyo3(signature = (text, folder = PathBuf::new()))]
    fn from_ron(py: Python<'_>, text: &str, folder: PathBuf) -> PyResult<Self> {
        Self::of_text(py, text, String::new(), &folder)
    }

    /// Reads a scene file.
    #[staticmethod]
    fn from_file(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        Self::read(py, &path)
    }

    /// Returns the text of the scene, with all defaults.
    fn to_ron(&self) -> String {
        self.inner.to_ron()
    }

    /// Returns the keys of the scene, with defaults except omitted ones.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_python(py, &self.inner.to_value())
    }

    /// Returns the scene with another value of a key: `scene.set("loads[0].force_pn[0]", -1.0)`.
    ///
    /// Arrangements and sets of linkers are made again. A key of a filament or linker that they made, such as
    /// `linkers[3].rest_length_nm`, changes no other key.
    fn set(&self, py: Python<'_>, key: &str, value: &Bound<'_, PyAny>) -> PyResult<Self> {
        let value = from_python(value)?;
        let changed = |mut all: SceneValue| all.set(key, value.clone()).map(|()| all);
        let mut refused = None;
        if let Some((keys, folder)) = &self.arranged {
            match changed(keys.clone()) {
                Ok(all) => return Self::of_value(py, &all, folder.as_deref()),
                Err(problem) => refused = Some(problem),
            }
        }
        let all = changed(self.inner.to_value());
        let all = all.map_err(|problem| errors::problem(py, &refused.unwrap_or(problem)))?;
        Self::of_value(py, &all, Some(Path::new("")))
    }

    /// Returns the scene with all its seeds set.
    fn reseed(&self, py: Python<'_>, seed: u64) -> PyResult<Self> {
        let mut inner = self.inner.clone();
        let drawn: usize = RandomPart::ALL
            .iter()
            .map(|&what| inner.reseed(what, seed))
            .sum();
        if drawn == 0 {
            let rule = "the scene has nothing random (sampled bonds, thermal noise, imperfections, linker events)";
            let problem = SceneProblem::new("seed", seed, rule);
            return Err(errors::problem(py, &problem));
        }
        Ok(inner.into())
    }

    /// Resolves the scene and estimates its cost. Writes nothing.
    ///
    /// Keys: `scene` (with time step), `counts`, `time_step_ns` and `steps` of a motion, `cost`, `notes`, and run
    /// times on one core, measured for up to 0.2 s: `seconds_per_step` and `seconds` of the whole run, which are
    /// `None` for an equilibrium that takes longer.
    fn check<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let assembly = self.build(py)?;
        let plan = py.detach(|| Plan::new(&assembly));
        let plan = plan.map_err(|problem| self.refuse(py, &problem))?;
        let found = PyDict::new(py);
        found.set_item("scene", Self::from(plan.scene().clone()))?;
        found.set_item("counts", counts(py, &assembly)?)?;
        if let Some(estimate) = plan.estimate() {
            found.set_item("time_step_ns", estimate.time_step_ns)?;
            found.set_item("steps", estimate.steps)?;
        }
        let timing = py.detach(|| plan.timing());
        found.set_item("seconds", timing.and_then(|timing| timing.total_s))?;
        found.set_item("seconds_per_step", timing.map(|timing| timing.step_s))?;
        let time = timing.map_or_else(String::new, |timing| format!("; {timing}"));
        found.set_item("cost", format!("{}{time}", plan.cost()))?;
        let notes = [assembly.notes(), plan.notes()].concat();
        let warnings: Vec<_> = notes.iter().filter(|note| note.code.is_some()).collect();
        let warnings = serde_json::to_string(&warnings).map_err(errors::value)?;
        let warnings = py.import("json")?.call_method1("loads", (warnings,))?;
        found.set_item("warnings", warnings)?;
        let texts: Vec<_> = notes.into_iter().map(|note| note.message).collect();
        found.set_item("notes", texts)?;
        Ok(found)
    }

    /// Title of the scene.
    #[getter]
    fn title(&self) -> &str {
        &self.inner.title
    }

    /// Kind of computation.
    #[getter]
    pub(crate) fn task(&self) -> &'static str {
        match self.inner.task {
            actin_sim::Task::Dynamics(_) => "Dynamics",
            actin_sim::Task::Brownian(_) => "Brownian",
            actin_sim::Task::Equilibrium(_) => "Equilibrium",
        }
    }

    fn __repr__(&self) -> String {
        let filaments = self.inner.filaments().count();
        let title = match self.inner.title.as_str() {
            "" => String::new(),
            title => format!("{title:?}, "),
        };
        let plural = if filaments == 1 { "" } else { "s" };
        format!(
            "Scene({title}{filaments} filament{plural}, {})",
            self.task()
        )
    }

    fn __str__(&self, py: Python<'_>) -> PyResult<String> {
        let table = py.import("actin_filaments._scene")?;
        table.call_method1("text", (self.to_dict(py)?,))?.extract()
    }

    fn _repr_html_(slf: &Bound<'_, Self>) -> PyResult<String> {
        let html = slf.py().import("actin_filaments._scene")?;
        html.call_method1("html", (slf,))?.extract()
    }

    /// Returns the HTML page of the initial state.
    fn _page(&self, py: Python<'_>) -> PyResult<String> {
        let run = py.detach(|| actin_view::Run::initial(&self.inner));
        let run = run.map_err(|problem| self.refuse(py, &problem))?;
        Ok(py.detach(|| run.page(actin_view::Palette::default())))
    }

    /// Returns the scene with other values: `scene.with_({"linkers[*].stiffness_pn_per_nm": 2.0}, title="stiff")`.
    ///
    /// A key is a path as in `set`, or has `[*]` for all elements of a list.
    #[pyo3(signature = (changes = None, /, **keys))]
    fn with_(
        slf: &Bound<'_, Self>,
        changes: Option<&Bound<'_, PyAny>>,
        keys: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Py<PyAny>> {
        let module = slf.py().import("actin_filaments._scene")?;
        Ok(module.call_method1("with_", (slf, changes, keys))?.unbind())
    }

    /// Returns the initial state as an interactive page, which a notebook shows.
    fn view(slf: &Bound<'_, Self>) -> PyResult<Py<PyAny>> {
        let module = slf.py().import("actin_filaments._page")?;
        Ok(module.call_method1("of_scene", (slf,))?.unbind())
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (String,))> {
        let read = py.get_type::<Self>().getattr("from_ron")?;
        Ok((read, (self.to_ron(),)))
    }
}

/// Returns copies of the keys and of the folder if there are arrangements or sets of linkers.
fn arranged(scene: &SceneValue, folder: Option<&Path>) -> Option<(SceneValue, Option<PathBuf>)> {
    let SceneKind::Group(_, values) = scene.kind() else {
        return None;
    };
    let is_made = |key| matches!(key, "arrangements" | "linker_sets");
    let mut keys = values.iter().filter_map(SceneValue::key);
    keys.any(is_made)
        .then(|| (scene.clone(), folder.map(Path::to_path_buf)))
}

/// Returns the numbers of bodies and degrees of freedom by name.
pub(crate) fn counts<'py>(py: Python<'py>, assembly: &Assembly) -> PyResult<Bound<'py, PyDict>> {
    let counts = assembly.counts();
    let numbers = PyDict::new(py);
    for (name, number) in [
        ("monomers", counts.monomers),
        ("bonds", counts.bonds),
        ("segments", counts.segments),
        ("junctions", counts.junctions),
        ("dofs", counts.dofs),
    ] {
        numbers.set_item(name, number)?;
    }
    Ok(numbers)
}

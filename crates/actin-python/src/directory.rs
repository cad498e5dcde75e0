//! Pages, exports, profiles and unfinished records of run directories.

use crate::arrays::column;
use crate::errors;
use crate::records::{arrays, bodies};
use crate::scene::{Scene, counts};
use actin_export::{RecordedStates, VtkPictures, write_collection};
use actin_rundir::{Checkpoints, FinishedRun, Format, RunDirectory};
use actin_sim::{Plan, shape, shape::ProfilePoint};
use actin_view::{Limits, Palette};
use pyo3::exceptions::{PyIndexError, PyOSError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::fs::File;
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// Returns the JSON schema of scenes.
#[pyfunction]
pub(crate) fn scene_schema() -> String {
    actin_sim::schema().to_string()
}

/// Returns the HTML page of a run directory, which may be unfinished.
#[pyfunction]
pub(crate) fn page(py: Python<'_>, directory: PathBuf) -> PyResult<String> {
    let opened = py.detach(|| actin_view::Run::open(&directory, Limits::default()));
    let run = opened.map_err(errors::value)?;
    if run.has_changing_resolution() {
        let rule =
            "the resolution of this run changes with time, and a page shows one resolution only";
        return Err(PyValueError::new_err(rule));
    }
    Ok(py.detach(|| run.page(Palette::default())))
}

/// Exports a run directory to `gsd`, `simularium` or `vtk`, and returns the written files.
#[pyfunction]
pub(crate) fn export(
    directory: PathBuf,
    format: &str,
    out: PathBuf,
    overwrite: bool,
) -> PyResult<Vec<PathBuf>> {
    let run = opened(&directory)?;
    let format = match format {
        "gsd" => Format::Gsd,
        "simularium" => Format::Simularium,
        _ => {
            return pictures(&run, &out, overwrite).map_err(|error| io_error(&out, &error));
        }
    };
    let written = actin_rundir::export(&run, format, &out, overwrite);
    written.map_err(|error| errors::directory(&error))
}

/// Name and value of a field along a filament.
type Field = (&'static str, fn(&ProfilePoint) -> f64);

const FIELDS: [Field; 8] = [
    ("s_nm", |p| p.s_nm),
    ("curvature_rad_per_nm", |p| p.curvature_rad_per_nm),
    ("twist_rad_per_nm", |p| p.twist_rad_per_nm),
    ("energy_per_length_pn", |p| p.energy_per_length_pn),
    ("tension_pn", |p| p.load.tension_pn()),
    ("shear_pn", |p| p.load.shear_pn()),
    ("moment_pn_nm", |p| p.load.bending_moment_pn_nm()),
    ("torque_pn_nm", |p| p.load.torque_pn_nm()),
];

/// Returns the fields along all filaments in a record, by name.
#[pyfunction]
pub(crate) fn profile(py: Python<'_>, directory: PathBuf, record: usize) -> PyResult<Py<PyDict>> {
    let run = opened(&directory)?;
    let mut states = run.states().map_err(|error| errors::directory(&error))?;
    let Some(state) = states.nth(record) else {
        let rule = format!("record {record} of {} does not exist", run.count());
        return Err(PyIndexError::new_err(rule));
    };
    let state = state.map_err(|error| errors::directory(&error))?;
    let filaments = 0..run.assembly().filaments.len();
    let points = filaments.flat_map(|filament| {
        let points = shape::profile_of(run.assembly(), filament, &state).into_iter();
        points.map(move |point| (filament as f64, point))
    });
    let points: Vec<(f64, ProfilePoint)> = points.collect();
    let all = PyDict::new(py);
    let filaments = points.iter().map(|(filament, _)| *filament).collect();
    all.set_item("filament", column(py, filaments)?)?;
    for (name, field) in FIELDS {
        let values = points.iter().map(|(_, point)| field(point)).collect();
        all.set_item(name, column(py, values)?)?;
    }
    Ok(all.unbind())
}

/// Returns the scene, the counts and the records of a run directory with a checkpoint and without results.
#[pyfunction]
pub(crate) fn unfinished(py: Python<'_>, directory: PathBuf) -> PyResult<Py<PyDict>> {
    let scene = Scene::read(py, &directory.join("scene.ron"))?;
    let assembly = scene.build(py)?;
    let plan = Plan::new(&assembly).map_err(|problem| scene.refuse(py, &problem))?;
    let never = Arc::new(AtomicBool::new(false));
    let directory = RunDirectory::existing(&directory);
    let mut records = Checkpoints::new(&directory, &plan, Duration::MAX, never, |_| {});
    records.resume(&plan).map_err(errors::value)?;
    let found = PyDict::new(py);
    found.set_item("counts", counts(py, &assembly)?)?;
    found.set_item("arrays", arrays(py, &assembly, &records)?)?;
    found.set_item("bodies", bodies(py, &assembly)?)?;
    found.set_item("scene", scene)?;
    Ok(found.unbind())
}

fn opened(directory: &Path) -> PyResult<FinishedRun> {
    FinishedRun::open(directory).map_err(|error| errors::directory(&error))
}

fn io_error(path: &Path, error: &io::Error) -> PyErr {
    PyOSError::new_err(format!("{}: {error}", path.display()))
}

/// Writes each state as a `.vtp` file into a folder, and the collection `run.pvd`.
fn pictures(run: &FinishedRun, folder: &Path, overwrite: bool) -> io::Result<Vec<PathBuf>> {
    std::fs::create_dir_all(folder)?;
    let create = |name: &str| {
        let path = folder.join(name);
        let mut options = File::options();
        let options = options.write(true).truncate(true);
        let options = if overwrite {
            options.create(true)
        } else {
            options.create_new(true)
        };
        options.open(&path).map(|file| (path, BufWriter::new(file)))
    };
    let writer = VtkPictures::new(run.assembly());
    let (mut files, mut names) = (Vec::new(), Vec::new());
    for ((i, &at), state) in run.at().iter().enumerate().zip(RecordedStates::states(run)) {
        let name = format!("{i:04}.vtp");
        let (path, mut out) = create(&name)?;
        writer.write(at, state?.as_ref(), &mut out)?;
        files.push(path);
        names.push(Ok((at.value(), name)));
    }
    let (path, mut out) = create("run.pvd")?;
    write_collection(&run.assembly().scene.title, names.into_iter(), &mut out)?;
    files.push(path);
    Ok(files)
}

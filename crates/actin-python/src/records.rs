//! Records of a run as arrays, collected in one pass.

use crate::arrays::{Block, column, indices};
use actin_rundir::StateArray;
use actin_sim::{Assembly, BodyKind, Records, Row, observed_columns};
use pyo3::prelude::*;
use pyo3::types::PyDict;

type Column = (&'static str, fn(&Row) -> f64);

const COLUMNS: [Column; 4] = [
    ("at", |row| row.at.value()),
    ("kinetic_pn_nm", |row| row.kinetic_pn_nm),
    ("residual_force_pn", |row| row.residual_force_pn),
    ("residual_torque_pn_nm", |row| row.residual_torque_pn_nm),
];

/// Returns a dictionary with arrays of all records.
pub(crate) fn arrays(
    py: Python<'_>,
    assembly: &Assembly,
    records: &dyn Records,
) -> PyResult<Py<PyDict>> {
    let mut arrays = StateArray::ALL.map(|_| Vec::new());
    let (mut rows, mut states) = (Vec::new(), 0);
    for record in records.iter() {
        let record = record?;
        if let Some(state) = &record.state {
            for (values, array) in arrays.iter_mut().zip(StateArray::ALL) {
                values.extend(array.values(assembly, state));
            }
            states += 1;
        }
        rows.push(record.row);
    }
    let all = PyDict::new(py);
    for (values, array) in arrays.into_iter().zip(StateArray::ALL) {
        let [bodies, components] = array.shape(assembly);
        let block = Block::new(values, &[states, bodies, components]);
        all.set_item(array.name, block.into_python(py)?)?;
    }
    for (name, of) in COLUMNS {
        let values = rows.iter().map(|row| of(row)).collect();
        all.set_item(name, column(py, values)?)?;
    }
    let energies = rows.iter().flat_map(|row| row.energies_pn_nm.iter());
    let energies = Block::new(
        energies.copied().collect(),
        &[rows.len(), assembly.terms.len()],
    );
    all.set_item("energies", energies.into_python(py)?)?;
    let observed = rows.iter().flat_map(|row| row.observed.iter());
    let observed = Block::new(
        observed.copied().collect(),
        &[rows.len(), observed_columns(assembly).len()],
    );
    all.set_item("observed", observed.into_python(py)?)?;
    Ok(all.unbind())
}

/// Returns the constant properties of the bodies.
pub(crate) fn bodies(py: Python<'_>, assembly: &Assembly) -> PyResult<Py<PyDict>> {
    let all = PyDict::new(py);
    let (points, frames) = (&assembly.points, &assembly.frames);
    all.set_item("s_nm", column(py, points.iter().map(|p| p.s_nm).collect())?)?;
    all.set_item(
        "frame_s_nm",
        column(py, frames.iter().map(|f| f.s_nm).collect())?,
    )?;
    let kinds = BodyKind::ALL.map(BodyKind::name).to_vec();
    all.set_item("kind_names", kinds)?;
    let frame_of = |frame: Option<usize>| frame.map_or(-1, whole);
    let of_points = |i| whole(assembly.filament_of_point(i));
    let of_frames = |i| whole(assembly.filament_of_frame(i));
    let columns: [(&str, Vec<i64>); 5] = [
        ("kind", points.iter().map(|p| p.kind as i64).collect()),
        ("frame_kind", frames.iter().map(|f| f.kind as i64).collect()),
        ("filament", (0..points.len()).map(of_points).collect()),
        ("frame_filament", (0..frames.len()).map(of_frames).collect()),
        ("frame", points.iter().map(|p| frame_of(p.frame)).collect()),
    ];
    for (name, numbers) in columns {
        all.set_item(name, indices(py, &numbers)?)?;
    }
    let axes = |i| {
        let filament = assembly.filament_of_point(i);
        assembly.monomers_of(filament).semi_axes_nm
    };
    let axes: Vec<f64> = (0..points.len()).flat_map(axes).collect();
    let axes = Block::new(axes, &[points.len(), 3]);
    all.set_item("semi_axes_nm", axes.into_python(py)?)?;
    let terms = assembly.terms.iter().map(|term| term.name);
    all.set_item("terms", terms.collect::<Vec<_>>())?;
    all.set_item("columns", observed_columns(assembly))?;
    Ok(all.unbind())
}

fn whole(index: usize) -> i64 {
    i64::try_from(index).expect("memory holds fewer bodies")
}

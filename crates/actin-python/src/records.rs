//! Records of a run as arrays, collected in one pass.

use crate::arrays::{Block, column, indices};
use actin_mechanics::State;
use actin_sim::{Assembly, BodyKind, Record, Records};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::io;

type Component = fn(&State) -> &[f64];

/// A quantity of points or frames: its name, true for points, and its components.
type Field = (&'static str, bool, &'static [Component]);

const FIELDS: [Field; 4] = [
    (
        "position_nm",
        true,
        &[
            |s| &s.points.position.x,
            |s| &s.points.position.y,
            |s| &s.points.position.z,
        ],
    ),
    (
        "velocity_nm_per_ns",
        true,
        &[
            |s| &s.points.velocity.x,
            |s| &s.points.velocity.y,
            |s| &s.points.velocity.z,
        ],
    ),
    (
        "quaternion",
        false,
        &[
            |s| &s.frames.orientation.w,
            |s| &s.frames.orientation.x,
            |s| &s.frames.orientation.y,
            |s| &s.frames.orientation.z,
        ],
    ),
    (
        "angular_momentum",
        false,
        &[
            |s| &s.frames.angular_momentum.x,
            |s| &s.frames.angular_momentum.y,
            |s| &s.frames.angular_momentum.z,
        ],
    ),
];

/// Numbers of all records of a run.
#[derive(Debug)]
pub(crate) struct RecordArrays {
    /// Time (ns) or path parameter.
    at: Vec<f64>,
    fields: [Vec<f64>; 4],
    centre_line: Vec<f64>,
    energies: Vec<f64>,
    kinetic: Vec<f64>,
    residual_force: Vec<f64>,
    residual_torque: Vec<f64>,
    observed: Vec<f64>,
    /// Number of records with states.
    states: usize,
}

impl RecordArrays {
    /// Collects all records.
    ///
    /// # Errors
    /// If a record cannot be read.
    pub(crate) fn new(assembly: &Assembly, records: &dyn Records) -> io::Result<Self> {
        let mut all = Self {
            at: Vec::new(),
            fields: Default::default(),
            centre_line: Vec::new(),
            energies: Vec::new(),
            kinetic: Vec::new(),
            residual_force: Vec::new(),
            residual_torque: Vec::new(),
            observed: Vec::new(),
            states: 0,
        };
        for record in records.iter() {
            all.add_state(assembly, record?.as_ref());
        }
        for row in records.rows() {
            let row = row?;
            all.at.push(row.at.value());
            all.energies.extend(&row.energies_pn_nm);
            all.kinetic.push(row.kinetic_pn_nm);
            all.residual_force.push(row.residual_force_pn);
            all.residual_torque.push(row.residual_torque_pn_nm);
            all.observed.extend(&row.observed);
        }
        Ok(all)
    }

    fn add_state(&mut self, assembly: &Assembly, record: &Record) {
        for (values, (_, _, components)) in self.fields.iter_mut().zip(FIELDS) {
            for component in components {
                values.extend_from_slice(component(&record.state));
            }
        }
        let points = 0..assembly.points.len();
        let places: Vec<_> = points
            .map(|i| assembly.centre_line_nm(&record.state, i))
            .collect();
        for k in 0..3 {
            self.centre_line.extend(places.iter().map(|place| place[k]));
        }
        self.states += 1;
    }

    /// Converts to a dictionary of arrays.
    pub(crate) fn into_python(self, py: Python<'_>, assembly: &Assembly) -> PyResult<Py<PyDict>> {
        let all = PyDict::new(py);
        let (records, states) = (self.at.len(), self.states);
        let bodies = |of_points| {
            let (points, frames) = (assembly.points.len(), assembly.frames.len());
            if of_points { points } else { frames }
        };
        let block = |values, components, count| Block {
            values,
            shape: vec![states, components, count],
            axes: Some(vec![0, 2, 1]),
        };
        for (values, (name, of_points, components)) in self.fields.into_iter().zip(FIELDS) {
            let block = block(values, components.len(), bodies(of_points));
            all.set_item(name, block.into_python(py)?)?;
        }
        let centre_line = block(self.centre_line, 3, bodies(true)).into_python(py)?;
        all.set_item("centre_line_nm", centre_line)?;
        all.set_item("at", column(py, self.at)?)?;
        all.set_item("kinetic_pn_nm", column(py, self.kinetic)?)?;
        all.set_item("residual_force_pn", column(py, self.residual_force)?)?;
        all.set_item("residual_torque_pn_nm", column(py, self.residual_torque)?)?;
        let terms = assembly.terms.len();
        let energies = Block::new(self.energies, &[records, terms]);
        all.set_item("energies", energies.into_python(py)?)?;
        let columns = assembly.observed().len();
        let observed = Block::new(self.observed, &[records, columns]);
        all.set_item("observed", observed.into_python(py)?)?;
        Ok(all.unbind())
    }
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
    all.set_item("columns", assembly.observed().to_vec())?;
    Ok(all.unbind())
}

fn whole(index: usize) -> i64 {
    i64::try_from(index).expect("memory holds fewer bodies")
}

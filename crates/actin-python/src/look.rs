//! State, loads, energies and strains of a `System`, as arrays.

use crate::arrays::{Block, column, read, vectors};
use crate::rod::Rod;
use crate::system::System;
use crate::terms::rows;
use actin_cosserat::{BendingElement, ShearElement};
use actin_mechanics::{Interaction, State, UnitQuaternion, Vectors};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

#[pymethods]
impl System {
    /// Positions of points, `[n, 3]`, which can be set.
    #[getter]
    fn position<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        rows(py, &self.state().points.position)
    }

    #[setter]
    fn set_position(&mut self, position: &Bound<'_, PyAny>) -> PyResult<()> {
        self.set_vectors(position, "position", |state| &mut state.points.position)
    }

    /// Velocities of points, `[n, 3]`, which can be set.
    #[getter]
    fn velocity<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        rows(py, &self.state().points.velocity)
    }

    #[setter]
    fn set_velocity(&mut self, velocity: &Bound<'_, PyAny>) -> PyResult<()> {
        self.set_vectors(velocity, "velocity", |state| &mut state.points.velocity)
    }

    /// Orientations of frames, body to lab, `[m, 4]` in the order w, x, y, z. Can be set to unit quaternions.
    #[getter]
    fn quaternion(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        let all = self.state().frames.orientation.iter();
        let values: Vec<f64> = all.flat_map(|q| [q.w, q.i, q.j, q.k]).collect();
        let shape = [self.state().frames.len(), 4];
        Block::new(values, &shape).into_python(py)
    }

    #[setter]
    fn set_quaternion(&mut self, quaternion: &Bound<'_, PyAny>) -> PyResult<()> {
        let shape = [Some(self.state().frames.len()), Some(4)];
        let (values, _) = read(quaternion, "quaternion", &shape)?;
        let mut all = Vec::new();
        for (i, q) in values.chunks_exact(4).enumerate() {
            let q = nalgebra_quaternion(q);
            // A different length indicates a mistake in the data.
            if (q.norm() - 1.0).abs() > 1e-6 {
                let rule = format!("row {i} of quaternion must have length 1, not {}", q.norm());
                return Err(PyValueError::new_err(rule));
            }
            all.push(UnitQuaternion::from_quaternion(q));
        }
        let frames = &mut self.mechanics.state_mut().frames;
        for (i, q) in all.into_iter().enumerate() {
            frames.orientation.set(i, q);
        }
        Ok(())
    }

    /// Angular momenta of frames, body frame, `[m, 3]`, which can be set.
    #[getter]
    fn angular_momentum<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        rows(py, &self.state().frames.angular_momentum)
    }

    #[setter]
    fn set_angular_momentum(&mut self, angular_momentum: &Bound<'_, PyAny>) -> PyResult<()> {
        let name = "angular_momentum";
        self.set_vectors(angular_momentum, name, |state| {
            &mut state.frames.angular_momentum
        })
    }

    /// Masses of points, `[n]`.
    #[getter]
    fn mass(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        let points = &self.state().points;
        column(py, (0..points.len()).map(|i| points.mass(i)).collect())
    }

    /// True for each free point.
    #[getter]
    fn free_points(&self) -> Vec<bool> {
        let points = &self.state().points;
        (0..points.len()).map(|i| points.is_free(i)).collect()
    }

    /// True for each free frame.
    #[getter]
    fn free_frames(&self) -> Vec<bool> {
        let frames = &self.state().frames;
        (0..frames.len()).map(|i| frames.is_free(i)).collect()
    }

    /// Returns the total forces on points (lab frame) and torques on frames (body frame).
    fn loads<'py>(&mut self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let loads = self.mechanics.loads();
        let found = (rows(py, &loads.force)?, rows(py, &loads.torque)?);
        self.raise()?;
        Ok(found)
    }

    /// Returns the potential energy of each term.
    fn energies<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for (term, energy) in self.terms.values().zip(self.mechanics.energies()) {
            let before: f64 = match all.get_item(term.term())? {
                Some(before) => before.extract()?,
                None => 0.0,
            };
            all.set_item(term.term(), before + energy)?;
        }
        self.raise()?;
        Ok(all)
    }

    /// Kinetic energy of the free bodies.
    #[getter]
    fn kinetic_energy(&self) -> f64 {
        self.state().kinetic_energy()
    }

    /// Potential energy of all terms.
    #[getter]
    fn potential_energy(&self) -> f64 {
        self.mechanics.potential_energy()
    }

    /// Simulated time.
    #[getter]
    fn time(&self) -> f64 {
        self.clock.time()
    }

    /// Number of time steps made.
    #[getter]
    fn steps(&self) -> u64 {
        self.clock.steps
    }

    /// Returns the curvature of a rod at its joints, body frame, `[joints, 3]`: two of bending, one of twist.
    fn curvature(&self, py: Python<'_>, rod: &Bound<'_, Rod>) -> PyResult<Py<PyAny>> {
        let layout = &rod.get().layout;
        self.frame(layout.bending_chain().end - 1)?;
        let q = |i| self.state().frames.orientation.get(i);
        let joints = layout.bending_chain().zip(layout.voronoi_lengths());
        let of_joint = |(a, &rest_distance): (usize, &f64)| {
            let kappa = BendingElement { rest_distance }.curvature(q(a), q(a + 1));
            [kappa.x, kappa.y, kappa.z]
        };
        let values: Vec<f64> = joints.flat_map(of_joint).collect();
        let shape = [values.len() / 3, 3];
        Block::new(values, &shape).into_python(py)
    }

    /// Returns the strain of a rod's segments, body frame, `[segments, 3]`: two of shear, one of stretch.
    fn strain(&self, py: Python<'_>, rod: &Bound<'_, Rod>) -> PyResult<Py<PyAny>> {
        let layout = &rod.get().layout;
        self.point(layout.points().end - 1)?;
        let state = self.state();
        let segments = layout
            .points()
            .zip(layout.frames())
            .zip(layout.segment_lengths());
        let of_segment = |((i, frame), &length): ((usize, usize), &f64)| {
            let x = &state.points.position;
            let q = state.frames.orientation.get(frame);
            let sigma = ShearElement::segment(length).strain(q, x.get(i + 1) - x.get(i));
            [sigma.x, sigma.y, sigma.z]
        };
        let values: Vec<f64> = segments.flat_map(of_segment).collect();
        let shape = [values.len() / 3, 3];
        Block::new(values, &shape).into_python(py)
    }

    fn __repr__(&self) -> String {
        let state = self.state();
        let mut names: Vec<&str> = Vec::new();
        for term in self.terms.values() {
            if !names.contains(&term.term()) {
                names.push(term.term());
            }
        }
        format!(
            "System({} points, {} frames; {}; time {})",
            state.points.len(),
            state.frames.len(),
            names.join(", "),
            self.clock.time()
        )
    }
}

impl System {
    fn set_vectors(
        &mut self,
        object: &Bound<'_, PyAny>,
        name: &str,
        of: impl Fn(&mut State) -> &mut Vectors,
    ) -> PyResult<()> {
        let all = vectors(object, name)?;
        let count = of(self.mechanics.state_mut()).len();
        if all.len() != count {
            let given = all.len();
            return Err(PyValueError::new_err(format!(
                "{name} must have {count} rows, not {given}"
            )));
        }
        let target = of(self.mechanics.state_mut());
        for (i, v) in all.into_iter().enumerate() {
            target.set(i, v.into());
        }
        Ok(())
    }
}

/// Creates a quaternion from (w, x, y, z).
fn nalgebra_quaternion(q: &[f64]) -> nalgebra::Quaternion<f64> {
    nalgebra::Quaternion::new(q[0], q[1], q[2], q[3])
}

//! Rods of a `System`.

use crate::errors;
use crate::terms::Term;
use actin_cosserat::{
    CrossSection, End, EnergyGradient, Rigidities, RodClamp, RodElements, RodLayout, RodMaterial,
    RotaryInertia, StraightRod, Walls,
};
use actin_mechanics::{Interaction, Matrix3, State, UnitQuaternion, Vector3};
use nalgebra::Rotation3;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::sync::Arc;

/// Indices of a rod's bodies in a `System`.
#[pyclass(module = "actin_filaments", frozen)]
#[derive(Debug)]
pub(crate) struct Rod {
    pub(crate) layout: RodLayout,
}

#[pymethods]
impl Rod {
    /// First point, and one past the last.
    #[getter]
    fn points(&self) -> (usize, usize) {
        let points = self.layout.points();
        (points.start, points.end)
    }

    /// First frame of a segment, and one past the last; frames of walls are not included.
    #[getter]
    fn frames(&self) -> (usize, usize) {
        let frames = self.layout.frames();
        (frames.start, frames.end)
    }

    /// Fixed frame before the first segment, if there is a wall.
    #[getter]
    fn start_wall(&self) -> Option<usize> {
        self.layout.wall(End::Start)
    }

    /// Fixed frame after the last segment, if there is a wall.
    #[getter]
    fn end_wall(&self) -> Option<usize> {
        self.layout.wall(End::End)
    }

    /// Rest length.
    #[getter]
    fn length(&self) -> f64 {
        self.layout.length()
    }

    fn __repr__(&self) -> String {
        format!(
            "Rod({} segments, length {})",
            self.layout.segments(),
            self.layout.length()
        )
    }
}

/// Arguments of a new rod.
#[derive(Debug)]
pub(crate) struct RodArguments<'a> {
    pub(crate) nodes: Vec<[f64; 3]>,
    pub(crate) shear: [f64; 3],
    pub(crate) bend: [f64; 3],
    /// Mass per length, and area.
    pub(crate) section: [f64; 2],
    pub(crate) lengths: Option<Vec<f64>>,
    pub(crate) normal: Option<[f64; 3]>,
    pub(crate) clamps: [Option<&'a str>; 2],
    pub(crate) rest_shape: &'a str,
    pub(crate) rigid_segments: bool,
}

fn clamp(name: &str) -> PyResult<RodClamp> {
    match name {
        "Wall" => Ok(RodClamp::Wall),
        "NodeAndFrame" => Ok(RodClamp::NodeAndFrame),
        "TwoNodesAndFrame" => Ok(RodClamp::TwoNodesAndFrame),
        "Pin" => Ok(RodClamp::Pin),
        other => Err(PyValueError::new_err(format!(
            "no clamp is called {other:?}: expected one of Wall, NodeAndFrame, TwoNodesAndFrame, Pin"
        ))),
    }
}

/// Returns the frame with third axis `tangent` and first axis as close to `normal` as possible.
fn orientation(tangent: Vector3, normal: Option<[f64; 3]>) -> PyResult<UnitQuaternion> {
    let d3 = tangent.try_normalize(0.0);
    let d3 = d3.ok_or_else(|| PyValueError::new_err("the first two nodes coincide"))?;
    // Without a normal, a coordinate axis that is not parallel to the rod.
    let least = if d3.x.abs() < 0.9 {
        Vector3::x()
    } else {
        Vector3::y()
    };
    let across: Vector3 = normal.map_or(least, Vector3::from);
    let d1 = (across - d3 * d3.dot(&across)).try_normalize(1e-9 * across.norm());
    let d1 =
        d1.ok_or_else(|| PyValueError::new_err("normal must not be along the first segment"))?;
    let axes = Matrix3::from_columns(&[d1, d3.cross(&d1), d3]);
    Ok(UnitQuaternion::from_rotation_matrix(
        &Rotation3::from_matrix_unchecked(axes),
    ))
}

impl RodArguments<'_> {
    /// Adds the rod to a state; returns its interaction and its indices.
    pub(crate) fn put(self, state: &mut State) -> PyResult<(Option<Term>, Rod)> {
        let nodes: Vec<Vector3> = self.nodes.iter().map(|&place| place.into()).collect();
        if nodes.len() < 2 {
            return Err(PyValueError::new_err("a rod needs at least two nodes"));
        }
        let [start, end] = self.clamps.map(|name| name.map(clamp).transpose());
        let clamps = [(End::Start, start?), (End::End, end?)];
        let needs_wall = |k: usize| clamps[k].1.is_some_and(RodClamp::needs_wall);
        let rod = StraightRod {
            start: nodes[0],
            orientation: orientation(nodes[1] - nodes[0], self.normal)?,
            segment_lengths: self.rest_lengths(&nodes)?,
            cross_section: CrossSection::new(self.section[0], self.section[1])
                .map_err(errors::value)?,
            rotary_inertia: if self.rigid_segments {
                RotaryInertia::RigidSegment
            } else {
                RotaryInertia::CrossSection
            },
            walls: Walls {
                start: needs_wall(0),
                end: needs_wall(1),
            },
            free_walls: Walls::default(),
        };
        let layout = rod.push(state).map_err(errors::value)?;
        layout.place(state, &nodes).map_err(errors::value)?;
        for (end, clamp) in clamps {
            if let Some(clamp) = clamp {
                clamp.hold(&layout, end, state).map_err(errors::value)?;
            }
        }
        let law = self.law(state, &layout)?;
        Ok((Some(Term::Own(law)), Rod { layout }))
    }

    fn rest_lengths(&self, nodes: &[Vector3]) -> PyResult<Vec<f64>> {
        let distances = nodes.windows(2).map(|pair| (pair[1] - pair[0]).norm());
        match &self.lengths {
            None => Ok(distances.collect()),
            Some(lengths) if lengths.len() + 1 == nodes.len() => Ok(lengths.clone()),
            Some(lengths) => Err(PyValueError::new_err(format!(
                "lengths must have one number for each of {} segments, not {}",
                nodes.len() - 1,
                lengths.len()
            ))),
        }
    }

    fn law(&self, state: &State, layout: &RodLayout) -> PyResult<Arc<dyn Interaction>> {
        let rigidities = Rigidities {
            shear: self.shear.into(),
            bend: self.bend.into(),
        };
        let material = RodMaterial::new(rigidities).map_err(errors::value)?;
        match self.rest_shape {
            "straight" => Ok(Arc::new(EnergyGradient::new(layout.clone(), material))),
            "placed" => {
                let law = RodElements::at_rest(state, layout, material);
                Ok(Arc::new(law.map_err(errors::value)?))
            }
            other => Err(PyValueError::new_err(format!(
                "rest_shape must be \"straight\" or \"placed\", not {other:?}"
            ))),
        }
    }
}

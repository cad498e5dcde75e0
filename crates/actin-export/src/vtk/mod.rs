//! Records as VTK pictures: rods as lines, monomers as vertices, with a frame at each point.
//!
//! In `ParaView`, "3D Glyphs" of a sphere of radius 1 show monomers as ellipsoids, with orientation
//! mode Quaternion, orientation array `orientation` and scale array `semi_axes_nm` (by vector
//! components). Tubes show rods. [`PARAVIEW_SCRIPT`] sets up both. The field array `kind_names` contains the
//! names of the codes of `kind`.

mod poly_data;
mod xml;

use actin_sim::mechanics::{State, UnitQuaternion, Vector3};
use actin_sim::{Assembly, At, BodyKind};
use poly_data::{Array, PolyData, Values};
use std::io::{self, Write};

/// Python script that shows a run in `ParaView`.
pub const PARAVIEW_SCRIPT: &str = include_str!("open_in_paraview.py");

/// Writer of the states of an assembly as `.vtp` files.
#[derive(Debug)]
pub struct VtkPictures<'a> {
    assembly: &'a Assembly,
    /// Section index of each point, counted over all filaments.
    section: Vec<Option<usize>>,
    /// Frame shown at each point: that of the monomer, or of a segment next to the node.
    frame: Vec<Option<usize>>,
}

impl<'a> VtkPictures<'a> {
    /// Creates the writer for states of `assembly`.
    pub fn new(assembly: &'a Assembly) -> Self {
        let mut section = vec![None; assembly.points.len()];
        for (index, span) in assembly.sections.iter().enumerate() {
            section[span.points.clone()].fill(Some(index));
        }
        let points = 0..assembly.points.len();
        let frame = points.map(|i| assembly.frame_of_point(i)).collect();
        Self {
            assembly,
            section,
            frame,
        }
    }

    /// Writes a state at a time (ns) or path parameter.
    ///
    /// # Errors
    /// If `out` returns an error.
    pub fn write(&self, at: At, state: &State, out: &mut impl Write) -> io::Result<()> {
        let turns: Vec<UnitQuaternion> = self
            .frame
            .iter()
            .map(|frame| {
                frame.map_or_else(UnitQuaternion::identity, |f| {
                    state.frames.orientation.get(f)
                })
            })
            .collect();
        let arrays = self.fixed_arrays().into_iter().chain(frame_arrays(&turns));
        let picture = PolyData {
            time: at.value(),
            texts: vec![("kind_names", BodyKind::ALL.map(BodyKind::name).into())],
            points: flat(state.points.position.iter()),
            arrays: arrays.collect(),
            vertices: self.vertices(),
            lines: self.lines(),
        };
        picture.write(out)
    }

    fn fixed_arrays(&self) -> [Array; 5] {
        let points = &self.assembly.points;
        [
            array(
                "kind",
                1,
                Values::UInt8(points.iter().map(|p| p.kind as u8).collect()),
            ),
            array("section", 1, Values::Int64(self.sections())),
            array("filament", 1, Values::Int64(self.filaments())),
            array(
                "s_nm",
                1,
                Values::Float64(points.iter().map(|p| p.s_nm).collect()),
            ),
            array("semi_axes_nm", 3, Values::Float64(self.semi_axes_nm())),
        ]
    }

    /// Section index of each point within its filament; -1 without a section.
    fn sections(&self) -> Vec<i64> {
        let within = |section: usize| {
            let filament = self.assembly.filament_of_section(section);
            section - self.assembly.filaments[filament].sections.start
        };
        let index = |s: &Option<usize>| s.map_or(-1, |s| poly_data::to_i64(within(s)));
        self.section.iter().map(index).collect()
    }

    fn filaments(&self) -> Vec<i64> {
        let spans = self.assembly.filaments.iter().enumerate();
        spans
            .flat_map(|(i, span)| vec![poly_data::to_i64(i); span.points.len()])
            .collect()
    }

    /// Semi-axes along d1, d2 and d3 (nm); zero for nodes.
    fn semi_axes_nm(&self) -> Vec<f64> {
        let assembly = self.assembly;
        let spans = assembly.filaments.iter().enumerate();
        spans
            .flat_map(|(i, span)| {
                let monomer = assembly.monomers_of(i).semi_axes_nm;
                let points = assembly.points[span.points.clone()].iter();
                points.flat_map(move |point| match point.kind {
                    BodyKind::Monomer => monomer,
                    _ => [0.0; 3],
                })
            })
            .collect()
    }

    fn vertices(&self) -> Vec<usize> {
        let is_monomer = |i: &usize| self.assembly.points[*i].kind == BodyKind::Monomer;
        (0..self.assembly.points.len()).filter(is_monomer).collect()
    }

    fn lines(&self) -> Vec<std::ops::Range<usize>> {
        let rods = self.assembly.sections.iter().filter(|s| !s.is_ellipsoids());
        rods.map(|section| section.points.clone()).collect()
    }
}

/// Orientations as quaternions (w, x, y, z; body to lab) and as body axes in the lab frame.
fn frame_arrays(turns: &[UnitQuaternion]) -> [Array; 4] {
    let quaternions = turns.iter().flat_map(|q| [q.w, q.i, q.j, q.k]).collect();
    let axis = |e: Vector3| Values::Float64(flat(turns.iter().map(move |q| q * e)));
    [
        array("orientation", 4, Values::Float64(quaternions)),
        array("d1", 3, axis(Vector3::x())),
        array("d2", 3, axis(Vector3::y())),
        array("d3", 3, axis(Vector3::z())),
    ]
}

fn array(name: &'static str, components: usize, values: Values) -> Array {
    Array {
        name,
        components,
        values,
    }
}

fn flat(vectors: impl Iterator<Item = Vector3>) -> Vec<f64> {
    vectors.flat_map(|v| [v.x, v.y, v.z]).collect()
}

/// Writes the collection file (`.pvd`) from the times (ns) and relative paths of `pictures`.
///
/// # Errors
/// If a time cannot be read, or `out` returns an error.
pub fn write_collection(
    title: &str,
    pictures: impl Iterator<Item = io::Result<(f64, String)>>,
    out: &mut impl Write,
) -> io::Result<()> {
    let title = xml::escape(title);
    out.write_all(
        b"<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n",
    )?;
    for picture in pictures {
        let (time_ns, file) = picture?;
        let file = xml::escape(&file);
        writeln!(
            out,
            r#"<DataSet timestep="{time_ns:?}" group="" part="0" name="{title}" file="{file}"/>"#
        )?;
    }
    out.write_all(b"</Collection>\n</VTKFile>\n")
}

#[cfg(test)]
mod fixture;
#[cfg(test)]
mod tests;

//! Export to GSD with the schema `hoomd`, version 1.4, one frame for each record.
//!
//! Units are nm, ns, ag (1e-21 kg) and ag nm^2.
//!
//! | array | contents |
//! |---|---|
//! | `particles/position`, `particles/velocity` | in each frame |
//! | `particles/orientation` | quaternion (w, x, y, z), in each frame |
//! | `particles/mass` | masses of monomers and nodes; 0 for ends of linkers |
//! | `particles/moment_inertia` | principal moments of monomers; 0 for nodes and ends of linkers |
//! | `configuration/step` | number of time steps; the record number for equilibria |
//! | `log/time_ns` or `log/path` | time, or path parameter of equilibria |
//! | `log/particles/s_nm`, `log/particles/filament` | arc length and filament; -1 for ends of linkers |
//!
//! Data that do not change are stored in the first frame only, as the schema specifies. The box is four times as
//! large as the run, so that periodic minimum images do not change distances.
//!
//! # Source
//! GSD documentation, "HOOMD schema" and "Shape visualization" (glotzerlab/gsd).

mod layer;

use crate::{BondKind, Particles, RecordedStates, Shape, extent};
use actin_sim::mechanics::{State, Vector3};
use actin_sim::{Assembly, At, Task};
use layer::{Chunk, Header, Writer};
use std::io::{self, Seek, Write};

const HEADER: Header = Header {
    application: concat!("actin ", env!("CARGO_PKG_VERSION")),
    schema: "hoomd",
    schema_version: (1, 4),
};

/// Writes a run as GSD.
///
/// # Errors
/// If the states cannot be read, or `out` returns an error.
pub(crate) fn write_gsd(
    particles: &Particles<'_>,
    states: &dyn RecordedStates,
    out: &mut (impl Write + Seek),
) -> io::Result<()> {
    let edges = extent::edges_nm(states, particles)?;
    let mut writer = Writer::new(out, &HEADER)?;
    for (i, (state, at)) in states.states().zip(states.at()).enumerate() {
        let state = state?;
        if i == 0 {
            write_fixed(&mut writer, particles, edges)?;
        }
        let step = step(particles.assembly(), i, at);
        writer.write("configuration/step", &Chunk::U64(vec![step]), 1)?;
        write_moving(&mut writer, particles, &state)?;
        let (name, at) = match at {
            At::Time(time) => ("log/time_ns", time),
            At::Path(path) => ("log/path", path),
        };
        writer.write(name, &Chunk::F64(vec![at]), 1)?;
        writer.end_frame();
    }
    writer.finish(&HEADER)
}

/// Returns the number of time steps before record `i`, or `i` for a run without time steps.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "times and steps are positive, and runs have fewer than 2^53 steps"
)]
fn step(assembly: &Assembly, i: usize, at: At) -> u64 {
    let time_step_ns = match &assembly.scene.task {
        Task::Dynamics(task) => task.time_step_ns,
        Task::Brownian(task) => task.time_step_ns,
        Task::Equilibrium(_) => None,
    };
    match (at, time_step_ns) {
        (At::Time(time_ns), Some(length_ns)) => (time_ns / length_ns).round() as u64,
        _ => i as u64,
    }
}

fn write_fixed(
    writer: &mut Writer<impl Write + Seek>,
    particles: &Particles<'_>,
    edges_nm: [f64; 3],
) -> io::Result<()> {
    let [x, y, z] = edges_nm;
    writer.write("configuration/dimensions", &Chunk::U8(vec![3]), 1)?;
    writer.write("configuration/box", &single([x, y, z, 0.0, 0.0, 0.0]), 1)?;
    writer.write("particles/N", &indices([particles.count()]), 1)?;
    let names = particles.species.iter().map(|s| s.name.clone());
    write_texts(writer, "particles/types", names)?;
    let shapes = particles.species.iter().map(|s| shape(s.shape));
    write_texts(writer, "particles/type_shapes", shapes)?;
    let sort = indices(particles.sort.iter().copied());
    writer.write("particles/typeid", &sort, 1)?;
    let diameter = |&sort: &usize| 2.0 * particles.species[sort].shape.radius_nm();
    let diameters = single(particles.sort.iter().map(diameter));
    writer.write("particles/diameter", &diameters, 1)?;
    writer.write("particles/mass", &single(particles.masses_ag()), 1)?;
    let moments = particles.moments_of_inertia_ag_nm2().into_iter();
    let moments = single(moments.flat_map(<[f64; 3]>::from));
    writer.write("particles/moment_inertia", &moments, 3)?;
    write_places_along(writer, particles)?;
    write_bonds(writer, particles)
}

fn write_places_along(
    writer: &mut Writer<impl Write + Seek>,
    particles: &Particles<'_>,
) -> io::Result<()> {
    let assembly = particles.assembly();
    let points = assembly.points.len();
    let mut arc_lengths: Vec<f64> = assembly.points.iter().map(|p| p.s_nm).collect();
    arc_lengths.resize(particles.count(), -1.0);
    writer.write("log/particles/s_nm", &Chunk::F64(arc_lengths), 1)?;
    let filament = |i| i64::try_from(assembly.filament_of_point(i)).unwrap_or(i64::MAX);
    let mut filaments: Vec<i64> = (0..points).map(filament).collect();
    filaments.resize(particles.count(), -1);
    writer.write("log/particles/filament", &Chunk::I64(filaments), 1)
}

fn write_bonds(
    writer: &mut Writer<impl Write + Seek>,
    particles: &Particles<'_>,
) -> io::Result<()> {
    let bonds = &particles.bonds;
    let is_there = |kind: &BondKind| bonds.iter().any(|bond| bond.kind == *kind);
    let kinds: Vec<BondKind> = BondKind::ALL.into_iter().filter(is_there).collect();
    if bonds.is_empty() {
        return Ok(());
    }
    writer.write("bonds/N", &indices([bonds.len()]), 1)?;
    let names = kinds.iter().map(|kind| kind.name().to_owned());
    write_texts(writer, "bonds/types", names)?;
    let number = |kind| kinds.iter().take_while(|k| **k != kind).count();
    let numbers = indices(bonds.iter().map(|bond| number(bond.kind)));
    writer.write("bonds/typeid", &numbers, 1)?;
    let groups = indices(bonds.iter().flat_map(|bond| bond.between));
    writer.write("bonds/group", &groups, 2)
}

fn write_moving(
    writer: &mut Writer<impl Write + Seek>,
    particles: &Particles<'_>,
    state: &State,
) -> io::Result<()> {
    let flat = |vectors: Vec<Vector3>| single(vectors.into_iter().flat_map(<[f64; 3]>::from));
    writer.write("particles/position", &flat(particles.places(state)), 3)?;
    let turns = particles.turns(state).into_iter();
    let quaternions = single(turns.flat_map(|q| [q.w, q.i, q.j, q.k]));
    writer.write("particles/orientation", &quaternions, 4)?;
    writer.write("particles/velocity", &flat(particles.velocities(state)), 3)
}

fn write_texts(
    writer: &mut Writer<impl Write + Seek>,
    name: &str,
    texts: impl Iterator<Item = String>,
) -> io::Result<()> {
    let texts: Vec<Vec<u8>> = texts.map(String::into_bytes).collect();
    let width = 1 + texts.iter().map(Vec::len).max().unwrap_or(0);
    let filled = texts.into_iter().flat_map(|mut text| {
        text.resize(width, 0);
        text
    });
    writer.write(name, &Chunk::I8(filled.collect()), width)
}

fn shape(shape: Shape) -> String {
    let shape = match shape {
        Shape::Ellipsoid([a, b, c]) => {
            serde_json::json!({ "type": "Ellipsoid", "a": a, "b": b, "c": c })
        }
        Shape::Sphere(radius) => {
            serde_json::json!({ "type": "Sphere", "diameter": 2.0 * radius })
        }
    };
    shape.to_string()
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "the precision of the format"
)]
fn single(values: impl IntoIterator<Item = f64>) -> Chunk {
    Chunk::F32(values.into_iter().map(|value| value as f32).collect())
}

fn indices(values: impl IntoIterator<Item = usize>) -> Chunk {
    let narrow = |value| u32::try_from(value).expect("memory holds fewer than 2^32 particles");
    Chunk::U32(values.into_iter().map(narrow).collect())
}

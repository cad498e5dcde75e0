//! Export to JSON of the Simularium viewer: trajectory info version 3, spatial data version 1.
//!
//! Each monomer is an agent with a mesh. Each rod is a fibre through its nodes, and each linker a fibre between its
//! ends. Since the format has no ellipsoids, [`simularium_meshes`] returns one Wavefront OBJ mesh for each species of
//! monomers. Its largest semi-axis is 1, and the viewer scales it by the radius of the agent. If the meshes are not
//! opened together with the file, the viewer shows spheres. Rotations are Euler angles with `R = Rx Ry Rz`.
//!
//! # Source
//! File format of simulariumio (simularium/simulariumio, `file_format.md`).

mod angles;
mod mesh;

use crate::particles::{LINKER_RADIUS_NM, runs};
use crate::{Particles, RecordedStates, Shape, extent};
use actin_sim::mechanics::{State, Vector3};
use actin_sim::rod_constants::cross_section_radius;
use actin_sim::{At, BodyKind};
use serde_json::json;
use std::io::{self, Write};

/// Visualisation types of agents.
const WITH_GEOMETRY: f32 = 1000.0;
const FIBRE: f32 = 1001.0;

/// Returns the meshes of the ellipsoids: file names that begin with `prefix`, and contents.
pub(crate) fn simularium_meshes(particles: &Particles<'_>, prefix: &str) -> Vec<(String, String)> {
    let meshes = particles.species.iter().filter_map(|s| match s.shape {
        Shape::Ellipsoid(semi_axes) => {
            let largest = s.shape.radius_nm();
            let unit = semi_axes.map(|axis| axis / largest);
            Some((mesh_name(prefix, &s.name), mesh::ellipsoid(unit)))
        }
        Shape::Sphere(_) => None,
    });
    meshes.collect()
}

fn mesh_name(prefix: &str, species: &str) -> String {
    format!("{prefix}_{species}.obj")
}

/// Writes a run as Simularium JSON that refers to the meshes of [`simularium_meshes`] with the same `prefix`.
///
/// # Errors
/// If the states cannot be read, or `out` returns an error.
pub(crate) fn write_simularium(
    particles: Particles<'_>,
    states: &dyn RecordedStates,
    prefix: &str,
    out: &mut impl Write,
) -> io::Result<()> {
    let agents = Agents::new(particles, prefix);
    let edges = extent::edges_nm(states, &agents.particles)?;
    let at = states.at();
    // The viewer has no periodic images: half of the box is sufficient.
    let info = info(&at, &agents, edges.map(|edge| 0.5 * edge));
    write!(out, "{{\"trajectoryInfo\":{info},\"spatialData\":")?;
    let count = at.len();
    write!(
        out,
        "{{\"version\":1,\"msgType\":1,\"bundleStart\":0,\"bundleSize\":{count},\"bundleData\":["
    )?;
    for (i, state) in states.states().enumerate() {
        let data = agents.frame(&*state?);
        let frame = json!({ "frameNumber": i, "time": at[i].value(), "data": data });
        let comma = if i == 0 { "" } else { "," };
        write!(out, "{comma}\n{frame}")?;
    }
    writeln!(out, "\n]}},\"plotData\":{{\"version\":1,\"data\":[]}}}}")?;
    out.flush()
}

fn info(at: &[At], agents: &Agents<'_>, size: [f64; 3]) -> serde_json::Value {
    let step = match at {
        [first, second, ..] => second.value() - first.value(),
        _ => 0.0,
    };
    let unit = match at {
        [At::Path(_), ..] => "stages",
        _ => "ns",
    };
    let [x, y, z] = size;
    let far = size.into_iter().fold(0.0, f64::max);
    let place = |x: f64, y: f64, z: f64| json!({ "x": x, "y": y, "z": z });
    let kinds = agents.kinds.iter().enumerate();
    let types: serde_json::Map<_, _> = kinds
        .map(|(i, kind)| (i.to_string(), kind.clone()))
        .collect();
    json!({
        "version": 3,
        "timeUnits": { "magnitude": 1.0, "name": unit },
        "timeStepSize": step,
        "totalSteps": at.len(),
        "spatialUnits": { "magnitude": 1.0, "name": "nm" },
        "size": place(x, y, z),
        // Side view, with the undeformed filament upright.
        "cameraDefault": {
            "position": place(0.0, -far, 0.0),
            "lookAtPosition": place(0.0, 0.0, 0.0),
            "upVector": place(0.0, 0.0, 1.0),
            "fovDegrees": 75.0,
        },
        "typeMapping": types,
        "trajectoryTitle": agents.particles.assembly().scene.title,
    })
}

struct Agents<'a> {
    particles: Particles<'a>,
    /// Name and display data of each agent type.
    kinds: Vec<serde_json::Value>,
    /// Index of the agent type of rods, after the species; linkers have the next index.
    rod: usize,
}

impl<'a> Agents<'a> {
    fn new(particles: Particles<'a>, prefix: &str) -> Self {
        let drawn = |name: &str, display: &str, url: String| json!({ "name": name, "geometry": { "displayType": display, "url": url, "color": "" } });
        let species = particles.species.iter().map(|s| match s.shape {
            Shape::Ellipsoid(_) => drawn(&s.name, "OBJ", mesh_name(prefix, &s.name)),
            Shape::Sphere(_) => drawn(&s.name, "SPHERE", String::new()),
        });
        let mut kinds: Vec<_> = species.collect();
        let rod = kinds.len();
        kinds.push(drawn("rod", "FIBER", String::new()));
        kinds.push(drawn("linker", "FIBER", String::new()));
        Self {
            particles,
            kinds,
            rod,
        }
    }

    fn frame(&self, state: &State) -> Vec<f32> {
        let mut buffer = Buffer::default();
        let assembly = self.particles.assembly();
        let turns = self.particles.turns(state);
        for (kind, points) in runs(assembly) {
            if kind == BodyKind::Monomer {
                for i in points {
                    let sort = self.particles.sort[i];
                    let radius = self.particles.species[sort].shape.radius_nm();
                    let place = state.points.position.get(i);
                    buffer.push(
                        (WITH_GEOMETRY, sort),
                        (place, angles::of(&turns[i])),
                        radius,
                    );
                    buffer.numbers.push(0.0);
                }
            } else {
                let nodes = points.map(|i| state.points.position.get(i));
                buffer.push_fibre(self.rod, cross_section_radius(), nodes);
            }
        }
        for &i in &self.particles.linkers {
            let ends = self.particles.linker(i, state);
            buffer.push_fibre(self.rod + 1, LINKER_RADIUS_NM, ends.into_iter());
        }
        buffer.numbers
    }
}

/// Numbers of a frame, agent by agent.
#[derive(Default)]
struct Buffer {
    numbers: Vec<f32>,
    agents: usize,
}

impl Buffer {
    #[expect(
        clippy::cast_possible_truncation,
        reason = "single precision is sufficient for display"
    )]
    fn push(
        &mut self,
        (kind, sort): (f32, usize),
        (place, turn): (Vector3, [f64; 3]),
        radius: f64,
    ) {
        self.numbers.extend([kind, self.agents as f32, sort as f32]);
        let place = place.iter().chain(&turn).chain([&radius]);
        self.numbers.extend(place.map(|&number| number as f32));
        self.agents += 1;
    }

    #[expect(
        clippy::cast_possible_truncation,
        reason = "single precision is sufficient for display"
    )]
    fn push_fibre(&mut self, sort: usize, radius: f64, points: impl Iterator<Item = Vector3>) {
        self.push((FIBRE, sort), (Vector3::zeros(), [0.0; 3]), radius);
        let points: Vec<f32> = points
            .flat_map(<[f64; 3]>::from)
            .map(|number| number as f32)
            .collect();
        self.numbers.push(points.len() as f32);
        self.numbers.extend(points);
    }
}

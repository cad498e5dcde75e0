//! A state of an assembly as views draw it: plain numbers, taken from the state alone. All
//! filaments are in it.

pub mod bodies;
mod bonds;

pub use bonds::Bonds;
pub(crate) use bonds::keep as share;

use actin_sim::Assembly;
use actin_sim::mechanics::{State, Vector3};
use serde::Serialize;

/// Places are kept to 0.01 nm, a hundredth of the least that is seen at full zoom.
const PER_NM: f64 = 1e2;
/// Components of quaternions are kept to 1e-4, a turn of 0.01 deg.
const PER_UNIT: f64 = 1e4;

/// Bodies and what holds and pulls them (nm, pN, lab frame).
#[derive(Clone, Debug, Default, Serialize)]
pub struct Pose {
    /// Sections of monomers.
    pub strands: Vec<Strand>,
    /// Radius of the cross-section of rods.
    pub rod_radius: f64,
    /// Sections that are rods.
    pub rods: Vec<Rod>,
    /// Monomer's centre and rod's end of each bond of a junction.
    pub junctions: Vec<[f64; 6]>,
    /// Site of each linker, and its anchor or other site.
    pub linkers: Vec<[f64; 6]>,
    /// Points outside of filaments that linkers pull towards.
    pub anchors: Vec<[f64; 3]>,
    /// Corners of a plate at each held end.
    pub clamps: Vec<[f64; 12]>,
    /// Where each force acts, and the force (pN).
    pub forces: Vec<[f64; 6]>,
    /// Centre line of each filament.
    pub lines: Vec<Vec<[f64; 3]>>,
}

/// Monomers that follow one another.
#[derive(Clone, Debug, Serialize)]
pub struct Strand {
    /// Semi-axes of every monomer along its own frame.
    pub semi_axes: [f64; 3],
    /// Centre, then quaternion (w, x, y, z; body to lab) of each monomer.
    pub monomers: Vec<[f64; 7]>,
    /// Lattice index of the first, by which its bonds are found.
    pub first: i64,
    /// Bonds of an interface, those that are not drawn included.
    pub per_interface: usize,
    /// Which of the bonds of the file are theirs; set when the file is written.
    pub bonds: usize,
    #[serde(skip)]
    pub(crate) own_bonds: Bonds,
}

/// A section of n segments: n + 1 nodes, n frames.
#[derive(Clone, Debug, Serialize)]
pub struct Rod {
    /// Places of its nodes.
    pub nodes: Vec<[f64; 3]>,
    /// Quaternion (w, x, y, z; body to lab) of each segment.
    pub frames: Vec<[f64; 4]>,
}

/// Half the width of the plate at a held end (nm).
pub(crate) const PLATE_NM: f64 = 6.0;

impl Pose {
    /// What is seen of `state`.
    pub fn of(assembly: &Assembly, state: &State) -> Self {
        let junctions = assembly.junction_bonds();
        let linkers = assembly.linkers.iter();
        let filaments = assembly.filaments.iter();
        Self {
            strands: strands(assembly, state),
            rod_radius: rounded(bodies::rod_radius_nm(), PER_NM),
            rods: rods(assembly, state),
            junctions: junctions
                .iter()
                .map(|bond| pair(bodies::ends_of(bond, state)))
                .collect(),
            linkers: linkers
                .map(|l| pair([l.site().position(state), l.end_position(state)]))
                .collect(),
            anchors: bodies::anchors(assembly, state)
                .into_iter()
                .map(place)
                .collect(),
            clamps: bodies::plates(assembly, state, PLATE_NM)
                .into_iter()
                .map(plate)
                .collect(),
            forces: bodies::forces(assembly, state)
                .into_iter()
                .map(<_>::into)
                .map(pair)
                .collect(),
            lines: filaments
                .map(|filament| {
                    let points = filament.points.clone();
                    points
                        .map(|i| place(assembly.centre_line_nm(state, i)))
                        .collect()
                })
                .collect(),
        }
    }

    /// The same without linkers.
    #[must_use]
    pub fn without_linkers(self) -> Self {
        Self {
            linkers: Vec::new(),
            anchors: Vec::new(),
            ..self
        }
    }

    /// Puts the bonds between monomers among those of a file, which all of its states share.
    pub(crate) fn share_bonds(&mut self, all: &mut Vec<Bonds>) {
        for strand in &mut self.strands {
            strand.bonds = bonds::keep(all, std::mem::take(&mut strand.own_bonds));
        }
    }

    /// Whether every number is one.
    pub(crate) fn is_finite(&self) -> bool {
        let (rods, strands) = (self.rods.iter(), self.strands.iter());
        let bodies = strands.clone().flat_map(|s| s.monomers.iter().flatten());
        let ends = [&self.junctions, &self.linkers, &self.forces];
        bodies
            .chain(strands.flat_map(|strand| &strand.semi_axes))
            .chain([&self.rod_radius])
            .chain(rods.clone().flat_map(|rod| rod.nodes.iter().flatten()))
            .chain(rods.flat_map(|rod| rod.frames.iter().flatten()))
            .chain(ends.into_iter().flatten().flatten())
            .chain(self.anchors.iter().flatten())
            .chain(self.clamps.iter().flatten())
            .chain(self.lines.iter().flatten().flatten())
            .all(|x| x.is_finite())
    }
}

fn strands(assembly: &Assembly, state: &State) -> Vec<Strand> {
    let sections = assembly.sections.iter().enumerate();
    let strand = |(i, section): (usize, &actin_sim::SectionSpan)| {
        let (first, per_interface, own_bonds) = Bonds::of(assembly, i)?;
        let bodies = section.points.clone().zip(section.frames.clone());
        let body = |(point, frame): (usize, usize)| {
            let centre = state.points.position.get(point);
            join(place(centre), quaternion(state, frame))
        };
        let filament = assembly.filament_of_section(i);
        Some(Strand {
            semi_axes: assembly.monomers_of(filament).semi_axes_nm,
            monomers: bodies.map(body).collect(),
            first,
            per_interface,
            bonds: 0,
            own_bonds,
        })
    };
    sections.filter_map(strand).collect()
}

fn rods(assembly: &Assembly, state: &State) -> Vec<Rod> {
    let sections = assembly.sections.iter().filter(|s| !s.is_ellipsoids());
    let rod = |section: &actin_sim::SectionSpan| Rod {
        nodes: section
            .points
            .clone()
            .map(|i| place(state.points.position.get(i)))
            .collect(),
        frames: section
            .frames
            .clone()
            .map(|i| quaternion(state, i))
            .collect(),
    };
    sections.map(rod).collect()
}

/// To the nearest of so many steps per unit; zero without a sign.
fn rounded(x: f64, per_unit: f64) -> f64 {
    (x * per_unit).round() / per_unit + 0.0
}

fn place(p: Vector3) -> [f64; 3] {
    [p.x, p.y, p.z].map(|x| rounded(x, PER_NM))
}

fn quaternion(state: &State, frame: usize) -> [f64; 4] {
    let q = state.frames.orientation.get(frame);
    [q.w, q.i, q.j, q.k].map(|x| rounded(x, PER_UNIT))
}

fn join([x, y, z]: [f64; 3], [a, b, c, d]: [f64; 4]) -> [f64; 7] {
    [x, y, z, a, b, c, d]
}

fn pair(ends: [Vector3; 2]) -> [f64; 6] {
    let [[a, b, c], [d, e, f]] = ends.map(place);
    [a, b, c, d, e, f]
}

fn plate(corners: [Vector3; 4]) -> [f64; 12] {
    let [a, b, c, d] = corners;
    let ([a, b, c, d, e, f], [g, h, i, j, k, l]) = (pair([a, b]), pair([c, d]));
    [a, b, c, d, e, f, g, h, i, j, k, l]
}

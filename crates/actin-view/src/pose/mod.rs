//! Visible bodies of a state of all filaments, as plain numbers.

pub mod bodies;
mod bonds;

pub use bonds::Bonds;
pub(crate) use bonds::keep as share;

use actin_sim::Assembly;
use actin_sim::mechanics::{State, Vector3};
use serde::Serialize;

/// Positions are rounded to 0.01 nm.
const PER_NM: f64 = 1e2;
/// Components of quaternions are rounded to 1e-4, a rotation of about 0.01 deg.
const PER_UNIT: f64 = 1e4;

/// Visible bodies, clamps, linkers and forces (nm, pN, lab frame).
#[derive(Clone, Debug, Default, Serialize)]
pub struct Pose {
    /// Sections of monomers.
    pub strands: Vec<Strand>,
    /// Radius of the cross-section of rods.
    pub rod_radius: f64,
    /// Rod sections.
    pub rods: Vec<Rod>,
    /// Monomer centre and rod end of each junction bond.
    pub junctions: Vec<[f64; 6]>,
    /// Ends of each linker: its site, and its anchor or second site.
    pub linkers: Vec<[f64; 6]>,
    /// Anchors of linkers outside filaments.
    pub anchors: Vec<[f64; 3]>,
    /// Corners of a plate at each clamp.
    pub clamps: Vec<[f64; 12]>,
    /// Position and force (pN) of each load.
    pub forces: Vec<[f64; 6]>,
    /// Centre line of each filament.
    pub lines: Vec<Vec<[f64; 3]>>,
}

/// Consecutive monomers.
#[derive(Clone, Debug, Serialize)]
pub struct Strand {
    /// Semi-axes of every monomer in its body frame.
    pub semi_axes: [f64; 3],
    /// Centre and quaternion (w, x, y, z; body to lab) of each monomer.
    pub monomers: Vec<[f64; 7]>,
    /// Lattice index of the first monomer, which identifies its bonds.
    pub first: i64,
    /// Number of bonds of an interface, including those not displayed.
    pub per_interface: usize,
    /// Index of the set of bonds in the file; set when the file is written.
    pub bonds: usize,
    #[serde(skip)]
    pub(crate) own_bonds: Bonds,
}

/// A rod of n segments, with n + 1 nodes and n frames.
#[derive(Clone, Debug, Serialize)]
pub struct Rod {
    /// Positions of nodes.
    pub nodes: Vec<[f64; 3]>,
    /// Quaternion (w, x, y, z; body to lab) of each segment.
    pub frames: Vec<[f64; 4]>,
}

/// Half the width of a clamp plate (nm).
pub(crate) const PLATE_NM: f64 = 6.0;

impl Pose {
    /// Creates the pose of `state`.
    pub fn new(assembly: &Assembly, state: &State) -> Self {
        let junctions = assembly.junction_bonds();
        let linkers = assembly.linkers.iter();
        let filaments = assembly.filaments.iter();
        Self {
            strands: strands(assembly, state),
            rod_radius: rounded(bodies::rod_radius_nm(), PER_NM),
            rods: rods(assembly, state),
            junctions: junctions
                .iter()
                .map(|bond| flat(&bodies::ends_of(bond, state)))
                .collect(),
            linkers: linkers
                .map(|l| flat(&[l.site().position(state), l.end_position(state)]))
                .collect(),
            anchors: bodies::anchors(assembly, state)
                .into_iter()
                .map(place)
                .collect(),
            clamps: bodies::plates(assembly, state, PLATE_NM)
                .into_iter()
                .map(|corners| flat(&corners))
                .collect(),
            forces: bodies::forces(assembly, state)
                .into_iter()
                .map(|(at, force)| flat(&[at, force]))
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

    /// Removes linkers.
    #[must_use]
    pub fn without_linkers(self) -> Self {
        Self {
            linkers: Vec::new(),
            anchors: Vec::new(),
            ..self
        }
    }

    /// Moves the bonds to the sets shared by all states of a file.
    pub(crate) fn share_bonds(&mut self, all: &mut Vec<Bonds>) {
        for strand in &mut self.strands {
            strand.bonds = bonds::keep(all, std::mem::take(&mut strand.own_bonds));
        }
    }
}

fn strands(assembly: &Assembly, state: &State) -> Vec<Strand> {
    let sections = assembly.sections.iter().enumerate();
    let strand = |(i, section): (usize, &actin_sim::SectionSpan)| {
        let (first, per_interface, own_bonds) = Bonds::from_section(assembly, i)?;
        let bodies = section.points.clone().zip(section.frames.clone());
        let body = |(point, frame): (usize, usize)| {
            let centre = state.points.position.get(point);
            let ([x, y, z], [w, i, j, k]) = (place(centre), quaternion(state, frame));
            [x, y, z, w, i, j, k]
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

/// Rounds to multiples of `1 / per_unit`; -0 becomes 0.
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

fn flat<const N: usize>(points: &[Vector3]) -> [f64; N] {
    let mut numbers = points.iter().flat_map(|p| place(*p));
    std::array::from_fn(|_| numbers.next().expect("three numbers a point"))
}

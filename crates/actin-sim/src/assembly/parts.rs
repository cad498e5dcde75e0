//! What bodies, sections and terms are, for writers and pictures.

use super::built::Built;
use super::{Ranges, TwistWatch};
use crate::scene::End;
use actin_cosserat::{JoinedElement, RodLayout, RodMaterial, SegmentLaw};
use actin_mechanics::{UnitQuaternion, Vector3};
use std::ops::Range;

/// How many segments or rises a bond or segment reaches at most, with room.
const REACH: f64 = 3.0;

/// What a point or a frame stands for. The numbers are those written to files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BodyKind {
    /// A monomer's centre, and its principal frame (radial, tangential, axial).
    Monomer = 0,
    /// A node of a rod.
    Node = 1,
    /// The frame of a rod's segment.
    Segment = 2,
    /// The frame of a junction's bond.
    Junction = 3,
    /// The cross-section at the end of a rod: held by a wall, or free where a couple acts on it.
    Wall = 4,
    /// The cross-section between two rods.
    Joint = 5,
}

impl BodyKind {
    /// All kinds, in the order of their numbers.
    pub const ALL: [Self; 6] = [
        Self::Monomer,
        Self::Node,
        Self::Segment,
        Self::Junction,
        Self::Wall,
        Self::Joint,
    ];

    /// The name that files give it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Monomer => "monomer",
            Self::Node => "node",
            Self::Segment => "segment",
            Self::Junction => "junction",
            Self::Wall => "wall",
            Self::Joint => "joint",
        }
    }
}

/// What a point is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointInfo {
    /// Monomer or node.
    pub kind: BodyKind,
    /// Arc length at rest (nm).
    pub s_nm: f64,
    /// The frame of the same body; nodes have none.
    pub frame: Option<usize>,
}

/// What a frame is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameInfo {
    /// Monomer, segment, junction or wall.
    pub kind: BodyKind,
    /// Arc length at rest (nm).
    pub s_nm: f64,
}

/// What a term belongs to. Sections are counted through all filaments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Part {
    /// A section, by its index.
    Section(usize),
    /// The junction between this section and the next.
    Junction(usize),
    /// A load, by its index in the scene.
    Load(usize),
    /// A linker, by its index in the scene.
    Linker(usize),
    /// The spring of a clamp, by the clamp's index in the scene.
    Clamp(usize),
    /// The repulsion of filaments by each other.
    Contacts,
    /// A plane that repels, by its index in the scene.
    Plane(usize),
    /// A sphere that repels, by its index in the scene.
    Sphere(usize),
}

/// Where the parts of a filament stand among those of all, and where it was built.
#[derive(Clone, Debug, PartialEq)]
pub struct FilamentSpan {
    /// Its sections.
    pub sections: Range<usize>,
    /// Its points, contiguous.
    pub points: Range<usize>,
    /// Its frames, contiguous; those of junctions and walls included.
    pub frames: Range<usize>,
    /// Terms of its sections and junctions, contiguous.
    pub terms: Range<usize>,
    /// Where arc length begins (nm, lab frame).
    pub origin_nm: Vector3,
    /// The turn from a filament along lab +z, or of its shape.
    pub rotation: UnitQuaternion,
    /// Where its axis is, if it is not built straight; seen along lab +z.
    pub(crate) shape: Option<Built>,
}

impl FilamentSpan {
    /// Place of its axis as built at an arc length (nm, lab frame).
    pub fn axis_place(&self, s_nm: f64) -> Vector3 {
        match &self.shape {
            None => self.origin_nm + self.axis() * s_nm,
            Some(built) => self.origin_nm + self.rotation * built.at(s_nm).0,
        }
    }

    /// The turn from a filament along lab +z at an arc length (nm) as built.
    pub fn frame_at(&self, s_nm: f64) -> UnitQuaternion {
        let built = self.shape.as_ref();
        built.map_or(self.rotation, |built| self.rotation * built.at(s_nm).1)
    }

    /// Unit vector along the filament as built (lab frame); of one with a shape that along which its shape is
    /// placed.
    pub fn axis(&self) -> Vector3 {
        self.rotation * Vector3::z()
    }

    /// A place (nm, lab frame) as seen if the filament had been built along lab +z from the origin.
    pub fn seen_along_z(&self, place: Vector3) -> Vector3 {
        let relative = place - self.origin_nm;
        self.rotation.inverse_transform_vector(&relative)
    }
}

/// A rod, and how far the data behind its laws reach.
#[derive(Debug)]
pub(crate) struct Rod {
    /// Index of its section.
    pub section: usize,
    /// Its nodes and segments.
    pub layout: RodLayout,
    /// What it is made of, and what couples its strains.
    pub law: (RodMaterial, SegmentLaw),
    /// How far these data reach.
    pub ranges: Ranges,
    /// The elements that join its start and its end to the frames of junctions.
    pub joined: [Vec<JoinedElement>; 2],
    /// What its twist is watched with, where the force along it can make it unstable.
    pub twist_watch: Option<TwistWatch>,
}

/// One interaction of the assembled system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Term {
    /// Kind of interaction, as the interaction itself names it.
    pub name: &'static str,
    /// Where it acts.
    pub part: Part,
}

/// A section as resolved.
#[derive(Clone, Debug, PartialEq)]
pub struct SectionSpan {
    /// Whether it resolves monomers or is a rod.
    pub resolution: Resolution,
    /// Arc length of its start (nm).
    pub from_nm: f64,
    /// Arc length of its end (nm).
    pub to_nm: f64,
    /// Its points.
    pub points: Range<usize>,
    /// Its own frames: of monomers or of segments.
    pub frames: Range<usize>,
    /// Points whose mean is the section's first tip.
    pub(super) first_tip: Vec<usize>,
    /// Points whose mean is the section's last tip.
    pub(super) last_tip: Vec<usize>,
}

/// How a section is resolved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Resolution {
    /// Monomer by monomer.
    Ellipsoids {
        /// Lattice index of the first monomer.
        first_index: i64,
        /// Number of bonds.
        bonds: usize,
    },
    /// As a rod.
    Rod {
        /// Rest length of a segment (nm).
        segment_nm: f64,
    },
}

impl SectionSpan {
    /// Number of bonds; a rod has none.
    pub fn bonds(&self) -> usize {
        match self.resolution {
            Resolution::Ellipsoids { bonds, .. } => bonds,
            Resolution::Rod { .. } => 0,
        }
    }

    /// How far its bonds or segments couple at most (nm of arc length), with room, where monomers stand a
    /// rise apart: monomers reach the next but one, bending elements from middle to middle.
    pub(crate) fn reach_nm(&self, rise_nm: f64) -> f64 {
        REACH
            * match self.resolution {
                Resolution::Ellipsoids { .. } => rise_nm,
                Resolution::Rod { segment_nm } => segment_nm,
            }
    }

    /// Whether the section resolves monomers.
    pub fn is_ellipsoids(&self) -> bool {
        matches!(self.resolution, Resolution::Ellipsoids { .. })
    }

    /// Points whose mean is the tip at `end`.
    pub(super) fn tip_points(&self, end: End) -> &[usize] {
        match end {
            End::Start => &self.first_tip,
            End::End => &self.last_tip,
        }
    }
}

/// Number of bodies and elements of each kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct Counts {
    /// Monomers, held ones included.
    pub monomers: usize,
    /// Bonds between monomers.
    pub bonds: usize,
    /// Segments of rods.
    pub segments: usize,
    /// Junctions between sections.
    pub junctions: usize,
    /// Degrees of freedom of the free bodies.
    pub dofs: usize,
}

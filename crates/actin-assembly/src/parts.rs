//! Descriptions of bodies, sections and terms, for output and pictures.

use super::built_axis::BuiltAxis;
use crate::scene::{End, WallName};
use actin_mechanics::{UnitQuaternion, Vector3};
use std::iter::Sum;
use std::ops::Range;

/// Reach of a bond or segment in rises or segments, with a margin.
const REACH: f64 = 3.0;

/// Kind of a point or frame. The numbers are those in files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BodyKind {
    /// Centre of a monomer, and its principal frame (radial, tangential, axial).
    Monomer = 0,
    /// Node of a rod.
    Node = 1,
    /// Frame of a rod's segment.
    Segment = 2,
    /// Frame of a junction's bond.
    Junction = 3,
    /// Cross-section at the end of a rod: held by a wall, or free with an end couple.
    Wall = 4,
    /// Cross-section between two rods.
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

    /// Name in files.
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

/// Description of a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointInfo {
    /// Monomer or node.
    pub kind: BodyKind,
    /// Arc length at rest (nm).
    pub s_nm: f64,
    /// Frame of the same body; `None` for nodes.
    pub frame: Option<usize>,
}

/// Description of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameInfo {
    /// Monomer, segment, junction or wall.
    pub kind: BodyKind,
    /// Arc length at rest (nm).
    pub s_nm: f64,
}

/// Part of the scene to which a term belongs. Section indices run through all filaments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Part {
    /// Section by index.
    Section(usize),
    /// Junction between the section with this index and the next.
    Junction(usize),
    /// Load by index in the scene.
    Load(usize),
    /// Linker by index in the scene.
    Linker(usize),
    /// Spring of a clamp, by index of the clamp in the scene.
    Clamp(usize),
    /// Repulsion between filaments.
    Contacts,
    /// Repelling wall.
    Wall(WallName),
}

/// Index ranges of a filament's parts and its position as built.
#[derive(Clone, Debug, PartialEq)]
pub struct FilamentSpan {
    /// Range of sections.
    pub sections: Range<usize>,
    /// Range of points.
    pub points: Range<usize>,
    /// Range of frames, including junctions and walls.
    pub frames: Range<usize>,
    /// Range of terms of its sections and junctions.
    pub terms: Range<usize>,
    /// Position of arc length 0 (nm, lab frame).
    pub origin_nm: Vector3,
    /// Rotation from lab +z to the filament or to its curve.
    pub rotation: UnitQuaternion,
    pub(crate) shape: Option<BuiltAxis>,
}

impl FilamentSpan {
    /// Position of the axis as built at an arc length (nm, lab frame).
    pub fn axis_place(&self, s_nm: f64) -> Vector3 {
        match &self.shape {
            None => self.origin_nm + self.axis() * s_nm,
            Some(built) => self.origin_nm + self.rotation * built.at(s_nm).0,
        }
    }

    /// Rotation from lab +z to the axis as built at an arc length (nm).
    pub fn frame_at(&self, s_nm: f64) -> UnitQuaternion {
        let built = self.shape.as_ref();
        built.map_or(self.rotation, |built| self.rotation * built.at(s_nm).1)
    }

    /// Unit vector along the filament as built (lab frame); for a curved filament, the direction of
    /// its placement.
    pub fn axis(&self) -> Vector3 {
        self.rotation * Vector3::z()
    }

    /// Transforms a position (nm, lab frame) to the frame in which the filament starts at the
    /// origin along +z.
    pub fn to_filament_frame(&self, place: Vector3) -> Vector3 {
        let relative = place - self.origin_nm;
        self.rotation.inverse_transform_vector(&relative)
    }
}

/// Description of an interaction of the system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Term {
    /// Name of the interaction.
    pub name: &'static str,
    /// Part to which it belongs.
    pub part: Part,
}

/// Sampled quasi-harmonic interfaces of a filament.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct InterfaceSampling {
    pub(crate) monomers: usize,
    /// Relative standard error of the stiffness of one interface, averaged over all interfaces.
    pub(crate) error: f64,
}

/// Resolved section.
#[derive(Clone, Debug, PartialEq)]
pub struct SectionSpan {
    /// Resolution as monomers or as a rod.
    pub resolution: Resolution,
    /// Arc length of the start (nm).
    pub from_nm: f64,
    /// Arc length of the end (nm).
    pub to_nm: f64,
    /// Range of points.
    pub points: Range<usize>,
    /// Range of the frames of its monomers or segments.
    pub frames: Range<usize>,
    /// Points whose mean is the tip at the start and at the end.
    pub(super) tips: [Range<usize>; 2],
}

/// Resolution of a section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Resolution {
    /// Monomers.
    Ellipsoids {
        /// Lattice index of the first monomer.
        first_index: i64,
        /// Number of bonds.
        bonds: usize,
    },
    /// Rod.
    Rod {
        /// Rest length of a segment (nm).
        segment_nm: f64,
    },
}

impl SectionSpan {
    /// Number of bonds; 0 for a rod.
    pub(crate) fn bonds(&self) -> usize {
        match self.resolution {
            Resolution::Ellipsoids { bonds, .. } => bonds,
            Resolution::Rod { .. } => 0,
        }
    }

    /// Upper bound of the coupling distance of bonds or segments (nm of arc length), with a margin.
    pub(crate) fn reach_nm(&self, rise_nm: f64) -> f64 {
        REACH
            * match self.resolution {
                Resolution::Ellipsoids { .. } => rise_nm,
                Resolution::Rod { segment_nm } => segment_nm,
            }
    }

    /// Returns `true` for a section of monomers.
    pub fn is_ellipsoids(&self) -> bool {
        matches!(self.resolution, Resolution::Ellipsoids { .. })
    }

    pub(super) fn tip_points(&self, end: End) -> Range<usize> {
        self.tips[end as usize].clone()
    }
}

/// Number of bodies and elements of each kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Counts {
    /// Monomers, including held monomers.
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

impl Sum for Counts {
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        all.fold(Self::default(), |sum, one| Self {
            monomers: sum.monomers + one.monomers,
            bonds: sum.bonds + one.bonds,
            segments: sum.segments + one.segments,
            junctions: sum.junctions + one.junctions,
            dofs: sum.dofs + one.dofs,
        })
    }
}

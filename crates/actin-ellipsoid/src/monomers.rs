//! A run of consecutive monomers on a state.

use actin_mechanics::{Frame, Inertia, Point, State, UnitQuaternion, Vector3};

use crate::Helix;

/// Where a filament is put: first turned about the origin, then shifted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Turn, from a filament along lab +z.
    pub rotation: UnitQuaternion,
    /// Shift of arc length 0 (nm, lab frame).
    pub translation: Vector3,
}

impl Default for Placement {
    /// The axis along lab +z, arc length 0 at the origin.
    fn default() -> Self {
        Self {
            rotation: UnitQuaternion::identity(),
            translation: Vector3::zeros(),
        }
    }
}

/// A run of consecutive monomers whose points and frames stand contiguously in a state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Monomers {
    /// Point of the first monomer.
    pub first_point: usize,
    /// Frame of the first monomer.
    pub first_frame: usize,
    /// Lattice index of the first monomer.
    pub first_index: i64,
    /// Number of monomers.
    pub count: usize,
}

impl Monomers {
    /// Pushes `count` monomers from lattice index `first_index` on.
    pub(crate) fn push(
        helix: &Helix,
        (mass, inertia): (f64, Inertia),
        placement: &Placement,
        (first_index, count): (i64, usize),
        state: &mut State,
    ) -> Self {
        let monomers = Self {
            first_point: state.points.len(),
            first_frame: state.frames.len(),
            first_index,
            count,
        };
        for index in monomers.indices() {
            state.points.push(Point {
                position: placement.rotation * helix.centre(index) + placement.translation,
                mass,
            });
            state.frames.push(Frame {
                orientation: placement.rotation * helix.orientation(index),
                inertia,
            });
        }
        monomers
    }

    /// Point of monomer `k` of the run.
    pub fn point(&self, k: usize) -> usize {
        self.first_point + k
    }

    /// Frame of monomer `k` of the run.
    pub fn frame(&self, k: usize) -> usize {
        self.first_frame + k
    }

    /// Lattice index of monomer `k` of the run.
    ///
    /// # Panics
    /// If `k` is beyond any lattice (2^63).
    pub fn index(&self, k: usize) -> i64 {
        self.first_index + i64::try_from(k).expect("a run is shorter than 2^63")
    }

    /// Lattice indices of the run.
    pub fn indices(&self) -> impl ExactSizeIterator<Item = i64> + use<> {
        let run = *self;
        (0..run.count).map(move |k| run.index(k))
    }
}

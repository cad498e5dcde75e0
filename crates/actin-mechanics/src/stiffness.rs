//! Second derivatives of an energy in blocks.

use crate::{Matrix3, State};

/// Three coordinates of one body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Coordinates {
    /// Displacement of a point (lab frame).
    Point(usize),
    /// Rotation vector `phi` of a frame, `Q -> Q exp(phi)` (body frame).
    Frame(usize),
}

/// A list of 3x3 blocks of second derivatives.
///
/// For coordinates `u` and `v` of two bodies, the block `(a, b)` is `d^2 E / du_a dv_b` at
/// `u = v = 0`. Each pair of different bodies is listed once; the transposed block is implied.
///
/// An interaction pushes the same pairs in the same order at every state, so that an assembler can
/// store the positions of blocks. A change of pairs, as for contacts, costs a new analysis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stiffness {
    blocks: Vec<(Coordinates, Coordinates, Matrix3)>,
}

impl Stiffness {
    /// Adds a block. For `a == b` the block must be symmetric.
    #[inline]
    pub fn push(&mut self, a: Coordinates, b: Coordinates, block: Matrix3) {
        self.blocks.push((a, b, block));
    }

    /// All blocks in the order of insertion.
    pub fn blocks(&self) -> &[(Coordinates, Coordinates, Matrix3)] {
        &self.blocks
    }

    /// Removes all blocks and keeps the allocated memory.
    pub fn clear(&mut self) {
        self.blocks.clear();
    }
}

/// Second derivatives of the energy of an interaction.
///
/// With the orientation `Q exp(phi)`, the diagonal block `K` at `phi = 0` is symmetric. The
/// derivative of the body torque `tau` with respect to `phi` is `-(K - [tau]x / 2)`.
pub trait SecondOrder {
    /// Adds the second derivatives of the energy at `state`, including the geometric stiffness.
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness);
}

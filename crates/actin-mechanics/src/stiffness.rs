//! Second derivatives of an energy, block by block.

use crate::{Matrix3, State};

/// One body's three coordinates: a point's position or a frame's orientation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Coordinates {
    /// Displacement of a point, lab frame.
    Point(usize),
    /// Turn `phi` of a frame, `Q -> Q exp(phi)`, body frame.
    Frame(usize),
}

/// A list of 3x3 blocks of second derivatives.
///
/// With `u` and `v` coordinates of two bodies, the block `(a, b)` is `d^2 E / du_a dv_b` at
/// `u = v = 0`. Each pair of different bodies is given once; the transposed block is implied.
/// An interaction pushes the same pairs in the same order at every state, so that an
/// assembler can look up places once. One whose pairs come and go, such as bodies in contact, costs a new
/// look-up whenever they do; its pairs depend on the state alone.
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

    /// All blocks in the order in which they were pushed.
    pub fn blocks(&self) -> &[(Coordinates, Coordinates, Matrix3)] {
        &self.blocks
    }

    /// Forgets the blocks and keeps the memory.
    pub fn clear(&mut self) {
        self.blocks.clear();
    }
}

/// An interaction that knows the second derivatives of its energy.
///
/// The orientation of each frame is taken as `Q exp(phi)`, in which the second derivative at
/// `phi = 0` is symmetric also where there is a torque. The derivative of the body torque with
/// respect to `phi` is then `-(K - [tau]x / 2)`, `tau` the torque and `K` the diagonal block.
pub trait SecondOrder {
    /// Adds the second derivatives of the energy at `state`, geometric part included.
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness);
}

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
/// Blocks of a chain, such as a rod, are pushed for the same pairs in the same order at every
/// state, so that an assembler can store their positions. Links couple other pairs, and these may
/// change: springs between chains, contacts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stiffness {
    blocks: Vec<Block>,
    links: Vec<Block>,
}

type Block = (Coordinates, Coordinates, Matrix3);

impl Stiffness {
    /// Adds a block. For `a == b` the block must be symmetric.
    #[inline]
    pub fn push(&mut self, a: Coordinates, b: Coordinates, block: Matrix3) {
        self.blocks.push((a, b, block));
    }

    /// Adds a block of a link. For `a == b` the block must be symmetric.
    #[inline]
    pub fn push_link(&mut self, a: Coordinates, b: Coordinates, block: Matrix3) {
        self.links.push((a, b, block));
    }

    /// Adds all blocks that `add` pushes as links.
    pub fn extend_links(&mut self, add: impl FnOnce(&mut Self)) {
        let start = self.blocks.len();
        add(self);
        self.links.extend(self.blocks.drain(start..));
    }

    /// Adds all blocks that `add` pushes, without the coupling of rotations about the third axes of
    /// frames to other motion. `has_twist` keeps their coupling to each other.
    pub fn extend_without_spin(&mut self, has_twist: bool, add: impl FnOnce(&mut Self)) {
        let is_frame = |body: &Coordinates| matches!(body, Coordinates::Frame(_));
        let start = self.blocks.len();
        add(self);
        for (a, b, block) in &mut self.blocks[start..] {
            let twist = block[(2, 2)];
            if is_frame(a) {
                block.fill_row(2, 0.0);
            }
            if is_frame(b) {
                block.fill_column(2, 0.0);
            }
            if !is_frame(a) && !is_frame(b) || is_frame(a) && is_frame(b) && has_twist {
                block[(2, 2)] = twist;
            }
        }
    }

    /// Blocks of chains in the order of insertion.
    pub fn blocks(&self) -> &[(Coordinates, Coordinates, Matrix3)] {
        &self.blocks
    }

    /// Blocks of links in the order of insertion.
    pub fn links(&self) -> &[(Coordinates, Coordinates, Matrix3)] {
        &self.links
    }

    /// Blocks of chains, followed by the blocks of links.
    pub fn all(&self) -> impl Iterator<Item = &(Coordinates, Coordinates, Matrix3)> {
        self.blocks.iter().chain(&self.links)
    }

    /// Removes all blocks and keeps the allocated memory.
    pub fn clear(&mut self) {
        self.blocks.clear();
        self.links.clear();
    }
}

/// Second derivatives of the energy of an interaction.
///
/// With the orientation `Q exp(phi)`, the diagonal block `K` at `phi = 0` is symmetric. The
/// derivative of the body torque `tau` with respect to `phi` is `-(K - [tau]x / 2)`.
pub trait SecondOrder {
    /// Adds the second derivatives of the energy at `state`, including the geometric stiffness.
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness);

    /// Returns `true` if the coupled bodies depend on positions, as for contacts. Couplings of other
    /// interactions change at most between steps. The default is `false`.
    fn couples_by_distance(&self) -> bool {
        false
    }
}

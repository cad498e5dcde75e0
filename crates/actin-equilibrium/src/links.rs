//! Stiffness blocks of links, which may couple other bodies at each state.

use crate::layout::Layout;
use crate::pattern::{BlockPosition, Pattern};
use actin_mechanics::{Coordinates, Matrix3};
use std::ops::Range;

pub(crate) type Block = (Coordinates, Coordinates, Matrix3);

/// Block of a link in the unknowns; the transposed block is implied.
#[derive(Clone, Debug)]
pub(crate) struct LinkBlock {
    pub(crate) nodes: [usize; 2],
    pub(crate) rows: Range<usize>,
    pub(crate) columns: Range<usize>,
    pub(crate) values: Matrix3,
}

impl LinkBlock {
    /// Adds the products of the block and of its transpose with `v`.
    pub(crate) fn add_product(&self, v: &[f64], product: &mut [f64], entry: impl Fn(f64) -> f64) {
        for (j, column) in self.columns.clone().enumerate() {
            let mut sum = 0.0;
            for (i, row) in self.rows.clone().enumerate() {
                let value = entry(self.values[(i, j)]);
                product[row] += value * v[column];
                sum += value * v[row];
            }
            product[column] += sum;
        }
    }
}

/// Links of a part.
#[derive(Clone, Debug, Default)]
pub(crate) struct Links {
    /// Bodies of each block, with its position if it is in the pattern.
    pub(crate) places: Vec<(Coordinates, Coordinates, Option<BlockPosition>)>,
    /// Blocks outside of the pattern.
    pub(crate) blocks: Vec<LinkBlock>,
}

impl Links {
    /// Finds the positions of blocks that couple other bodies than before.
    pub(crate) fn update_places(
        &mut self,
        blocks: &[Block],
        (pattern, layout): (&Pattern, &Layout),
    ) {
        self.places.truncate(blocks.len());
        for (k, &(a, b, _)) in blocks.iter().enumerate() {
            match self.places.get(k) {
                Some(&(c, d, _)) if (a, b) == (c, d) => {}
                known => {
                    let place = (a, b, pattern.place_of((a, b), layout));
                    if known.is_some() {
                        self.places[k] = place;
                    } else {
                        self.places.push(place);
                    }
                }
            }
        }
    }
}

//! Addition of blocks to the values of a sparse matrix.

use crate::group::Group;
use crate::layout::{Layout, Node};
use crate::links::{Block, LinkBlock, Links};
use crate::parallel;
use crate::pattern::{BlockPosition, Pattern};
use actin_mechanics::{Coordinates, Loads, Matrix3, State, Stiffness, Vector3};
use nalgebra::{Matrix3x6, Matrix6};
use std::ops::Range;

/// Values of the columns of some nodes.
pub(crate) struct Target<'a> {
    values: &'a mut [f64],
    /// Index of the first of the values.
    first: usize,
    columns: &'a [usize],
    layout: &'a Layout,
    diagonal: &'a [usize],
    /// Nodes whose columns are assembled; all by default.
    pub(crate) is_selected: Option<&'a [bool]>,
}

impl<'a> Target<'a> {
    pub(crate) fn new(values: &'a mut Vec<f64>, pattern: &'a Pattern, layout: &'a Layout) -> Self {
        values.clear();
        values.resize(pattern.symbolic.row_idx().len(), 0.0);
        Self::onto(values, pattern, layout)
    }

    pub(crate) fn onto(values: &'a mut [f64], pattern: &'a Pattern, layout: &'a Layout) -> Self {
        Self {
            values,
            first: 0,
            columns: pattern.symbolic.col_ptr(),
            layout,
            diagonal: &pattern.diagonal,
            is_selected: None,
        }
    }

    /// Sets the columns of the selected nodes among `nodes` to zero.
    pub(crate) fn clear(&mut self, nodes: Range<usize>) {
        for node in nodes {
            if self.selects(node) {
                let columns = self.layout.range(node);
                let entries = self.columns[columns.start]..self.columns[columns.end];
                self.values[entries.start - self.first..entries.end - self.first].fill(0.0);
            }
        }
    }

    /// Adds the blocks of a part, without links outside of the pattern. Returns `false` if the
    /// pattern does not fit.
    pub(crate) fn add_part(
        &mut self,
        state: &State,
        added: &Stiffness,
        (pattern, [start, end]): (&Pattern, [[usize; 2]; 2]),
    ) -> bool {
        let (blocks, links) = (added.blocks(), added.links());
        let is_same = blocks.len() == end[0] - start[0]
            && (!pattern.has_links || links.len() == end[1] - start[1])
            && pattern.fits_from(start, added);
        if is_same {
            self.add_all(state, blocks, &pattern.places[start[0]..]);
        }
        if is_same && pattern.has_links {
            self.add_all(state, links, &pattern.link_places[start[1]..]);
        }
        is_same
    }

    pub(crate) fn add_all(&mut self, state: &State, blocks: &[Block], places: &[BlockPosition]) {
        for (&(a, b, block), &place) in blocks.iter().zip(places) {
            if self.has(place) {
                self.add(state, a, b, &block, place);
            }
        }
    }

    /// Adds the blocks that are in the pattern, and replaces `links` by the others.
    pub(crate) fn add_links(
        &mut self,
        state: &State,
        blocks: &[Block],
        (pattern, links): (&Pattern, &mut Links),
    ) {
        links.update_places(blocks, (pattern, self.layout));
        links.blocks.clear();
        for (&(a, b, block), &(_, _, place)) in blocks.iter().zip(&links.places) {
            match place {
                Some(place) if self.has(place) => self.add(state, a, b, &block, place),
                Some(_) => {}
                None => self.push_block(state, (a, b, block), &mut links.blocks),
            }
        }
    }

    fn push_block(&self, state: &State, (a, b, block): Block, links: &mut Vec<LinkBlock>) {
        if let (Some(first), Some(second)) = (self.layout.node_of(a), self.layout.node_of(b)) {
            links.push(LinkBlock {
                nodes: [first, second],
                rows: self.layout.range(first),
                columns: self.layout.range(second),
                values: self.in_unknowns(state, a, b, &block),
            });
        }
    }

    fn has(&self, place: BlockPosition) -> bool {
        place.column_node().is_some_and(|node| self.selects(node))
    }

    fn selects(&self, node: usize) -> bool {
        self.is_selected.is_none_or(|is_selected| is_selected[node])
    }

    /// Targets for the columns of disjoint ranges of nodes (ascending).
    pub(crate) fn split(
        self,
        nodes: impl Iterator<Item = Range<usize>>,
    ) -> impl Iterator<Item = Self> {
        let (columns, layout) = (self.columns, self.layout);
        let (mut firsts, nodes) = (Vec::new(), Vec::from_iter(nodes));
        let entries = nodes.iter().map(|nodes| {
            let first = columns[layout.range(nodes.start).start];
            firsts.push(first);
            first..columns[layout.range(nodes.end - 1).end]
        });
        let entries = Vec::from_iter(entries);
        let values = parallel::slices(self.values, entries.into_iter());
        values.zip(firsts).map(move |(values, first)| Self {
            values,
            first,
            columns,
            layout,
            diagonal: self.diagonal,
            is_selected: self.is_selected,
        })
    }

    fn add(
        &mut self,
        state: &State,
        a: Coordinates,
        b: Coordinates,
        block: &Matrix3,
        place: BlockPosition,
    ) {
        match place {
            BlockPosition::Outside => {}
            BlockPosition::Body { at, .. } => self.add_columns(at, |j| j + 1, block),
            BlockPosition::Bodies { at, transposed, .. } if transposed => {
                self.add_columns(at, |_| 3, &block.transpose());
            }
            BlockPosition::Bodies { at, .. } => self.add_columns(at, |_| 3, block),
            BlockPosition::Diagonal { node, twice } => {
                let block = self.in_unknowns(state, a, b, block);
                let block = if twice {
                    block + block.transpose()
                } else {
                    block
                };
                self.add_diagonal(node, |i, j| block[(i, j)]);
            }
            BlockPosition::Above {
                row,
                column,
                local,
                transposed,
            } => {
                let block = self.in_unknowns(state, a, b, block);
                self.add_above(row, column, local, transposed, |i, j| block[(i, j)]);
            }
        }
    }

    /// Adds the first `rows` of each column.
    fn add_columns(&mut self, at: [usize; 3], rows: impl Fn(usize) -> usize, block: &Matrix3) {
        for (j, first) in at.into_iter().enumerate() {
            let first = first - self.first;
            let values = &mut self.values[first..first + rows(j)];
            for (value, entry) in values.iter_mut().zip(block.column(j).iter()) {
                *value += entry;
            }
        }
    }

    fn add_diagonal(&mut self, node: usize, block: impl Fn(usize, usize) -> f64) {
        let start = self.diagonal[node];
        for (j, column) in self.layout.range(node).enumerate() {
            let first = self.columns[column] + start - self.first;
            for (i, value) in self.values[first..=first + j].iter_mut().enumerate() {
                *value += block(i, j);
            }
        }
    }

    fn add_above(
        &mut self,
        row: usize,
        column: usize,
        local: usize,
        transposed: bool,
        block: impl Fn(usize, usize) -> f64,
    ) {
        let rows = self.layout.range(row).len();
        for (j, column) in self.layout.range(column).enumerate() {
            let first = self.columns[column] + local - self.first;
            for (i, value) in self.values[first..first + rows].iter_mut().enumerate() {
                *value += if transposed { block(j, i) } else { block(i, j) };
            }
        }
    }

    /// `A^T block B` with the derivatives `A`, `B` with respect to the unknowns.
    fn in_unknowns(
        &self,
        state: &State,
        a: Coordinates,
        b: Coordinates,
        block: &Matrix3,
    ) -> Matrix6<f64> {
        if [a, b].into_iter().all(|body| self.is_single(body)) {
            return block.fixed_resize(0.0);
        }
        let a = self.derivative(state, a);
        let b = self.derivative(state, b);
        a.transpose() * (block * b)
    }

    fn is_single(&self, body: Coordinates) -> bool {
        let node = self.layout.node_of(body).map(|node| self.layout.node(node));
        !matches!(node, Some(Node::Group(_)))
    }

    /// Zero padded.
    fn derivative(&self, state: &State, body: Coordinates) -> Matrix3x6<f64> {
        let mut derivative = Matrix3x6::zeros();
        let node = self.layout.node_of(body).map(|node| self.layout.node(node));
        let Some(Node::Group(g)) = node else {
            derivative.fixed_view_mut::<3, 3>(0, 0).fill_diagonal(1.0);
            return derivative;
        };
        let group = &self.layout.groups()[g];
        for (k, column) in columns_of(group, state, body).enumerate() {
            derivative.set_column(k, &column);
        }
        derivative
    }

    /// Second derivative of a rotated point `x = p + exp(theta) r` times its force:
    ///
    /// `d^2 x . g = (theta . g)(theta . r) - theta^2 (g . r)` with `g = -force`. Frames have no
    /// such term.
    pub(crate) fn add_turning_of_groups(&mut self, state: &State, loads: &Loads) {
        let layout = self.layout;
        for k in 0..layout.len() {
            let Node::Group(g) = layout.node(k) else {
                continue;
            };
            let group = &layout.groups()[g];
            if group.rotations.is_empty() || !self.selects(k) {
                continue;
            }
            let curvature = turning(group, state, loads);
            let skip = group.translations.len();
            self.add_diagonal(k, |i, j| {
                if i < skip || j < skip {
                    return 0.0;
                }
                let (a, b) = (group.rotations[i - skip], group.rotations[j - skip]);
                a.dot(&(curvature * b))
            });
        }
    }
}

/// `sum (g r^T + r g^T) / 2 - (g . r) I` over the points of a group.
fn turning(group: &Group, state: &State, loads: &Loads) -> Matrix3 {
    let pivot = group.pivot.position(state);
    group
        .points
        .iter()
        .map(|&i| {
            let r = state.points.position.get(i) - pivot;
            let g = -loads.force.get(i);
            0.5 * (g * r.transpose() + r * g.transpose()) - Matrix3::identity() * g.dot(&r)
        })
        .sum()
}

fn columns_of<'a>(
    group: &'a Group,
    state: &'a State,
    body: Coordinates,
) -> impl Iterator<Item = Vector3> + 'a {
    let pivot = group.pivot.position(state);
    let along = group.translations.iter().map(move |&d| match body {
        Coordinates::Point(_) => d,
        Coordinates::Frame(_) => Vector3::zeros(),
    });
    let about = group.rotations.iter().map(move |axis| match body {
        Coordinates::Point(i) => axis.cross(&(state.points.position.get(i) - pivot)),
        Coordinates::Frame(i) => state.frames.orientation.get(i).inverse() * axis,
    });
    along.chain(about)
}

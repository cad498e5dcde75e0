//! Assembly of the sparse stiffness.

use crate::chain::Chain;
use crate::layout::{Layout, Node};
use crate::links::{Block, LinkBlock, Links};
use crate::pattern::{BlockPosition, Pattern};
use crate::ties::Ties;
use actin_mechanics::{Coordinates, Interaction, Loads, Matrix3, SecondOrder, State, Stiffness};
use std::collections::BTreeMap;

/// Matrix as a sum of parts, each of which couples bodies of few components.
pub trait MatrixParts {
    /// Number of parts.
    fn count(&self) -> usize;

    /// Adds the blocks of part `k`.
    fn add(&self, k: usize, state: &State, stiffness: &mut Stiffness);
}

/// Stiffness of interactions and other blocks.
pub(crate) struct Sum<'a> {
    pub(crate) interactions: &'a [Box<dyn Interaction>],
    pub(crate) other: Option<&'a dyn SecondOrder>,
}

impl MatrixParts for Sum<'_> {
    fn count(&self) -> usize {
        self.interactions.len() + usize::from(self.other.is_some())
    }

    fn add(&self, k: usize, state: &State, stiffness: &mut Stiffness) {
        let interaction = self.interactions.get(k);
        let second_order = interaction.map_or(self.other, |i| i.second_order());
        if let Some(second_order) = second_order {
            second_order.add_stiffness(state, stiffness);
        }
    }
}

/// Stiffness in the unknowns, upper triangle by columns, and entries of links.
#[derive(Debug, Default)]
pub(crate) struct Assembly {
    blocks: Stiffness,
    /// First block and first link of each part, and the numbers of all blocks and links.
    starts: Vec<[usize; 2]>,
    /// Links of each part.
    links: Vec<Links>,
    /// Chosen parts with such blocks.
    linked: Vec<usize>,
    /// Parts of the present solve.
    is_chosen: Vec<bool>,
    pattern: Option<Pattern>,
    pub(crate) values: Vec<f64>,
    ties: Ties,
    tie_lengths: Vec<f64>,
    chain: Chain,
    tie_blocks: Stiffness,
    tie_places: Vec<BlockPosition>,
    pub(crate) tie_values: Vec<f64>,
    turning_blocks: Stiffness,
    turning_places: Vec<BlockPosition>,
    turn_length: f64,
}

impl Assembly {
    /// `turn_length` (nm) weights a rotation of 1 rad.
    pub(crate) fn new(turn_length: f64) -> Self {
        Self {
            turn_length,
            ..Self::default()
        }
    }

    pub(crate) fn update(
        &mut self,
        interactions: &[Box<dyn Interaction>],
        state: &State,
        layout: &mut Layout,
    ) -> bool {
        let other = None;
        let sum = Sum {
            interactions,
            other,
        };
        self.update_with(&sum, state, layout)
    }

    /// Assembles a sum of parts. Returns `true` if the pattern is new; the unknowns may then have
    /// been reordered.
    pub(crate) fn update_with(
        &mut self,
        parts: &dyn MatrixParts,
        state: &State,
        layout: &mut Layout,
    ) -> bool {
        self.choose(&vec![true; parts.count()]);
        self.blocks.clear();
        self.starts.clear();
        for k in 0..parts.count() {
            self.starts.push(self.lengths());
            parts.add(k, state, &mut self.blocks);
        }
        self.starts.push(self.lengths());
        let is_new = !self
            .pattern
            .as_ref()
            .is_some_and(|pattern| pattern.fits(&self.blocks));
        if is_new {
            self.pattern = Some(Pattern::new(&self.blocks, layout));
            self.ties = Ties::new(self.blocks.blocks(), self.turn_length);
            let (points, frames) = (state.points.len(), state.frames.len());
            self.chain = Chain::new(layout, &self.ties, points, frames);
            self.tie_places.clear();
            self.turning_places.clear();
            self.links.clear();
        }
        self.tie_lengths = self.ties.lengths(state);
        let pattern = self
            .pattern
            .as_ref()
            .expect("the pattern was created above");
        let mut target = Target::new(&mut self.values, pattern, layout);
        target.add_all(self.blocks.blocks(), &pattern.places);
        if pattern.has_links {
            target.add_all(self.blocks.links(), &pattern.link_places);
        } else {
            self.links.resize(parts.count(), Links::default());
            for (links, starts) in self.links.iter_mut().zip(self.starts.windows(2)) {
                let blocks = &self.blocks.links()[starts[0][1]..starts[1][1]];
                target.add_links(blocks, (pattern, links));
            }
        }
        self.find_linked();
        is_new
    }

    fn lengths(&self) -> [usize; 2] {
        [self.blocks.blocks().len(), self.blocks.links().len()]
    }

    fn find_linked(&mut self) {
        self.linked.clear();
        let links = self.links.iter().zip(&self.is_chosen).enumerate();
        let linked =
            links.filter(|(_, (links, is_chosen))| **is_chosen && !links.blocks.is_empty());
        self.linked.extend(linked.map(|(k, _)| k));
    }

    /// Assembles the columns of the selected nodes from the chosen parts, which must be all parts
    /// with entries in these columns. Returns `false` if the pattern does not fit.
    pub(crate) fn update_nodes(
        &mut self,
        (parts, is_chosen): (&dyn MatrixParts, &[bool]),
        is_selected: &[bool],
        state: &State,
        layout: &Layout,
    ) -> bool {
        let Some(pattern) = &self.pattern else {
            return false;
        };
        if self.starts.len() != parts.count() + 1 {
            return false;
        }
        let ends = pattern.symbolic.col_ptr();
        for (node, columns) in layout.nodes().map(|(_, range)| range).enumerate() {
            if is_selected[node] {
                self.values[ends[columns.start]..ends[columns.end]].fill(0.0);
            }
        }
        let mut target = Target {
            is_selected: Some(is_selected),
            ..Target::onto(&mut self.values, pattern, layout)
        };
        for k in (0..parts.count()).filter(|&k| is_chosen[k]) {
            self.blocks.clear();
            parts.add(k, state, &mut self.blocks);
            let (start, end) = (self.starts[k], self.starts[k + 1]);
            let (blocks, links) = (self.blocks.blocks(), self.blocks.links());
            if blocks.len() != end[0] - start[0] || !pattern.fits_from(start, &self.blocks) {
                return false;
            }
            target.add_all(blocks, &pattern.places[start[0]..]);
            if !pattern.has_links {
                target.add_links(links, (pattern, &mut self.links[k]));
            } else if links.len() == end[1] - start[1] {
                target.add_all(links, &pattern.link_places[start[1]..]);
            } else {
                return false;
            }
        }
        self.find_linked();
        true
    }

    /// Chooses the parts of the next solve. Other parts must have no entries in its columns.
    pub(crate) fn choose(&mut self, is_chosen: &[bool]) {
        self.is_chosen.clear();
        self.is_chosen.extend_from_slice(is_chosen);
    }

    /// Pairs of nodes that are coupled outside of the pattern.
    pub(crate) fn linked_nodes(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        let links = self.links.iter().flat_map(|links| &links.blocks);
        links.map(|block| block.nodes)
    }

    /// Adds the product of the blocks outside of the pattern and `v`.
    pub(crate) fn add_product_of_links(&self, v: &[f64], product: &mut [f64]) {
        for block in self.linked.iter().flat_map(|&k| &self.links[k].blocks) {
            block.add_product(v, product, |value| value);
        }
    }

    pub(crate) fn add_turning(&mut self, state: &State, loads: &Loads, layout: &Layout) {
        let pattern = self.pattern.as_ref().expect("the stiffness is assembled");
        self.turning_blocks.clear();
        self.chain
            .add_turning(state, loads, &mut self.turning_blocks);
        if self.turning_places.is_empty() {
            self.turning_places = pattern.places_of(&self.turning_blocks, layout);
        }
        let mut target = Target::onto(&mut self.values, pattern, layout);
        let blocks = self.turning_blocks.blocks();
        target.add_all(blocks, &self.turning_places);
    }

    /// Softness of each tie (pN/nm): magnitude of the most negative stiffness between its points,
    /// or zero.
    pub(crate) fn giving_way(&self) -> Vec<f64> {
        let mut between = BTreeMap::<(usize, usize), Matrix3>::new();
        for &(a, b, block) in self.blocks.blocks() {
            if let (Coordinates::Point(i), Coordinates::Point(j)) = (a, b)
                && i != j
            {
                *between.entry((i.min(j), i.max(j))).or_default() -= block;
            }
        }
        let negative = |block: Matrix3| {
            let symmetric = 0.5 * (block + block.transpose());
            (-symmetric.symmetric_eigenvalues().min()).max(0.0)
        };
        let negative: BTreeMap<_, _> = between
            .into_iter()
            .map(|(pair, block)| (pair, negative(block)))
            .collect();
        let of = |i: usize, j: usize| negative.get(&(i.min(j), i.max(j))).copied();
        self.ties.spread(|i, j| of(i, j).unwrap_or(0.0))
    }

    pub(crate) fn assemble_ties(&mut self, state: &State, layout: &Layout, weights: &[f64]) {
        let pattern = self.pattern.as_ref().expect("the stiffness is assembled");
        self.tie_blocks.clear();
        self.ties.add_blocks(state, weights, &mut self.tie_blocks);
        if self.tie_places.is_empty() {
            self.tie_places = pattern.places_of(&self.tie_blocks, layout);
        }
        let mut target = Target::new(&mut self.tie_values, pattern, layout);
        target.add_all(self.tie_blocks.blocks(), &self.tie_places);
    }

    pub(crate) fn ties(&self) -> &Ties {
        &self.ties
    }

    pub(crate) fn tie_lengths(&self) -> &[f64] {
        &self.tie_lengths
    }

    pub(crate) fn chain(&self) -> &Chain {
        &self.chain
    }

    pub(crate) fn pattern(&self) -> &Pattern {
        self.pattern
            .as_ref()
            .expect("the stiffness has been assembled")
    }

    pub(crate) fn largest_diagonal(&self) -> f64 {
        // The diagonal entry is the last of its column.
        let ends = &self.pattern().symbolic.col_ptr()[1..];
        let diagonal = ends.iter().map(|&end| self.values[end - 1].abs());
        diagonal.fold(0.0, f64::max)
    }

    pub(crate) fn largest_entry(&self) -> f64 {
        self.values
            .iter()
            .map(|value| value.abs())
            .fold(0.0, f64::max)
    }

    /// Scale of the rounding error of each entry: its magnitude, or the geometric mean of the
    /// diagonal blocks if that is larger. Directions without stiffness are perturbed, bodies
    /// without interactions are not.
    pub(crate) fn scales(&self, layout: &Layout) -> Vec<f64> {
        let symbolic = &self.pattern().symbolic;
        let (starts, rows) = (symbolic.col_ptr(), symbolic.row_idx());
        let mut of_row = vec![0.0; layout.unknowns()];
        for (_, own) in layout.nodes() {
            let of_column = |column: usize| {
                let places = starts[column]..starts[column + 1];
                let within = places.filter(|&at| own.contains(&rows[at]));
                within.map(|at| self.values[at].abs()).fold(0.0, f64::max)
            };
            let largest = own.clone().map(of_column).fold(0.0, f64::max);
            of_row[own].fill(largest);
        }
        let mut scales = Vec::with_capacity(self.values.len());
        for column in 0..of_row.len() {
            scales.extend((starts[column]..starts[column + 1]).map(|at| {
                let mean = (of_row[rows[at]] * of_row[column]).sqrt();
                self.values[at].abs().max(mean)
            }));
        }
        scales
    }

    pub(crate) fn multiply(&self, v: &[f64], out: &mut [f64]) {
        self.multiply_with(v, out, |value| value);
    }

    pub(crate) fn multiply_absolute(&self, v: &[f64], out: &mut [f64]) {
        self.multiply_with(v, out, f64::abs);
    }

    fn multiply_with(&self, v: &[f64], out: &mut [f64], entry: impl Fn(f64) -> f64) {
        let symbolic = &self.pattern().symbolic;
        out.fill(0.0);
        for column in 0..v.len() {
            for at in symbolic.col_ptr()[column]..symbolic.col_ptr()[column + 1] {
                let row = symbolic.row_idx()[at];
                let value = entry(self.values[at]);
                out[row] += value * v[column];
                if row != column {
                    out[column] += value * v[row];
                }
            }
        }
        for block in self.linked.iter().flat_map(|&k| &self.links[k].blocks) {
            block.add_product(v, out, &entry);
        }
    }
}

struct Target<'a> {
    values: &'a mut [f64],
    columns: &'a [usize],
    layout: &'a Layout,
    diagonal: &'a [usize],
    /// Nodes whose columns are assembled; all by default.
    is_selected: Option<&'a [bool]>,
}

impl<'a> Target<'a> {
    fn new(values: &'a mut Vec<f64>, pattern: &'a Pattern, layout: &'a Layout) -> Self {
        values.clear();
        values.resize(pattern.symbolic.row_idx().len(), 0.0);
        Self::onto(values, pattern, layout)
    }

    fn onto(values: &'a mut [f64], pattern: &'a Pattern, layout: &'a Layout) -> Self {
        Self {
            values,
            columns: pattern.symbolic.col_ptr(),
            layout,
            diagonal: &pattern.diagonal,
            is_selected: None,
        }
    }

    fn add_all(&mut self, blocks: &[Block], places: &[BlockPosition]) {
        for (&(a, b, block), &place) in blocks.iter().zip(places) {
            if self.has(place) {
                self.add(a, b, &block, place);
            }
        }
    }

    /// Adds the blocks that are in the pattern, and replaces `links` by the others.
    fn add_links(&mut self, blocks: &[Block], (pattern, links): (&Pattern, &mut Links)) {
        links.update_places(blocks, (pattern, self.layout));
        links.blocks.clear();
        for (&(a, b, block), &(_, _, place)) in blocks.iter().zip(&links.places) {
            match place {
                Some(place) if self.has(place) => self.add(a, b, &block, place),
                Some(_) => {}
                None => self.push_block((a, b, block), &mut links.blocks),
            }
        }
    }

    fn push_block(&self, (a, b, block): Block, links: &mut Vec<LinkBlock>) {
        if let (Some(first), Some(second)) = (self.layout.node_of(a), self.layout.node_of(b)) {
            links.push(LinkBlock {
                nodes: [first, second],
                rows: self.layout.range(first),
                columns: self.layout.range(second),
                values: self.in_unknowns(a, b, &block),
            });
        }
    }

    fn has(&self, place: BlockPosition) -> bool {
        let node = match place {
            BlockPosition::Outside => return false,
            BlockPosition::Diagonal { node, .. } | BlockPosition::Body { node, .. } => node,
            BlockPosition::Above { column, .. } | BlockPosition::Bodies { column, .. } => column,
        };
        self.is_selected.is_none_or(|is_selected| is_selected[node])
    }

    fn add(&mut self, a: Coordinates, b: Coordinates, block: &Matrix3, place: BlockPosition) {
        match place {
            BlockPosition::Outside => {}
            BlockPosition::Body { at, .. } => self.add_columns(at, |j| j + 1, block),
            BlockPosition::Bodies { at, transposed, .. } if transposed => {
                self.add_columns(at, |_| 3, &block.transpose());
            }
            BlockPosition::Bodies { at, .. } => self.add_columns(at, |_| 3, block),
            BlockPosition::Diagonal { node, twice } => {
                let block = self.in_unknowns(a, b, block);
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
                let block = self.in_unknowns(a, b, block);
                self.add_above(row, column, local, transposed, |i, j| block[(i, j)]);
            }
        }
    }

    /// Adds the first `rows` of each column.
    fn add_columns(&mut self, at: [usize; 3], rows: impl Fn(usize) -> usize, block: &Matrix3) {
        for (j, first) in at.into_iter().enumerate() {
            let values = &mut self.values[first..first + rows(j)];
            for (value, entry) in values.iter_mut().zip(block.column(j).iter()) {
                *value += entry;
            }
        }
    }

    fn add_diagonal(&mut self, node: usize, block: impl Fn(usize, usize) -> f64) {
        let start = self.diagonal[node];
        for (j, column) in self.layout.range(node).enumerate() {
            let first = self.columns[column] + start;
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
            let first = self.columns[column] + local;
            for (i, value) in self.values[first..first + rows].iter_mut().enumerate() {
                *value += if transposed { block(j, i) } else { block(i, j) };
            }
        }
    }

    /// `A^T block B` with the derivatives `A`, `B` with respect to the unknowns.
    fn in_unknowns(&self, a: Coordinates, b: Coordinates, block: &Matrix3) -> Matrix3 {
        match [a, b].map(|body| self.directions(body)) {
            [None, None] => *block,
            directions => {
                let [a, b] = directions.map(|one| one.unwrap_or_else(Matrix3::identity));
                a.transpose() * block * b
            }
        }
    }

    /// Directions of the slider of a body, as columns (zero padded).
    fn directions(&self, body: Coordinates) -> Option<Matrix3> {
        let Node::Slider(s) = self.layout.node(self.layout.node_of(body)?) else {
            return None;
        };
        let mut columns = Matrix3::zeros();
        for (k, direction) in self.layout.sliders()[s].directions.iter().enumerate() {
            columns.set_column(k, direction);
        }
        Some(columns)
    }
}

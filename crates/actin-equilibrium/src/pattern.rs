//! Positions of stiffness blocks in a sparse symmetric matrix, stored as its upper triangle by
//! columns with sorted rows.

use crate::layout::{Layout, Node, Order};
use actin_mechanics::{Coordinates, Matrix3, Stiffness};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::amd;
use faer::sparse::linalg::cholesky::simplicial;
use faer::sparse::{SymbolicSparseColMat, SymbolicSparseColMatRef};
use std::ops::Range;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BlockPosition {
    /// Not stored: one of the bodies does not move.
    Outside,
    /// On the diagonal of a body; index of the first value of each column.
    Body { node: usize, at: [usize; 3] },
    /// Above the diagonal, between two bodies; index of the first value of each column.
    Bodies {
        /// Later node.
        column: usize,
        at: [usize; 3],
        transposed: bool,
    },
    /// On the diagonal of a node.
    Diagonal {
        node: usize,
        /// The transposed block is added as well.
        twice: bool,
    },
    /// Above the diagonal.
    Above {
        row: usize,
        column: usize,
        /// Index of the first row within each column.
        local: usize,
        transposed: bool,
    },
}

/// Sparsity of a stiffness with the position of each block.
#[derive(Debug)]
pub(crate) struct Pattern {
    pub(crate) symbolic: SymbolicSparseColMat<usize>,
    pub(crate) places: Vec<BlockPosition>,
    /// First diagonal row within the columns of each node.
    pub(crate) diagonal: Vec<usize>,
    bodies: Vec<(Coordinates, Coordinates)>,
    neighbours: Vec<Vec<usize>>,
    starts: Vec<Vec<usize>>,
}

/// Sparse matrix without loose couplings.
#[derive(Debug)]
pub(crate) struct Chains {
    /// Upper triangle.
    pub(crate) symbolic: SymbolicSparseColMat<usize>,
    /// Index of each entry in the full pattern.
    pub(crate) places: Vec<usize>,
    /// Other entries of the full pattern.
    pub(crate) links: Links,
}

/// Entries that couple chains, by columns.
#[derive(Debug)]
pub(crate) struct Links {
    starts: Vec<usize>,
    /// Row, and index in the full pattern.
    links: Vec<(usize, usize)>,
}

impl Links {
    /// Adds the product with `v`, which is zero outside of the columns; only these entries of the
    /// product are valid.
    pub(crate) fn add_product(
        &self,
        values: &[f64],
        columns: &[Range<usize>],
        v: &[f64],
        product: &mut [f64],
    ) {
        for column in columns.iter().cloned().flatten() {
            let mut sum = 0.0;
            for &(row, place) in &self.links[self.starts[column]..self.starts[column + 1]] {
                let value = values[place];
                product[row] += value * v[column];
                sum += value * v[row];
            }
            product[column] += sum;
        }
    }
}

impl Pattern {
    /// Fixes the order of the nodes of `layout`.
    pub(crate) fn new(stiffness: &Stiffness, layout: &mut Layout) -> Self {
        let blocks = stiffness.blocks();
        let mut neighbours = neighbours(blocks, layout);
        if layout.order() != Order::Settled {
            neighbours = settle(neighbours, blocks, layout);
        }
        let starts: Vec<Vec<usize>> = neighbours
            .iter()
            .map(|rows| running_sum(rows.iter().map(|&row| layout.range(row).len())))
            .collect();
        let symbolic = upper_triangle(&neighbours, layout);
        Self {
            places: places(blocks, layout, (&neighbours, &starts), symbolic.col_ptr()),
            symbolic,
            diagonal: starts.iter().map(|s| s[s.len() - 1]).collect(),
            bodies: blocks.iter().map(|&(a, b, _)| (a, b)).collect(),
            neighbours,
            starts,
        }
    }

    pub(crate) fn places_of(&self, stiffness: &Stiffness, layout: &Layout) -> Vec<BlockPosition> {
        let sparsity = (self.neighbours.as_slice(), self.starts.as_slice());
        places(
            stiffness.blocks(),
            layout,
            sparsity,
            self.symbolic.col_ptr(),
        )
    }

    /// Upper triangle without loose couplings, with indices in the full pattern, and the loose
    /// entries.
    pub(crate) fn chains(&self, layout: &Layout) -> Chains {
        let symbolic = upper_triangle(&without_loose(&self.neighbours, layout), layout);
        let (mut places, mut links) = (Vec::new(), Vec::new());
        let mut starts = vec![0];
        for column in 0..symbolic.ncols() {
            let own = symbolic.col_ptr()[column]..symbolic.col_ptr()[column + 1];
            let own = &symbolic.row_idx()[own];
            for place in self.symbolic.col_ptr()[column]..self.symbolic.col_ptr()[column + 1] {
                let row = self.symbolic.row_idx()[place];
                if own.binary_search(&row).is_ok() {
                    places.push(place);
                } else {
                    links.push((row, place));
                }
            }
            starts.push(links.len());
        }
        Chains {
            symbolic,
            places,
            links: Links { starts, links },
        }
    }

    /// The blocks couple the same bodies in the same order.
    pub(crate) fn fits(&self, stiffness: &Stiffness) -> bool {
        stiffness.blocks().len() == self.bodies.len() && self.fits_from(0, stiffness)
    }

    /// The blocks couple the same bodies as the blocks of the pattern from index `start`.
    pub(crate) fn fits_from(&self, start: usize, stiffness: &Stiffness) -> bool {
        let blocks = stiffness.blocks().iter();
        self.bodies.get(start..).is_some_and(|bodies| {
            blocks.len() <= bodies.len()
                && blocks.zip(bodies).all(|(&(a, b, _), &pair)| (a, b) == pair)
        })
    }
}

type Block = (Coordinates, Coordinates, Matrix3);

/// Sorted earlier nodes coupled to each node.
fn neighbours(blocks: &[Block], layout: &Layout) -> Vec<Vec<usize>> {
    let mut neighbours = vec![Vec::new(); layout.len()];
    for &(a, b, _) in blocks {
        if let (Some(a), Some(b)) = (layout.node_of(a), layout.node_of(b))
            && a != b
        {
            neighbours[a.max(b)].push(a.min(b));
        }
    }
    for rows in &mut neighbours {
        rows.sort_unstable();
        rows.dedup();
    }
    neighbours
}

/// Typical number of iterations of conjugate gradients.
const ITERATIONS: usize = 20;

fn without_loose(neighbours: &[Vec<usize>], layout: &Layout) -> Vec<Vec<usize>> {
    let body = |node| match layout.node(node) {
        Node::Point(i) => Some(Coordinates::Point(i)),
        Node::Frame(i) => Some(Coordinates::Frame(i)),
        Node::Group(_) => None,
    };
    let is_kept = |a: usize, b: usize| match (body(a), body(b)) {
        (Some(a), Some(b)) => !layout.is_loose(a, b),
        _ => true,
    };
    let columns = neighbours.iter().enumerate();
    columns
        .map(|(column, rows)| {
            let rows = rows.iter().copied();
            rows.filter(|&row| is_kept(row, column)).collect()
        })
        .collect()
}

fn prefers_gradients(neighbours: &[Vec<usize>], layout: &Layout, direct: usize) -> bool {
    let whole = upper_triangle(neighbours, layout);
    let chains = upper_triangle(&without_loose(neighbours, layout), layout);
    let entries = whole.row_idx().len() + chains.row_idx().len();
    let iterative = factor_operations(chains.as_ref()) + 2 * ITERATIONS * entries;
    iterative < 3 * direct
}

/// Fixes the order; returns the couplings in the new order.
fn settle(present: Vec<Vec<usize>>, blocks: &[Block], layout: &mut Layout) -> Vec<Vec<usize>> {
    let mut sought = layout.clone();
    sought.reorder(&minimum_degree(&present));
    let reordered = neighbours(blocks, &sought);
    let cost = |neighbours: &[Vec<usize>], layout: &Layout| {
        factor_operations(upper_triangle(neighbours, layout).as_ref())
    };
    if layout.order() == Order::Compared {
        let costs = [cost(&present, layout), cost(&reordered, &sought)];
        let least = costs[0].min(costs[1]);
        if layout.allows_gradients() && prefers_gradients(&present, layout, least) {
            layout.choose_gradients();
            return present;
        }
        if costs[0] <= costs[1] {
            layout.settle();
            return present;
        }
    }
    *layout = sought;
    reordered
}

fn minimum_degree(neighbours: &[Vec<usize>]) -> Vec<usize> {
    let n = neighbours.len();
    let columns = running_sum(neighbours.iter().map(Vec::len));
    let rows = neighbours.concat();
    let graph = SymbolicSparseColMatRef::new_checked(n, n, &columns, None, &rows);
    let (mut forward, mut inverse) = (vec![0; n], vec![0; n]);
    let mut memory = MemBuffer::new(amd::order_scratch::<usize>(n, rows.len()));
    amd::order(
        &mut forward,
        &mut inverse,
        graph,
        amd::Control::default(),
        MemStack::new(&mut memory),
    )
    .expect("node indices do not overflow");
    forward
}

/// Sorted earlier nodes coupled to each node, and their first rows.
type Sparsity<'a> = (&'a [Vec<usize>], &'a [Vec<usize>]);

fn places(
    blocks: &[Block],
    layout: &Layout,
    sparsity: Sparsity<'_>,
    columns: &[usize],
) -> Vec<BlockPosition> {
    blocks
        .iter()
        .map(|&(a, b, _)| place(a, b, layout, sparsity, columns))
        .collect()
}

fn place(
    a: Coordinates,
    b: Coordinates,
    layout: &Layout,
    (neighbours, starts): Sparsity<'_>,
    columns: &[usize],
) -> BlockPosition {
    let (Some(first), Some(second)) = (layout.node_of(a), layout.node_of(b)) else {
        return BlockPosition::Outside;
    };
    let (row, column) = (first.min(second), first.max(second));
    let start = layout.range(column).start;
    let values = |local: usize| std::array::from_fn(|j| columns[start + j] + local);
    let is_group = |node| matches!(layout.node(node), Node::Group(_));
    if first == second {
        let local = starts[column][starts[column].len() - 1];
        return if is_group(first) {
            let twice = a != b;
            BlockPosition::Diagonal { node: first, twice }
        } else {
            let at = values(local);
            BlockPosition::Body { node: first, at }
        };
    }
    let at = neighbours[column]
        .binary_search(&row)
        .expect("the pattern was made from the same blocks");
    let (local, transposed) = (starts[column][at], first > second);
    if is_group(row) || is_group(column) {
        return BlockPosition::Above {
            row,
            column,
            local,
            transposed,
        };
    }
    let at = values(local);
    BlockPosition::Bodies {
        column,
        at,
        transposed,
    }
}

fn upper_triangle(neighbours: &[Vec<usize>], layout: &Layout) -> SymbolicSparseColMat<usize> {
    let n = layout.unknowns();
    let mut columns = Vec::with_capacity(n + 1);
    let mut rows = Vec::new();
    columns.push(0);
    for (node, above) in neighbours.iter().enumerate() {
        let own = layout.range(node);
        for column in own.clone() {
            for &row in above {
                rows.extend(layout.range(row));
            }
            rows.extend(own.start..=column);
            columns.push(rows.len());
        }
    }
    SymbolicSparseColMat::new_checked(n, n, columns, None, rows)
}

/// `0, a_0, a_0 + a_1, ...`
fn running_sum(lengths: impl Iterator<Item = usize>) -> Vec<usize> {
    let mut sums = vec![0];
    for length in lengths {
        sums.push(sums[sums.len() - 1] + length);
    }
    sums
}

/// Half the sum of the squared column counts of the factor.
fn factor_operations(upper: SymbolicSparseColMatRef<'_, usize>) -> usize {
    let n = upper.ncols();
    let (mut tree, mut counts) = (vec![0isize; n], vec![0usize; n]);
    let scratch =
        simplicial::prefactorize_symbolic_cholesky_scratch::<usize>(n, upper.row_idx().len());
    let mut memory = MemBuffer::new(scratch);
    let stack = MemStack::new(&mut memory);
    simplicial::prefactorize_symbolic_cholesky(&mut tree, &mut counts, upper, stack);
    counts.iter().map(|count| count * count).sum::<usize>() / 2
}

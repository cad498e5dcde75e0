//! Positions of stiffness blocks in a sparse symmetric matrix, stored as its upper triangle by
//! columns with sorted rows.

use crate::layout::{GradientUse, Layout, Node, Order};
use actin_mechanics::{Coordinates, Matrix3, Stiffness};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::amd;
use faer::sparse::linalg::cholesky::simplicial;
use faer::sparse::{SymbolicSparseColMat, SymbolicSparseColMatRef};

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
    /// Position of each block of a link, if `has_links`.
    pub(crate) link_places: Vec<BlockPosition>,
    /// `true` if the pattern includes the links.
    pub(crate) has_links: bool,
    /// First diagonal row within the columns of each node.
    pub(crate) diagonal: Vec<usize>,
    bodies: Vec<Pair>,
    link_bodies: Vec<Pair>,
    neighbours: Vec<Vec<usize>>,
    starts: Vec<Vec<usize>>,
}

impl Pattern {
    /// Fixes the order of the nodes of `layout`. Links are included unless the equations are solved
    /// by conjugate gradients.
    pub(crate) fn new(stiffness: &Stiffness, layout: &mut Layout) -> Self {
        let chains = neighbours(stiffness.blocks().iter(), layout);
        let mut neighbours = neighbours(stiffness.all(), layout);
        if layout.order() != Order::Settled {
            neighbours = settle((neighbours, &chains), stiffness, layout);
        }
        let links = if layout.has_gradients() {
            neighbours = chains;
            &[]
        } else {
            stiffness.links()
        };
        let starts: Vec<Vec<usize>> = neighbours
            .iter()
            .map(|rows| running_sum(rows.iter().map(|&row| layout.range(row).len())))
            .collect();
        let symbolic = upper_triangle(&neighbours, layout);
        let sparsity = (neighbours.as_slice(), starts.as_slice());
        let places = |blocks| places(blocks, layout, sparsity, symbolic.col_ptr());
        let bodies = |blocks: &[Block]| blocks.iter().map(|&(a, b, _)| (a, b)).collect();
        Self {
            places: places(stiffness.blocks()),
            link_places: places(links),
            diagonal: starts.iter().map(|s| s[s.len() - 1]).collect(),
            bodies: bodies(stiffness.blocks()),
            link_bodies: bodies(links),
            has_links: !layout.has_gradients(),
            symbolic,
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

    /// Position of a block; `None` if the pattern has no such entries.
    pub(crate) fn place_of(&self, (a, b): Pair, layout: &Layout) -> Option<BlockPosition> {
        let sparsity = (self.neighbours.as_slice(), self.starts.as_slice());
        place(a, b, layout, sparsity, self.symbolic.col_ptr())
    }

    /// Returns `true` if the blocks couple the same bodies in the same order.
    pub(crate) fn fits(&self, stiffness: &Stiffness) -> bool {
        let has_same_links = !self.has_links || stiffness.links().len() == self.link_bodies.len();
        stiffness.blocks().len() == self.bodies.len()
            && has_same_links
            && self.fits_from([0, 0], stiffness)
    }

    /// Returns `true` if the blocks couple the same bodies as the blocks of the pattern from the
    /// indices `start` of chains and links.
    pub(crate) fn fits_from(&self, start: [usize; 2], stiffness: &Stiffness) -> bool {
        couple(stiffness.blocks(), self.bodies.get(start[0]..))
            && (!self.has_links || couple(stiffness.links(), self.link_bodies.get(start[1]..)))
    }
}

type Pair = (Coordinates, Coordinates);

/// Returns `true` if blocks couple the first of the given pairs.
fn couple(blocks: &[Block], pairs: Option<&[Pair]>) -> bool {
    pairs.is_some_and(|pairs| {
        let mut both = blocks.iter().zip(pairs);
        blocks.len() <= pairs.len() && both.all(|(&(a, b, _), &pair)| (a, b) == pair)
    })
}

type Block = (Coordinates, Coordinates, Matrix3);

/// Sorted earlier nodes coupled to each node.
fn neighbours<'a>(blocks: impl Iterator<Item = &'a Block>, layout: &Layout) -> Vec<Vec<usize>> {
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

/// Returns `true` if conjugate gradients with the factors of the chains cost less than a
/// factorisation of the whole matrix, which requires `direct` operations.
fn prefers_gradients(
    whole: &[Vec<usize>],
    chains: &[Vec<usize>],
    layout: &Layout,
    direct: f64,
) -> bool {
    let [all, own] = [whole, chains].map(|neighbours| entries(neighbours, layout));
    let iterative = factor_operations(chains, layout) + (2 * ITERATIONS * (all + own)) as f64;
    // Measured: iterations are worth it up to this ratio, since they solve for unsolved filaments only.
    // Without links at present, the direct method would fail later.
    iterative < 12.0 * direct || all == own
}

/// Fixes the order; returns the couplings in the new order.
fn settle(
    (present, chains): (Vec<Vec<usize>>, &[Vec<usize>]),
    stiffness: &Stiffness,
    layout: &mut Layout,
) -> Vec<Vec<usize>> {
    let mut sought = layout.clone();
    sought.reorder(&minimum_degree(&present));
    let reordered = neighbours(stiffness.all(), &sought);
    if layout.order() == Order::Compared {
        let costs = [
            factor_operations(&present, layout),
            factor_operations(&reordered, &sought),
        ];
        let least = f64::min(costs[0], costs[1]);
        let is_iterative = match layout.gradient_use() {
            GradientUse::Never => false,
            GradientUse::IfCheaper => prefers_gradients(&present, chains, layout, least),
            GradientUse::Always => true,
        };
        if is_iterative {
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
    let place = |&(a, b, _): &Block| {
        place(a, b, layout, sparsity, columns).expect("the pattern was made from the same blocks")
    };
    blocks.iter().map(place).collect()
}

fn place(
    a: Coordinates,
    b: Coordinates,
    layout: &Layout,
    (neighbours, starts): Sparsity<'_>,
    columns: &[usize],
) -> Option<BlockPosition> {
    let (Some(first), Some(second)) = (layout.node_of(a), layout.node_of(b)) else {
        return Some(BlockPosition::Outside);
    };
    let (row, column) = (first.min(second), first.max(second));
    let start = layout.range(column).start;
    let values = |local: usize| std::array::from_fn(|j| columns[start + j] + local);
    let is_slider = |node| matches!(layout.node(node), Node::Slider(_));
    if first == second {
        let local = starts[column][starts[column].len() - 1];
        return Some(if is_slider(first) {
            let twice = a != b;
            BlockPosition::Diagonal { node: first, twice }
        } else {
            let at = values(local);
            BlockPosition::Body { node: first, at }
        });
    }
    let at = neighbours[column].binary_search(&row).ok()?;
    let (local, transposed) = (starts[column][at], first > second);
    if is_slider(row) || is_slider(column) {
        return Some(BlockPosition::Above {
            row,
            column,
            local,
            transposed,
        });
    }
    let at = values(local);
    Some(BlockPosition::Bodies {
        column,
        at,
        transposed,
    })
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

/// Number of entries of the upper triangle.
fn entries(neighbours: &[Vec<usize>], layout: &Layout) -> usize {
    let size = |node: usize| layout.range(node).len();
    let columns = neighbours.iter().enumerate().map(|(node, above)| {
        let rows: usize = above.iter().map(|&row| size(row)).sum();
        size(node) * rows + size(node) * (size(node) + 1) / 2
    });
    columns.sum()
}

/// Half the sum of the squared column counts of the factor, from the counts of nodes and their mean
/// size: with all coordinates, the counts would take nine times as long.
fn factor_operations(neighbours: &[Vec<usize>], layout: &Layout) -> f64 {
    let n = neighbours.len();
    let columns = running_sum(neighbours.iter().map(Vec::len));
    let rows = neighbours.concat();
    let upper = SymbolicSparseColMatRef::new_checked(n, n, &columns, None, &rows);
    let (mut tree, mut counts) = (vec![0isize; n], vec![0usize; n]);
    let scratch = simplicial::prefactorize_symbolic_cholesky_scratch::<usize>(n, rows.len());
    let mut memory = MemBuffer::new(scratch);
    let stack = MemStack::new(&mut memory);
    simplicial::prefactorize_symbolic_cholesky(&mut tree, &mut counts, upper, stack);
    let sizes = (0..n).map(|node| layout.range(node).len());
    let size = sizes.sum::<usize>() as f64 / n.max(1) as f64;
    let squares = counts.iter().map(|&count| (count as f64).powi(2));
    0.5 * size.powi(3) * squares.sum::<f64>()
}

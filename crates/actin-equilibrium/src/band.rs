//! Elimination of a factor whose columns have contiguous rows, as for a filament. Columns with the
//! same last row form a panel.
#![allow(
    clippy::inline_always,
    reason = "vector code must be compiled into the function that enables the instructions"
)]

use actin_mechanics::wide::{Simd, WithSimd};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::cholesky::simplicial::SymbolicSimplicialCholesky;
use std::ops::Range;

const WIDEST: usize = 6;

/// Number of equal blocks that are solved together. The processor overlaps their operations.
const ABREAST: usize = 4;

#[derive(Debug)]
pub(crate) struct Band {
    /// Start of each column, and end of the last.
    starts: Vec<usize>,
    /// Columns of each panel, and the end of their rows.
    panels: Vec<(Range<usize>, usize)>,
    /// Columns without coupling to other columns, for instance of one filament.
    blocks: Vec<Range<usize>>,
}

impl Band {
    /// Band of a factor; `None` if the rows of a column have gaps.
    pub(crate) fn from_symbolic(symbolic: &SymbolicSimplicialCholesky<usize>) -> Option<Self> {
        let starts = symbolic.col_ptr().to_vec();
        let mut panels: Vec<(Range<usize>, usize)> = Vec::new();
        let mut blocks: Vec<Range<usize>> = Vec::new();
        for column in 0..symbolic.ncols() {
            let rows = &symbolic.row_idx()[starts[column]..starts[column + 1]];
            let end = column + rows.len();
            if !rows.iter().copied().eq(column..end) {
                return None;
            }
            match blocks.last_mut() {
                Some(block) if column < block.end => block.end = block.end.max(end),
                _ => blocks.push(column..end),
            }
            match panels.last_mut() {
                Some((panel, last)) if *last == end && panel.len() < WIDEST => panel.end += 1,
                _ => panels.push((column..column + 1, end)),
            }
        }
        Some(Self {
            starts,
            panels,
            blocks,
        })
    }

    /// Blocks within a range of whole blocks.
    fn blocks_in(&self, range: &Range<usize>) -> &[Range<usize>] {
        let first = self.blocks.partition_point(|b| b.end <= range.start);
        let last = self.blocks.partition_point(|b| b.start < range.end);
        &self.blocks[first..last]
    }

    pub(crate) fn place(
        &self,
        upper: SymbolicSparseColMatRef<'_, usize>,
        matrix: &[f64],
        values: &mut [f64],
        ranges: &[Range<usize>],
    ) {
        for range in ranges {
            values[self.starts[range.start]..self.starts[range.end]].fill(0.0);
        }
        for column in ranges.iter().cloned().flatten() {
            let entries = upper.col_ptr()[column]..upper.col_ptr()[column + 1];
            for (&row, value) in upper.row_idx()[entries.clone()]
                .iter()
                .zip(&matrix[entries])
            {
                values[self.starts[row] + column - row] = *value;
            }
        }
    }
}

pub(crate) struct Eliminate<'a> {
    pub(crate) band: &'a Band,
    pub(crate) values: &'a mut [f64],
    pub(crate) least: f64,
    /// Unknowns to eliminate (ascending); whole panels.
    pub(crate) ranges: &'a [Range<usize>],
}

impl WithSimd for Eliminate<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let starts = &self.band.starts;
        let panels = self.ranges.iter().flat_map(|range| {
            let panels = &self.band.panels;
            let first = panels.partition_point(|(panel, _)| panel.start < range.start);
            let last = panels.partition_point(|(panel, _)| panel.start < range.end);
            &panels[first..last]
        });
        for (panel, end) in panels {
            let (head, right) = self.values.split_at_mut(starts[panel.end]);
            let own = &mut head[starts[panel.start]..];
            let shape = (end - panel.start, panel.len());
            let reciprocals = eliminate_panel(own, shape, self.least);
            for column in panel.end..*end {
                let first = starts[column] - starts[panel.end];
                let target = &mut right[first..first + end - column];
                subtract_panel(target, own, shape, &reciprocals);
            }
            scale_panel(own, shape, &reciprocals);
        }
    }
}

/// Solves for the ranges of unknowns, each of which is not coupled to others.
pub(crate) struct Solve<'a> {
    pub(crate) band: &'a Band,
    pub(crate) values: &'a [f64],
    pub(crate) b: &'a mut [f64],
    pub(crate) ranges: &'a [Range<usize>],
}

impl WithSimd for Solve<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Solve {
            band,
            values,
            b,
            ranges,
        } = self;
        let column = |k: usize| &values[band.starts[k]..band.starts[k + 1]];
        let blocks = ranges.iter().flat_map(|range| band.blocks_in(range));
        let blocks: Vec<_> = blocks.cloned().collect();
        for equal in blocks.chunk_by(|a, b| a.len() == b.len()) {
            for abreast in equal.chunks(ABREAST) {
                for k in 0..abreast[0].len() {
                    for block in abreast {
                        subtract_column(column(block.start + k), &mut b[block.start + k..]);
                    }
                }
                for k in (0..abreast[0].len()).rev() {
                    for block in abreast {
                        divide_and_subtract(column(block.start + k), &mut b[block.start + k..]);
                    }
                }
            }
        }
    }
}

#[inline(always)]
fn subtract_column(own: &[f64], b: &mut [f64]) {
    let (head, below) = b.split_at_mut(1);
    subtract(&mut below[..own.len() - 1], [&own[1..]], [head[0]]);
}

#[inline(always)]
fn divide_and_subtract(own: &[f64], b: &mut [f64]) {
    b[0] = b[0] / own[0] - dot(&own[1..], &b[1..own.len()]);
}

/// Eliminates the columns of a panel from each other, without scaling; returns the reciprocals of
/// the pivots.
#[inline(always)]
fn eliminate_panel(own: &mut [f64], (rows, width): (usize, usize), least: f64) -> [f64; WIDEST] {
    let mut reciprocals = [0.0; WIDEST];
    let mut first = 0;
    for (p, reciprocal) in reciprocals.iter_mut().enumerate().take(width) {
        let (column, later) = own[first..].split_at_mut(rows - p);
        if column[0] == 0.0 {
            column[0] = least;
        }
        *reciprocal = 1.0 / column[0];
        let mut start = 0;
        for k in p + 1..width {
            let source = &column[k - p..];
            let target = &mut later[start..start + rows - k];
            subtract(target, [source], [source[0] * *reciprocal]);
            start += rows - k;
        }
        first += rows - p;
    }
    reciprocals
}

/// Subtracts a panel from a column to its right; `target` holds the rows of the panel.
#[inline(always)]
fn subtract_panel(
    target: &mut [f64],
    own: &[f64],
    (rows, width): (usize, usize),
    reciprocals: &[f64; WIDEST],
) {
    let n = target.len();
    let mut first = 0;
    let column = |p: usize, first: usize| &own[first + rows - p - n..first + rows - p];
    let mut p = 0;
    while p + 3 <= width {
        let (second, third) = (first + rows - p, first + 2 * (rows - p) - 1);
        let sources = [
            column(p, first),
            column(p + 1, second),
            column(p + 2, third),
        ];
        let factors = [
            sources[0][0] * reciprocals[p],
            sources[1][0] * reciprocals[p + 1],
            sources[2][0] * reciprocals[p + 2],
        ];
        subtract(target, sources, factors);
        first = third + rows - p - 2;
        p += 3;
    }
    while p < width {
        let source = column(p, first);
        subtract(target, [source], [source[0] * reciprocals[p]]);
        first += rows - p;
        p += 1;
    }
}

#[inline(always)]
fn subtract<const N: usize>(target: &mut [f64], sources: [&[f64]; N], factors: [f64; N]) {
    let n = target.len();
    let sources = sources.map(|source| &source[..n]);
    for i in 0..n {
        let mut value = target[i];
        for k in 0..N {
            value -= factors[k] * sources[k][i];
        }
        target[i] = value;
    }
}

#[inline(always)]
fn scale_panel(own: &mut [f64], (rows, width): (usize, usize), reciprocals: &[f64; WIDEST]) {
    let mut first = 0;
    for p in 0..width {
        for value in &mut own[first + 1..first + rows - p] {
            *value *= reciprocals[p];
        }
        first += rows - p;
    }
}

/// Four partial sums allow parallel additions.
#[inline]
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    let (a_chunks, a_rest) = a.as_chunks::<4>();
    let (b_chunks, b_rest) = b.as_chunks::<4>();
    for (a, b) in a_chunks.iter().zip(b_chunks) {
        for (sum, (a, b)) in sums.iter_mut().zip(a.iter().zip(b)) {
            *sum += a * b;
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    sums.iter().sum::<f64>() + rest
}

#[cfg(test)]
mod tests {
    use crate::factor::Factor;
    use crate::layout::{BodyOrder, Layout};
    use crate::pattern::Pattern;
    use actin_mechanics::Xorshift;
    use actin_mechanics::testing::{push_frame, push_point};
    use actin_mechanics::{Coordinates, Matrix3, Stiffness};
    use actin_mechanics::{State, UnitQuaternion, Vector3};

    fn chain(n: usize) -> (Pattern, Layout) {
        let mut state = State::default();
        for _ in 0..n {
            push_point(&mut state, Vector3::zeros(), 1.0);
            push_frame(&mut state, UnitQuaternion::identity(), [1.0; 3]);
        }
        state.frames.hold(n / 2);
        let order = BodyOrder {
            points: (0..n).map(|i| i as f64).collect(),
            frames: (0..n).map(|i| i as f64).collect(),
        };
        let mut layout = Layout::new(&state, Some(&order)).unwrap();
        let mut blocks = Stiffness::default();
        let of = |i| [Coordinates::Point(i), Coordinates::Frame(i)];
        for i in 0..n {
            for j in i..n.min(i + 3) {
                for a in of(i) {
                    for b in of(j) {
                        blocks.push(a, b, Matrix3::identity());
                    }
                }
            }
        }
        (Pattern::new(&blocks, &mut layout), layout)
    }

    fn matrix(pattern: &Pattern, seed: u64, diagonal: f64) -> Vec<f64> {
        let mut noise = Xorshift::new(seed);
        let upper = pattern.symbolic.as_ref();
        let mut values: Vec<f64> = upper.row_idx().iter().map(|_| noise.sample()).collect();
        for &end in &upper.col_ptr()[1..] {
            values[end - 1] += diagonal;
        }
        values
    }

    /// Rounding grows with the ratio of entries to pivots, at most 1e3.
    #[test]
    fn band_elimination_agrees_with_general_elimination() {
        for (n, diagonal, tolerance) in [(1, 9.0, 1e-14), (7, 40.0, 1e-13), (40, 4.0, 1e-9)] {
            let (pattern, layout) = chain(n);
            let upper = pattern.symbolic.as_ref();
            let values = matrix(&pattern, 3, diagonal);
            let metric = vec![1.0; layout.unknowns()];
            let mut band = Factor::new(&pattern.symbolic);
            assert!(band.is_band());
            let mut general = Factor::new(&pattern.symbolic).with_gaps();
            let inertia = band.factorize(upper, &values, &metric, 0.5);
            assert_eq!(inertia, general.factorize(upper, &values, &metric, 0.5));
            assert_eq!(inertia.is_positive(), diagonal > 5.0);
            let b: Vec<f64> = (0..layout.unknowns()).map(|i| (i % 5) as f64).collect();
            let (mut x, mut y) = (b.clone(), b);
            band.solve(&mut x);
            general.solve(&mut y);
            let size = y.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
            for (x, y) in x.iter().zip(&y) {
                assert!((x - y).abs() <= tolerance * size, "{n}: {x} against {y}");
            }
        }
    }

    #[test]
    fn zero_pivots_are_doubtful() {
        let (pattern, layout) = chain(4);
        let upper = pattern.symbolic.as_ref();
        let metric = vec![1.0; layout.unknowns()];
        let zeros = vec![0.0; upper.row_idx().len()];
        for shift in [0.0, f64::INFINITY, f64::NAN] {
            for mut factor in [
                Factor::new(&pattern.symbolic),
                Factor::new(&pattern.symbolic).with_gaps(),
            ] {
                let inertia = factor.factorize(upper, &zeros, &metric, shift);
                assert_eq!(inertia.doubtful, layout.unknowns(), "{shift}");
                assert!(!inertia.is_positive());
            }
        }
    }
}

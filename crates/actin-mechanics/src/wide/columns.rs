//! Arrays of equal length, read and written in groups of as many numbers as there are lanes.

use super::vectors::Wide3;
use pulp::Simd;
use std::array::from_fn;

/// `N` arrays to read.
#[derive(Clone, Copy, Debug)]
pub struct Columns<'a, S: Simd, const N: usize> {
    full: [&'a [S::f64s]; N],
    rest: [&'a [f64]; N],
}

/// `N` arrays to read and write.
#[derive(Debug)]
pub struct ColumnsMut<'a, S: Simd, const N: usize> {
    full: [&'a mut [S::f64s]; N],
    rest: [&'a mut [f64]; N],
}

impl<'a, S: Simd, const N: usize> Columns<'a, S, N> {
    /// The arrays, which have equal lengths.
    #[inline(always)]
    pub fn new(arrays: [&'a [f64]; N]) -> Self {
        let cut = arrays.map(|array| S::as_simd_f64s(array));
        Self {
            full: cut.map(|(full, _)| full),
            rest: cut.map(|(_, rest)| rest),
        }
    }

    /// Number of groups, a short one included.
    #[inline(always)]
    pub fn groups(&self) -> usize {
        self.full[0].len() + usize::from(!self.rest[0].is_empty())
    }

    /// The numbers of a group; zeros beyond the end.
    #[inline(always)]
    pub fn get(&self, simd: S, group: usize) -> [S::f64s; N] {
        let mut values = [simd.splat_f64s(0.0); N];
        if group < self.full[0].len() {
            for (value, full) in values.iter_mut().zip(&self.full) {
                *value = full[group];
            }
        } else if group == self.full[0].len() {
            for (value, rest) in values.iter_mut().zip(&self.rest) {
                *value = simd.partial_load_f64s(rest);
            }
        }
        values
    }
}

impl<'a, S: Simd, const N: usize> ColumnsMut<'a, S, N> {
    /// The arrays, which have equal lengths.
    #[inline(always)]
    pub fn new(arrays: [&'a mut [f64]; N]) -> Self {
        let mut cut = arrays.map(|array| S::as_mut_simd_f64s(array));
        Self {
            full: from_fn(|k| std::mem::take(&mut cut[k].0)),
            rest: from_fn(|k| std::mem::take(&mut cut[k].1)),
        }
    }

    /// Number of groups, a short one included.
    #[inline(always)]
    pub fn groups(&self) -> usize {
        self.full[0].len() + usize::from(!self.rest[0].is_empty())
    }

    /// The numbers of a group; zeros beyond the end.
    #[inline(always)]
    pub fn get(&self, simd: S, group: usize) -> [S::f64s; N] {
        let mut values = [simd.splat_f64s(0.0); N];
        if group < self.full[0].len() {
            for (value, full) in values.iter_mut().zip(&self.full) {
                *value = full[group];
            }
        } else {
            for (value, rest) in values.iter_mut().zip(&self.rest) {
                *value = simd.partial_load_f64s(rest);
            }
        }
        values
    }

    /// Replaces the numbers of a group.
    #[inline(always)]
    pub fn set(&mut self, simd: S, group: usize, values: [S::f64s; N]) {
        if group < self.full[0].len() {
            for (full, value) in self.full.iter_mut().zip(values) {
                full[group] = value;
            }
        } else {
            for (rest, value) in self.rest.iter_mut().zip(values) {
                simd.partial_store_f64s(rest, value);
            }
        }
    }
}

impl<S: Simd> ColumnsMut<'_, S, 3> {
    /// Adds to the vectors of a group.
    #[inline(always)]
    pub fn add(&mut self, simd: S, group: usize, terms: Wide3<S>) {
        let now = self.get(simd, group);
        self.set(simd, group, super::add(simd, now, terms));
    }
}

/// Moves the vectors of successive groups one body up: lane `i` receives what lane `i - 1` had,
/// the first lane what the last lane of the group before had.
///
/// What acts between a body and the next is computed in the lane of the first; this brings its
/// reaction to the second without a store that overlaps the next group's load.
#[derive(Clone, Copy, Debug)]
pub struct ShiftedUp<S: Simd> {
    first_lane: S::m64s,
    last: Wide3<S>,
}

impl<S: Simd> ShiftedUp<S> {
    /// Nothing comes before the first group.
    #[inline(always)]
    pub fn new(simd: S) -> Self {
        let zero = simd.splat_f64s(0.0);
        let lane = simd.partial_load_f64s(&[1.0]);
        Self {
            first_lane: simd.greater_than_f64s(lane, zero),
            last: [zero; 3],
        }
    }

    /// The next group.
    #[inline(always)]
    pub fn next(&mut self, simd: S, vectors: Wide3<S>) -> Wide3<S> {
        let [x, y, z] = vectors;
        let turned = [
            simd.rotate_right_f64s(x, 1),
            simd.rotate_right_f64s(y, 1),
            simd.rotate_right_f64s(z, 1),
        ];
        let before = std::mem::replace(&mut self.last, turned);
        [
            simd.select_f64s(self.first_lane, before[0], turned[0]),
            simd.select_f64s(self.first_lane, before[1], turned[1]),
            simd.select_f64s(self.first_lane, before[2], turned[2]),
        ]
    }
}

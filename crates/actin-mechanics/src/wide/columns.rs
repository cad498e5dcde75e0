//! Arrays of equal length, read and written in groups of as many numbers as there are lanes.

use super::vectors::{Wide3, write};
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
        let length = arrays[0].len();
        let cut = arrays.map(|array| S::as_simd_f64s(&array[..length]));
        // Of one length in the eyes of the compiler, so that one comparison does for a group.
        let (full, rest) = (cut[0].0.len(), cut[0].1.len());
        Self {
            full: cut.map(|(all, _)| &all[..full]),
            rest: cut.map(|(_, all)| &all[..rest]),
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
        let length = arrays[0].len();
        let mut cut = arrays.map(|array| S::as_mut_simd_f64s(&mut array[..length]));
        let (full, rest) = (cut[0].0.len(), cut[0].1.len());
        Self {
            full: from_fn(|k| &mut std::mem::take(&mut cut[k].0)[..full]),
            rest: from_fn(|k| &mut std::mem::take(&mut cut[k].1)[..rest]),
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

    /// Replaces the numbers of a group; beyond the end nothing.
    #[inline(always)]
    pub fn set(&mut self, simd: S, group: usize, values: [S::f64s; N]) {
        if group < self.full[0].len() {
            for (full, value) in self.full.iter_mut().zip(values) {
                full[group] = value;
            }
        } else if group == self.full[0].len() {
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

/// Moves the numbers of successive groups one body up: lane `i` receives what lane `i - 1` had,
/// the first lane what the last lane of the group before had.
///
/// What acts between a body and the next is computed in the lane of the first; this brings its
/// reaction to the second without a store that overlaps the next group's load.
#[derive(Clone, Copy, Debug)]
pub struct ShiftedUp<S: Simd, const N: usize> {
    first_lane: S::m64s,
    last: [S::f64s; N],
}

impl<S: Simd, const N: usize> ShiftedUp<S, N> {
    /// Nothing but zeros comes before the first group.
    #[inline(always)]
    pub fn new(simd: S) -> Self {
        Self::after(simd, [0.0; N])
    }

    /// These numbers come before the first group.
    #[inline(always)]
    pub fn after(simd: S, before: [f64; N]) -> Self {
        let zero = simd.splat_f64s(0.0);
        let mut last = [zero; N];
        for (last, before) in last.iter_mut().zip(before) {
            *last = simd.splat_f64s(before);
        }
        Self {
            first_lane: simd.greater_than_f64s(simd.partial_load_f64s(&[1.0]), zero),
            last,
        }
    }

    /// The next group.
    #[inline(always)]
    pub fn next(&mut self, simd: S, values: [S::f64s; N]) -> [S::f64s; N] {
        let mut shifted = values;
        for (shifted, last) in shifted.iter_mut().zip(&mut self.last) {
            let turned = simd.rotate_right_f64s(*shifted, 1);
            *shifted = simd.select_f64s(self.first_lane, *last, turned);
            *last = turned;
        }
        shifted
    }
}

/// Moves the numbers of successive groups one body down: lane `i` receives what lane `i + 1` has,
/// the last lane what the first lane of the next group has.
///
/// A group is therefore complete only when the next one is known, and comes one call later.
#[derive(Clone, Copy, Debug)]
pub struct ShiftedDown<S: Simd, const N: usize> {
    last_lane: S::m64s,
    before: [S::f64s; N],
}

impl<S: Simd, const N: usize> ShiftedDown<S, N> {
    /// Before the first group.
    #[inline(always)]
    pub fn new(simd: S) -> Self {
        let zero = simd.splat_f64s(0.0);
        let last = simd.rotate_left_f64s(simd.partial_load_f64s(&[1.0]), 1);
        Self {
            last_lane: simd.greater_than_f64s(last, zero),
            before: [zero; N],
        }
    }

    /// Takes the next group and returns the one before, moved down.
    ///
    /// Of the first call only the last lane has a meaning: what the first body has, which belongs
    /// to the body before it.
    #[inline(always)]
    pub fn next(&mut self, simd: S, values: [S::f64s; N]) -> [S::f64s; N] {
        let mut shifted = values;
        for (shifted, before) in shifted.iter_mut().zip(&mut self.before) {
            let turned = simd.rotate_left_f64s(*shifted, 1);
            *shifted = simd.select_f64s(self.last_lane, turned, *before);
            *before = turned;
        }
        shifted
    }
}

/// Bodies whose numbers are added one after the other: of each eight the first, the second, and so on.
const PARTS: usize = 8;

/// A sum over bodies in an order that does not depend on the number of lanes, up to eight.
#[derive(Clone, Copy, Debug)]
pub struct Sums<S: Simd>([S::f64s; PARTS]);

impl<S: Simd> Sums<S> {
    /// Nothing.
    #[inline(always)]
    pub fn new(simd: S) -> Self {
        Self([simd.splat_f64s(0.0); PARTS])
    }

    /// Adds the numbers of a group.
    #[inline(always)]
    pub fn add(&mut self, simd: S, group: usize, terms: S::f64s) {
        let part = &mut self.0[group * S::F64_LANES % PARTS / S::F64_LANES];
        *part = simd.add_f64s(*part, terms);
    }

    /// The sum.
    #[inline(always)]
    pub fn total(&self, simd: S) -> f64 {
        let mut parts = [0.0; PARTS];
        for (place, part) in self.0.iter().enumerate().take(PARTS / S::F64_LANES) {
            write(simd, &mut parts, place, *part);
        }
        parts.iter().sum()
    }
}

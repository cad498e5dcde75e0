//! Arrays of equal length, accessed in groups of one number per lane.

use super::vectors::{Wide3, write};
use pulp::Simd;
use std::array::from_fn;

/// `N` input arrays.
#[derive(Clone, Copy, Debug)]
pub struct Columns<'a, S: Simd, const N: usize> {
    full: [&'a [S::f64s]; N],
    rest: [&'a [f64]; N],
}

/// `N` input and output arrays.
#[derive(Debug)]
pub struct ColumnsMut<'a, S: Simd, const N: usize> {
    full: [&'a mut [S::f64s]; N],
    rest: [&'a mut [f64]; N],
}

impl<'a, S: Simd, const N: usize> Columns<'a, S, N> {
    /// Creates columns from arrays of equal length.
    #[inline(always)]
    pub fn new(arrays: [&'a [f64]; N]) -> Self {
        let length = arrays[0].len();
        let cut = arrays.map(|array| S::as_simd_f64s(&array[..length]));
        // Slicing to equal lengths reduces bounds checks to one per group.
        let (full, rest) = (cut[0].0.len(), cut[0].1.len());
        Self {
            full: cut.map(|(all, _)| &all[..full]),
            rest: cut.map(|(_, all)| &all[..rest]),
        }
    }

    /// Number of groups, including a short last one.
    #[inline(always)]
    pub fn groups(&self) -> usize {
        self.full[0].len() + usize::from(!self.rest[0].is_empty())
    }

    /// Numbers of a group, padded with zeros.
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
    /// Creates columns from arrays of equal length.
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

    /// Number of groups, including a short last one.
    #[inline(always)]
    pub fn groups(&self) -> usize {
        self.full[0].len() + usize::from(!self.rest[0].is_empty())
    }

    /// Numbers of a group, padded with zeros.
    #[inline(always)]
    pub(crate) fn get(&self, simd: S, group: usize) -> [S::f64s; N] {
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

    /// Stores the numbers of a group. Padding is ignored.
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
    /// Adds vectors to a group.
    #[inline(always)]
    pub fn add(&mut self, simd: S, group: usize, terms: Wide3<S>) {
        let now = self.get(simd, group);
        self.set(simd, group, super::add(simd, now, terms));
    }
}

/// Shift of successive groups up by one body. Lane `i` receives the number of lane `i - 1`; the
/// first lane receives the last number of the preceding group.
///
/// Moves the reaction of an interaction between neighbours to the second body without overlapping
/// stores and loads.
#[derive(Clone, Copy, Debug)]
pub struct ShiftedUp<S: Simd, const N: usize> {
    first_lane: S::m64s,
    last: [S::f64s; N],
}

impl<S: Simd, const N: usize> ShiftedUp<S, N> {
    /// Starts with zeros before the first group.
    #[inline(always)]
    pub fn new(simd: S) -> Self {
        Self::after(simd, [0.0; N])
    }

    /// Starts with the given numbers before the first group.
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

    /// Shifts the next group.
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

/// Shift of successive groups down by one body. Lane `i` receives the number of lane `i + 1`; the
/// last lane receives the first number of the next group.
///
/// Results are delayed by one call, since a group needs the next one.
#[derive(Clone, Copy, Debug)]
pub struct ShiftedDown<S: Simd, const N: usize> {
    last_lane: S::m64s,
    before: [S::f64s; N],
}

impl<S: Simd, const N: usize> ShiftedDown<S, N> {
    /// Starts before the first group.
    #[inline(always)]
    pub fn new(simd: S) -> Self {
        let zero = simd.splat_f64s(0.0);
        let last = simd.rotate_left_f64s(simd.partial_load_f64s(&[1.0]), 1);
        Self {
            last_lane: simd.greater_than_f64s(last, zero),
            before: [zero; N],
        }
    }

    /// Accepts the next group and returns the preceding one, shifted down.
    ///
    /// In the first call only the last lane is valid: it contains the number of the first body.
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

/// Number of partial sums. Body `i` belongs to partial sum `i % PARTS`.
const PARTS: usize = 8;

/// Sum over bodies whose order does not depend on the number of lanes, up to eight lanes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sums<S: Simd>([S::f64s; PARTS]);

impl<S: Simd> Sums<S> {
    /// Zero.
    #[inline(always)]
    pub(crate) fn new(simd: S) -> Self {
        Self([simd.splat_f64s(0.0); PARTS])
    }

    /// Adds the numbers of a group.
    #[inline(always)]
    pub(crate) fn add(&mut self, simd: S, group: usize, terms: S::f64s) {
        let part = &mut self.0[group * S::F64_LANES % PARTS / S::F64_LANES];
        *part = simd.add_f64s(*part, terms);
    }

    /// Value of the sum.
    #[inline(always)]
    pub(crate) fn total(&self, simd: S) -> f64 {
        let mut parts = [0.0; PARTS];
        for (place, part) in self.0.iter().enumerate().take(PARTS / S::F64_LANES) {
            write(simd, &mut parts, place, *part);
        }
        parts.iter().sum()
    }
}

//! The hot loop: the loads of all bonds of a run, several neighbouring pairs at a time.
//!
//! One pair per lane, so that the geometry of a pair, its bonds and its sums all stay within a
//! lane. How many lanes there are is found out at run time.
#![allow(
    clippy::inline_always,
    reason = "vector code must be compiled into the function that enables the instructions"
)]

use crate::Monomers;
use crate::table::{BondTable, GROUP, Group, Record};
use actin_mechanics::wide::{self, Simd, Wide3, WideMatrix, WithSimd};
use actin_mechanics::{Loads, State};
use std::ops::Range;

/// Added to squared lengths: without it a bond of no length would divide zero by zero. It is
/// the smallest normal number, so lengths above 1e-146 nm are what they would be without it.
pub(crate) const GUARD: f64 = f64::MIN_POSITIVE;

/// The loop over pairs, to be compiled for whatever instructions the machine has.
#[derive(Debug)]
pub(crate) struct AddLoads<'a> {
    /// The bodies.
    pub(crate) monomers: Monomers,
    /// One table per kind of interface.
    pub(crate) tables: &'a [BondTable],
    /// Where the bodies are.
    pub(crate) state: &'a State,
    /// What acts on them.
    pub(crate) loads: &'a mut Loads,
}

/// The lower bodies of neighbouring pairs, one per lane.
#[derive(Clone, Copy, Debug)]
struct Lower<S: Simd> {
    orientation: [S::f64s; 4],
    /// Rotation from the body frame to the lab.
    axes: WideMatrix<S>,
}

impl WithSimd for AddLoads<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        let lanes = S::F64_LANES.min(GROUP);
        for first in (0..self.monomers.count).step_by(lanes) {
            let bodies = first..self.monomers.count.min(first + lanes);
            let frames = self.frames(&bodies);
            let q = &self.state.frames.orientation;
            let orientation = wide::load_quaternions(simd, q, &frames);
            let lower = Lower {
                orientation,
                axes: wide::matrix(simd, orientation),
            };
            for table in self.tables {
                let pairs = first..table.pairs.min(first + lanes);
                if !pairs.is_empty() {
                    self.add_pairs(simd, &lower, table, &pairs);
                }
            }
        }
    }
}

impl AddLoads<'_> {
    /// Points of some bodies of the run.
    #[inline(always)]
    fn points(&self, bodies: &Range<usize>) -> Range<usize> {
        self.monomers.point(bodies.start)..self.monomers.point(bodies.end)
    }

    /// Frames of some bodies of the run.
    #[inline(always)]
    fn frames(&self, bodies: &Range<usize>) -> Range<usize> {
        self.monomers.frame(bodies.start)..self.monomers.frame(bodies.end)
    }

    /// Adds the loads of neighbouring pairs, given by their lower bodies.
    ///
    /// In the lower body's frame: `F = sum k g d` and `T = sum a x k g d` act on it. In terms of
    /// the offset `D` of the upper body's centre, the torque on that is `-(T - D x F)`.
    #[inline(always)]
    fn add_pairs<S: Simd>(
        &mut self,
        simd: S,
        lower: &Lower<S>,
        table: &BondTable,
        pairs: &Range<usize>,
    ) {
        let uppers = pairs.start + table.step..pairs.end + table.step;
        let position = &self.state.points.position;
        let (lower_points, upper_points) = (self.points(pairs), self.points(&uppers));
        let (lower_frames, upper_frames) = (self.frames(pairs), self.frames(&uppers));
        let between = wide::sub(
            simd,
            wide::load3(simd, position, &upper_points),
            wide::load3(simd, position, &lower_points),
        );
        let upper = &self.state.frames.orientation;
        let upper = wide::load_quaternions(simd, upper, &upper_frames);
        let rotation = wide::matrix(simd, wide::relative(simd, lower.orientation, upper));
        let offset = wide::mul(simd, &wide::transpose::<S>(&lower.axes), between);

        let (group, place) = (table.group(pairs.start), place_of::<S>(pairs.start));
        let (force, torque) = if group.weights.is_empty() {
            sum_bonds::<S, false>(simd, &rotation, offset, group, place)
        } else {
            sum_bonds::<S, true>(simd, &rotation, offset, group, place)
        };
        // Lanes without a pair get no stiffness.
        let stiffness = wide::load(simd, &[table.stiffness; GROUP], &(0..pairs.len()));
        let force = wide::scale(simd, force, stiffness);
        let torque = wide::scale(simd, torque, stiffness);
        let reaction = wide::cross_add(simd, offset, force, wide::neg(simd, torque));
        let reaction = wide::mul(simd, &wide::transpose::<S>(&rotation), reaction);
        let force = wide::mul(simd, &lower.axes, force);

        let loads = &mut *self.loads;
        wide::add3(simd, &mut loads.force, &lower_points, force);
        wide::add3(simd, &mut loads.torque, &lower_frames, torque);
        let opposite = wide::neg(simd, force);
        wide::add3(simd, &mut loads.force, &upper_points, opposite);
        wide::add3(simd, &mut loads.torque, &upper_frames, reaction);
    }
}

/// Sums over the bonds of each pair of `g d` and of `a x g d`, in the lower body's frame, each times
/// its weight if bonds are `WEIGHTED`.
///
/// With the upper body's rotation `R` and offset `D`, `d = R b + D - a` is a bond's vector and
/// `g = 1 - L / |d|`.
#[inline(always)]
fn sum_bonds<S: Simd, const WEIGHTED: bool>(
    simd: S,
    rotation: &WideMatrix<S>,
    offset: Wide3<S>,
    Group { records, weights }: Group<'_>,
    place: usize,
) -> (Wide3<S>, Wide3<S>) {
    let weights = &weights[..if WEIGHTED { records.len() } else { 0 }];
    let (one, guard) = (simd.splat_f64s(1.0), simd.splat_f64s(GUARD));
    let zero = simd.splat_f64s(0.0);
    let (mut force, mut torque) = ([zero; 3], [zero; 3]);
    for (k, record) in records.iter().enumerate() {
        let Ends { a, b, length } = Ends::read(simd, record, place);
        let d = wide::mul_add(simd, rotation, b, wide::sub(simd, offset, a));
        let distance = simd.sqrt_f64s(wide::dot_add(simd, d, d, guard));
        let strain = simd.div_f64s(length, distance);
        let mut factor = simd.sub_f64s(one, strain);
        if WEIGHTED {
            factor = simd.mul_f64s(factor, simd.splat_f64s(weights[k]));
        }
        let f = wide::scale(simd, d, factor);
        force = wide::add(simd, force, f);
        torque = wide::cross_add(simd, a, f, torque);
    }
    (force, torque)
}

/// Which vector of its group's numbers a pair stands in.
#[inline(always)]
pub(crate) fn place_of<S: Simd>(pair: usize) -> usize {
    pair % GROUP / S::F64_LANES
}

/// One bond of each pair, one pair per lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ends<S: Simd> {
    /// End on the lower body, its frame.
    pub(crate) a: Wide3<S>,
    /// End on the upper body, its frame.
    pub(crate) b: Wide3<S>,
    /// Rest length.
    pub(crate) length: S::f64s,
}

impl<S: Simd> Ends<S> {
    /// Those of the pairs at `place`.
    #[inline(always)]
    pub(crate) fn read(simd: S, record: &Record, place: usize) -> Self {
        let [ax, ay, az, bx, by, bz, length] = record.each_ref();
        let read = |lanes| wide::read(simd, lanes, place);
        Self {
            a: [read(ax), read(ay), read(az)],
            b: [read(bx), read(by), read(bz)],
            length: read(length),
        }
    }
}

//! Inner loop of the bond loads, one pair per vector lane.
#![allow(
    clippy::inline_always,
    reason = "vector code must be compiled into the function that enables the instructions"
)]

use crate::Monomers;
use crate::table::{BondTable, GROUP, Group, Record};
use actin_mechanics::wide::{self, ColumnsMut, ShiftedUp, Simd, Wide3, WideMatrix, WithSimd};
use actin_mechanics::{Loads, State};
use std::ops::Range;

/// Avoids division by zero. Lengths above 1e-146 nm are unaffected.
pub(crate) const GUARD: f64 = f64::MIN_POSITIVE;

#[derive(Debug)]
pub(crate) struct AddLoads<'a> {
    pub(crate) monomers: Monomers,
    pub(crate) tables: &'a [BondTable; 2],
    pub(crate) state: &'a State,
    pub(crate) loads: &'a mut Loads,
}

/// Lower bodies of neighbouring pairs, one per lane.
#[derive(Clone, Copy, Debug)]
struct Lower<S: Simd> {
    orientation: [S::f64s; 4],
    axes: WideMatrix<S>,
}

/// Forces (lab frame) and torques (body frames).
#[derive(Clone, Copy, Debug)]
struct Action<S: Simd> {
    force: Wide3<S>,
    torque: Wide3<S>,
}

impl<S: Simd> Action<S> {
    #[inline(always)]
    fn zero(simd: S) -> Self {
        let zero = [simd.splat_f64s(0.0); 3];
        let (force, torque) = (zero, zero);
        Self { force, torque }
    }

    #[inline(always)]
    fn plus(self, simd: S, other: Self) -> Self {
        Self {
            force: wide::add(simd, self.force, other.force),
            torque: wide::add(simd, self.torque, other.torque),
        }
    }

    #[inline(always)]
    fn where_set(self, simd: S, mask: S::m64s) -> Self {
        let zero = simd.splat_f64s(0.0);
        let chosen = |[x, y, z]: Wide3<S>| {
            [
                simd.select_f64s(mask, x, zero),
                simd.select_f64s(mask, y, zero),
                simd.select_f64s(mask, z, zero),
            ]
        };
        Self {
            force: chosen(self.force),
            torque: chosen(self.torque),
        }
    }
}

/// Loads on upper bodies, shifted to their lanes.
#[derive(Clone, Copy, Debug)]
struct ShiftedLoads<S: Simd> {
    force: ShiftedUp<S, 3>,
    torque: ShiftedUp<S, 3>,
}

impl<S: Simd> ShiftedLoads<S> {
    #[inline(always)]
    fn new(simd: S) -> Self {
        Self {
            force: ShiftedUp::new(simd),
            torque: ShiftedUp::new(simd),
        }
    }

    #[inline(always)]
    fn next(&mut self, simd: S, action: Action<S>) -> Action<S> {
        Action {
            force: self.force.next(simd, action.force),
            torque: self.torque.next(simd, action.torque),
        }
    }
}

impl WithSimd for AddLoads<'_> {
    type Output = ();

    /// Adds in an order independent of the number of lanes.
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let (points, frames) = (self.points(&self.bodies()), self.frames(&self.bodies()));
        let Loads { force, torque, .. } = &mut *self.loads;
        let [x, y, z] = [&mut force.x, &mut force.y, &mut force.z];
        let mut force = ColumnsMut::<S, 3>::new([x, y, z].map(|c| &mut c[points.clone()]));
        let [x, y, z] = [&mut torque.x, &mut torque.y, &mut torque.z];
        let mut torque = ColumnsMut::<S, 3>::new([x, y, z].map(|c| &mut c[frames.clone()]));
        let pairs = Pairs {
            monomers: self.monomers,
            state: self.state,
        };
        let (mut by_one, mut by_two) = (ShiftedLoads::new(simd), ShiftedLoads::new(simd));
        for group in 0..force.groups() {
            let lower = pairs.lower(simd, group);
            let [next, second] = self.tables;
            let [on_lower, on_next] = pairs.actions(simd, &lower, next, group);
            let [also, on_second] = pairs.actions(simd, &lower, second, group);
            let on_upper = on_next.plus(simd, by_two.next(simd, on_second));
            let on_upper = by_one.next(simd, on_upper);
            let sum = on_lower.plus(simd, also).plus(simd, on_upper);
            force.add(simd, group, sum.force);
            torque.add(simd, group, sum.torque);
        }
    }
}

impl AddLoads<'_> {
    fn bodies(&self) -> Range<usize> {
        0..self.monomers.count
    }

    fn points(&self, bodies: &Range<usize>) -> Range<usize> {
        shifted(bodies, self.monomers.first_point)
    }

    fn frames(&self, bodies: &Range<usize>) -> Range<usize> {
        shifted(bodies, self.monomers.first_frame)
    }
}

#[inline(always)]
fn shifted(bodies: &Range<usize>, first: usize) -> Range<usize> {
    first + bodies.start..first + bodies.end
}

#[derive(Clone, Copy, Debug)]
struct Pairs<'a> {
    monomers: Monomers,
    state: &'a State,
}

impl Pairs<'_> {
    #[inline(always)]
    fn points(&self, bodies: &Range<usize>) -> Range<usize> {
        shifted(bodies, self.monomers.first_point)
    }

    #[inline(always)]
    fn frames(&self, bodies: &Range<usize>) -> Range<usize> {
        shifted(bodies, self.monomers.first_frame)
    }

    #[inline(always)]
    fn lower<S: Simd>(&self, simd: S, group: usize) -> Lower<S> {
        let first = group * S::F64_LANES;
        let bodies = first..self.monomers.count.min(first + S::F64_LANES);
        let q = &self.state.frames.orientation;
        let orientation = wide::load_quaternions(simd, q, &self.frames(&bodies));
        let axes = wide::matrix(simd, orientation);
        Lower { orientation, axes }
    }

    /// Loads on the lower and upper bodies of neighbouring pairs, in the lanes of the lower bodies:
    /// `F = sum k g d`, `T = sum a x k g d`, and `-F`, `-(T - D x F)`, in the frame of the lower
    /// body.
    #[inline(always)]
    fn actions<S: Simd>(
        &self,
        simd: S,
        lower: &Lower<S>,
        table: &BondTable,
        group: usize,
    ) -> [Action<S>; 2] {
        let first = group * S::F64_LANES;
        let pairs = first..table.pairs.min(first + S::F64_LANES);
        if pairs.is_empty() {
            return [Action::zero(simd); 2];
        }
        let (rotation, offset) = self.relative(simd, lower, &pairs, table.step);
        let (group, place) = (table.group(pairs.start), place_of::<S>(pairs.start));
        let (force, torque) = if group.weights.is_empty() {
            sum_bonds::<S, false>(simd, &rotation, offset, group, place)
        } else {
            sum_bonds::<S, true>(simd, &rotation, offset, group, place)
        };
        let stiffness = simd.splat_f64s(table.stiffness);
        let force = wide::scale(simd, force, stiffness);
        let torque = wide::scale(simd, torque, stiffness);
        let reaction = wide::cross_add(simd, offset, force, wide::neg(simd, torque));
        let reaction = wide::mul(simd, &wide::transpose::<S>(&rotation), reaction);
        let force = wide::mul(simd, &lower.axes, force);
        let on_lower = Action { force, torque };
        let (force, torque) = (wide::neg(simd, force), reaction);
        let on_upper = Action { force, torque };
        if pairs.len() == S::F64_LANES {
            return [on_lower, on_upper];
        }
        // Lanes without a pair may hold other bodies or non-finite numbers.
        let there = wide::load(simd, &[1.0; GROUP], &(0..pairs.len()));
        let there = simd.greater_than_f64s(there, simd.splat_f64s(0.0));
        [
            on_lower.where_set(simd, there),
            on_upper.where_set(simd, there),
        ]
    }

    #[inline(always)]
    fn relative<S: Simd>(
        &self,
        simd: S,
        lower: &Lower<S>,
        pairs: &Range<usize>,
        step: usize,
    ) -> (WideMatrix<S>, Wide3<S>) {
        let uppers = pairs.start + step..pairs.end + step;
        let position = &self.state.points.position;
        let between = wide::sub(
            simd,
            wide::load3(simd, position, &self.points(&uppers)),
            wide::load3(simd, position, &self.points(pairs)),
        );
        let q = &self.state.frames.orientation;
        let upper = wide::load_quaternions(simd, q, &self.frames(&uppers));
        let rotation = wide::matrix(simd, wide::relative(simd, lower.orientation, upper));
        let offset = wide::mul(simd, &wide::transpose::<S>(&lower.axes), between);
        (rotation, offset)
    }
}

/// Sums of `g d` and of `a x g d` over the bonds of each pair in the frame of the lower body.
///
/// `d = R b + D - a` is the vector of a bond, `R` and `D` the pose of the upper body, and
/// `g = 1 - L / |d|`, multiplied by the weight if `WEIGHTED`.
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
        let squared = wide::dot_add(simd, d, d, guard);
        let strain = simd.div_f64s(length, simd.sqrt_f64s(squared));
        let mut factor = simd.sub_f64s(one, strain);
        if WEIGHTED {
            factor = simd.mul_f64s(factor, wide::read(simd, &weights[k], place));
        }
        let f = wide::scale(simd, d, factor);
        force = wide::add(simd, force, f);
        torque = wide::cross_add(simd, a, f, torque);
    }
    (force, torque)
}

#[inline(always)]
pub(crate) fn place_of<S: Simd>(pair: usize) -> usize {
    pair % GROUP / S::F64_LANES
}

/// One bond of each pair, one pair per lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ends<S: Simd> {
    pub(crate) a: Wide3<S>,
    pub(crate) b: Wide3<S>,
    /// Rest length.
    pub(crate) length: S::f64s,
}

impl<S: Simd> Ends<S> {
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

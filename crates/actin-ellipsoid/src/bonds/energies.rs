//! Bond energies.
#![allow(
    clippy::inline_always,
    reason = "vector code must be compiled into the function that enables the instructions"
)]

use super::Bonds;
use super::sums::Relatives;
use crate::kernel::{Ends, place_of};
use crate::table::{BondTable, GROUP, Group};
use actin_mechanics::State;
use actin_mechanics::wide::{self, Simd, WithSimd};

/// Vectorised sum of `(|d| - L)^2` over the bonds of each pair, weighted.
#[derive(Debug)]
struct SumSquares<'a> {
    relatives: &'a Relatives,
    group: Group<'a>,
}

impl WithSimd for SumSquares<'_> {
    type Output = [f64; GROUP];

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let Group { records, weights } = self.group;
        let mut squares = [0.0; GROUP];
        for first in (0..GROUP).step_by(S::F64_LANES.min(GROUP)) {
            let place = place_of::<S>(first);
            let (rotation, offset) = self.relatives.read(simd, place);
            let zero = simd.splat_f64s(0.0);
            let mut sum = zero;
            for (k, record) in records.iter().enumerate() {
                let Ends { a, b, length } = Ends::read(simd, record, place);
                let d = wide::mul_add(simd, &rotation, b, wide::sub(simd, offset, a));
                let distance = simd.sqrt_f64s(wide::dot_add(simd, d, d, zero));
                let stretch = simd.sub_f64s(distance, length);
                let weighted = match weights.get(k) {
                    Some(lanes) => simd.mul_f64s(stretch, wide::read(simd, lanes, place)),
                    None => stretch,
                };
                sum = simd.mul_add_e_f64s(weighted, stretch, sum);
            }
            wide::write(simd, &mut squares, place, sum);
        }
        squares
    }
}

impl Bonds {
    /// Energies of up to [`GROUP`] pairs, starting with lower body `first`.
    fn energies_of_group<'a>(
        &self,
        table: &BondTable,
        first: usize,
        state: &State,
        energies: &'a mut [f64; GROUP],
    ) -> &'a [f64] {
        if first >= table.pairs {
            return &[];
        }
        let pairs = first..table.pairs.min(first + GROUP);
        let count = pairs.len();
        let mut relatives = Relatives::default();
        for (lane, k) in pairs.enumerate() {
            let lower = self.body(state, k);
            let relative = self.body(state, k + table.step).relative_to(&lower);
            relatives.set(lane, &relative);
        }
        let squares = self.arch.dispatch(SumSquares {
            relatives: &relatives,
            group: table.group(first),
        });
        *energies = squares.map(|sum| 0.5 * table.stiffness * sum);
        &energies[..count]
    }

    pub(super) fn write_pairs(&self, state: &State, energies: &mut [f64]) {
        let mut places = energies.iter_mut();
        for first in (0..self.monomers.count).step_by(GROUP) {
            let mut memory = [[0.0; GROUP]; 2];
            let [one, other] = &mut memory;
            let lateral = self.energies_of_group(&self.tables[0], first, state, one);
            let longitudinal = self.energies_of_group(&self.tables[1], first, state, other);
            for lane in 0..GROUP {
                for energy in [lateral.get(lane), longitudinal.get(lane)]
                    .into_iter()
                    .flatten()
                {
                    *places.next().expect("one energy per interface") = *energy;
                }
            }
        }
    }
}

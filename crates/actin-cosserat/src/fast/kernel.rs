//! The loads of a rod as something to be compiled for whatever instructions the machine has.
//!
//! The loops are in `separate.rs` and `coupled.rs`.
#![allow(
    clippy::inline_always,
    reason = "vector code must be compiled into the function that enables the instructions"
)]

use super::laws::Law;
use super::rod::Rod;
use crate::RodLayout;
use actin_mechanics::wide::{Simd, WithSimd};
use actin_mechanics::{Loads, State};

/// Adds the loads of a rod.
#[derive(Debug)]
pub(super) struct AddLoads<'a, L> {
    pub(super) rod: &'a Rod<L>,
    pub(super) layout: &'a RodLayout,
    pub(super) state: &'a State,
    pub(super) loads: &'a mut Loads,
}

impl<L: Law> WithSimd for AddLoads<'_, L> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        if L::COUPLES {
            self.add_coupled(simd);
        } else {
            self.add_segments(simd);
            self.add_bending(simd);
        }
    }
}

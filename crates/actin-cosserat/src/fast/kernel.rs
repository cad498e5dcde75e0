//! Dispatch of the vector kernels in `separate.rs` and `coupled.rs`.
#![allow(
    clippy::inline_always,
    reason = "vector code must be compiled into the function that enables the instructions"
)]

use super::laws::Law;
use super::rod::AddLoads;
use actin_mechanics::wide::{Simd, WithSimd};

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

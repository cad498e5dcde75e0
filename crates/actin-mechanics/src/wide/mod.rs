//! Vector code: one body per lane of a vector register.
//!
//! States are structures of arrays, so a loop processes as many bodies at a time as the processor
//! has lanes: eight with AVX-512, four with AVX2, otherwise one. The instruction set is detected at
//! run time, or set by the environment variable `ACTIN_SIMD` ([`arch`]).
//!
//! # Wide functions
//! A wide function is generic over `S: Simd` and operates on bodies in the lanes of `S::f64s`. Its
//! documentation names a scalar *reference*, which a test compares on random states. A loop
//! implements [`WithSimd`] and is passed to [`dispatch`]. All functions that it calls must be
//! inlined, because the instructions are enabled only there.
//!
//! [`Columns`] are the input arrays of a loop, [`ColumnsMut`] its output arrays. In a short last
//! group, lanes without a body read zeros and write nothing, so the reference must be defined at
//! zero.
//!
//! # Accuracy
//! Functions of small angles are polynomials in the squared angle (`functions.rs`), accurate to
//! round-off; larger angles are computed by scalar functions. Multiplications and additions are
//! fused if possible, so results may differ from the reference in the last digits. Results with
//! four and eight lanes are identical to the bit, because sums over bodies (`Sums`,
//! [`ShiftedUp`]) have a fixed order.
#![allow(
    clippy::inline_always,
    reason = "vector code must be compiled into the function that enables the instructions"
)]

mod columns;
mod functions;
mod instructions;
mod rotations;
mod vectors;

pub(crate) use columns::Sums;
pub use columns::{Columns, ColumnsMut, ShiftedDown, ShiftedUp};
pub(crate) use functions::cosine_and_sinc;
pub use functions::{clamp, tanh};
pub use instructions::{arch, chosen_arch};
pub use pulp::{Arch, Scalar, Simd, WithSimd};
pub(crate) use rotations::product;
pub(crate) use rotations::product_about_z;
pub use rotations::{WideQuaternion, log_with_coefficient, matrix, relative, turn, turn_back};
pub(crate) use vectors::dot;
pub use vectors::{
    Wide3, WideMatrix, add, cross, cross_add, dot_add, in_lane, lane, load, load_quaternions,
    load3, mul, mul_add, mul_each, neg, read, scale, scale_add, splat, sub, transpose, write,
};

const MOST_LANES: usize = 16;

/// Runs `loop_` with the instruction set of [`arch`].
#[inline]
pub fn dispatch<L: WithSimd>(loop_: L) -> L::Output {
    arch().dispatch(loop_)
}

#[cfg(test)]
mod tests;

//! Several bodies at once: one body per lane of a vector register.
//!
//! The hot loops (the drift of frames, the loads between neighbours) do the same arithmetic for
//! every body. States are structures of arrays so that a loop can take as many
//! bodies at a time as the processor has lanes: eight with AVX-512, four with AVX2, one where there is nothing better.
//! The instruction set is detected when the program starts; no compiler option is needed. The environment
//! variable `ACTIN_SIMD` sets it ([`arch`]).
//!
//! # How to read a wide function
//! It is written once, generic over `S: Simd`, for bodies that stand in the lanes of `S::f64s`.
//! Its formulas are those of a scalar function, the *reference*, which its documentation names
//! and against which a test holds it on random states. A loop is a value that implements
//! [`WithSimd`] and is handed to [`dispatch`], which compiles it for each kind of processor and
//! calls the right one; everything that it calls must be inlined into it, because only there are
//! the instructions enabled.
//!
//! [`Columns`] are the arrays that a loop reads, [`ColumnsMut`] those that it writes, cut into
//! groups of as many bodies as there are lanes. The last group may be short: lanes without a body
//! read zeros and write nothing. The reference of a formula is therefore defined at zero.
//!
//! # Functions instead of calls
//! `sin`, `cos` and `atan2` take one number at a time and would cost more than all other
//! arithmetic of a rod's step. All that is needed of them is even in the angle, so that it is a
//! function of the angle's square without root or quotient, and the angles are small: between
//! neighbours of a smooth chain, and over a drift. `functions.rs` holds polynomials for angles
//! up to a quarter of a radian and to about 1 rad. A larger angle is handed to the scalar
//! functions: a branch that is never taken in a sound simulation, and therefore free. The hyperbolic
//! tangent needs no such branch: it is halved down to small arguments and doubled back.
//!
//! # Accuracy
//! The polynomials are accurate to round-off. Products are fused with sums where the machine can,
//! so results may differ in the last digits from those of one lane, and do from the reference. They
//! are the same to the bit with four lanes and with eight: what a lane gets depends on its own body
//! and on its neighbours along the chain, not on who else is in the group, and sums over bodies
//! ([`Sums`], [`ShiftedUp`]) have one order.
#![allow(
    clippy::inline_always,
    reason = "vector code must be compiled into the function that enables the instructions"
)]

mod columns;
mod functions;
mod instructions;
mod rotations;
mod vectors;

pub use columns::{Columns, ColumnsMut, ShiftedDown, ShiftedUp, Sums};
pub use functions::{clamp, cosine_and_sinc, tanh};
pub use instructions::{INSTRUCTIONS, arch, chosen_arch};
pub use pulp::{Arch, Scalar, Simd, WithSimd};
pub use rotations::{
    WideQuaternion, log_with_coefficient, matrix, product, product_about_z, relative, turn,
    turn_back,
};
pub use vectors::{
    Wide3, WideMatrix, add, add3, cross, cross_add, dot, dot_add, in_lane, lane, load,
    load_quaternions, load3, mul, mul_add, mul_each, neg, read, scale, scale_add, splat, sub,
    transpose, write,
};

/// More lanes than any processor has.
const MOST_LANES: usize = 16;

/// Runs `loop_` with the instruction set of [`arch`].
#[inline]
pub fn dispatch<L: WithSimd>(loop_: L) -> L::Output {
    arch().dispatch(loop_)
}

#[cfg(test)]
mod tests;

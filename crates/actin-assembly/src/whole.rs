//! Conversions of floating-point numbers to whole numbers.
//!
//! They round towards zero and saturate at the bounds of the type.

/// Converts to a number of objects.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the conversion saturates"
)]
pub fn to_count(number: f64) -> usize {
    number as usize
}

/// Converts to a number of steps.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the conversion saturates"
)]
pub fn to_steps(number: f64) -> u64 {
    number as u64
}

/// Converts to an index that may be negative.
#[expect(clippy::cast_possible_truncation, reason = "the conversion saturates")]
pub fn to_index(number: f64) -> i64 {
    number as i64
}

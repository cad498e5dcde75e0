//! Means of series whose values depend on each other, with their errors. [`BlockAverages`] takes values one by
//! one; what they are is not known here.

mod blocks;

pub use blocks::{BlockAverages, Estimate};

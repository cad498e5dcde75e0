//! Means of correlated series with standard errors.

mod blocks;

pub use blocks::{BlockAverages, Estimate};

//! Integration tests of rods.

mod common;
mod energy_gradient;
mod homogenised;
mod laws;
mod paper_balance;
mod stiffness;

//! Least squares.

mod common;
mod coverage;
mod linear;
mod nist;
mod nonlinear;
mod sizes;

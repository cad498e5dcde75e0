//! Statistical Reference Datasets of NIST with certified values.
//!
//! Certified are the parameters and their standard deviations (15 digits for linear problems, 11
//! for nonlinear ones) and the residual sum of squares. Each test requires slightly fewer digits
//! than measured.
//!
//! # Source
//! <https://www.itl.nist.gov/div898/strd/>

mod dual;
mod linear;
mod nonlinear;
mod problems;

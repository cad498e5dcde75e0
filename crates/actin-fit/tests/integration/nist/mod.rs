//! Problems of the Statistical Reference Datasets of NIST, against their certified values.
//!
//! Certified are parameters, their standard deviations (15 digits for linear problems, 11 for
//! nonlinear ones) and the residual sum of squares. Digits are lost to the condition of a problem,
//! so each test asks for a few less than were measured.
//!
//! # Source
//! <https://www.itl.nist.gov/div898/strd/>

mod dual;
mod linear;
mod nonlinear;
mod problems;

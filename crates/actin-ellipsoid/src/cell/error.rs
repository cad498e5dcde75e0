//! Errors of cells.

use crate::InterfaceError;
use thiserror::Error;

/// Error of the construction or relaxation of a cell.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum CellError {
    /// The number of monomers is not a period of the helix.
    #[error(
        "a cell of {monomers} monomers: must be at least 3 and a period of the helix ({missing} rad \
         are missing)"
    )]
    NoPeriod {
        /// Number of monomers.
        monomers: usize,
        /// Difference of the total turn from full turns (rad).
        missing: f64,
    },
    /// An interface has no bonds.
    #[error(transparent)]
    Interface(#[from] InterfaceError),
    /// The minimisation did not converge.
    #[error(
        "relaxation of a cell under strain {strain:?} did not converge: residual {residual} pN after \
         {iterations} Newton steps, tolerance {allowed} pN"
    )]
    NoMinimum {
        /// Strains of the last iteration.
        strain: [f64; 6],
        /// Largest residual force (pN) or torque (pN nm) on a monomer.
        residual: f64,
        /// Tolerance of the residual.
        allowed: f64,
        /// Number of iterations.
        iterations: usize,
    },
}

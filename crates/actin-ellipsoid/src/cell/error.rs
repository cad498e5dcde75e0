//! Why a cell was refused, or has no response.

use crate::InterfaceError;
use thiserror::Error;

/// Why a cell was refused, or has no response.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum CellError {
    /// The monomers do not return to the azimuth of the first.
    #[error(
        "a cell of {monomers} monomers: must be at least 3 and a period of the helix ({missing} rad \
         are missing)"
    )]
    NoPeriod {
        /// Monomers of the cell.
        monomers: usize,
        /// What their turn differs by from whole turns (rad).
        missing: f64,
    },
    /// An interface has no bonds.
    #[error(transparent)]
    Interface(#[from] InterfaceError),
    /// No minimum was found.
    #[error(
        "cell under strain {strain:?}: residual {residual} pN after {iterations} Newton steps, \
         allowed {allowed} pN"
    )]
    NoMinimum {
        /// The strains, as far as they are given.
        strain: [f64; 6],
        /// Largest residual force (pN) or couple (pN nm) on a monomer.
        residual: f64,
        /// What is allowed.
        allowed: f64,
        /// Steps taken.
        iterations: usize,
    },
}

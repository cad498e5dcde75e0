//! How a run ended.

use actin_mechanics::Residual;

/// Why a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// The stop rule was met.
    Converged,
    /// All steps were made.
    Completed,
    /// An observer asked for the end.
    Interrupted,
}

/// How a run ended, and what it took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunOutcome {
    /// Why the run ended.
    pub reason: Reason,
    /// Steps made by this run.
    pub steps: u64,
    /// Time of the final state (ns), counted from step 0.
    pub time: f64,
    /// Evaluations of the loads during this run, those for observers, stop rule and the residual
    /// below included.
    pub force_evaluations: u64,
    /// Residual of the final state.
    pub residual: Residual,
    /// Kinetic energy of the free bodies in the final state (pN nm).
    pub kinetic: f64,
}

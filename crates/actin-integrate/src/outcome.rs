use actin_mechanics::Residual;

/// Reason why a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// The stop rule was met.
    Converged,
    /// All steps were made.
    Completed,
    /// An observer ended the run.
    Interrupted,
}

/// Outcome of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunOutcome {
    /// Reason why the run ended.
    pub reason: Reason,
    /// Number of steps of this run.
    pub steps: u64,
    /// Time of the final state (ns), counted from step 0.
    pub time: f64,
    /// Evaluations of the loads during this run, including those of observers and stop rule.
    pub force_evaluations: u64,
    /// Residual of the final state.
    pub residual: Residual,
    /// Kinetic energy of the free bodies in the final state (pN nm).
    pub kinetic: f64,
}

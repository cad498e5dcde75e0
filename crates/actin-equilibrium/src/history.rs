//! What a solve did.

use crate::motion::StepSize;
use actin_mechanics::Residual;

/// How a step was judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The energy fell as it should.
    Decrease,
    /// The energy is above where it was, and may stay so for some steps.
    Excursion,
    /// Excursions led nowhere; back to where they began and from there a shorter step.
    Return,
    /// The step changed the energy by less than its round-off, and the work of the loads or the
    /// residual fell.
    RoundOff,
}

/// One Newton step: the state that it started from, and how it went.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Iteration {
    /// Potential energy before the step (pN nm).
    pub energy: f64,
    /// Residual before the step.
    pub residual: Residual,
    /// Negative pivots of the unregularised stiffness before the step, in the chart of the step.
    pub negative_pivots: usize,
    /// Multiple of the metric that was added to the stiffness (pN/nm); of steps in which bodies carry one
    /// another along the largest stiffness that was added to a tie.
    pub regularization: f64,
    /// Stiffness added to each tie of neighbours per motion of that tie (pN/nm^2).
    pub stiffening: f64,
    /// Fraction of the (regularised) Newton step that was taken.
    pub fraction: f64,
    /// Largest displacement and turn.
    pub extent: StepSize,
    /// How the step was judged.
    pub verdict: Verdict,
}

/// What a solve cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SolverWork {
    /// Newton steps.
    pub iterations: u64,
    /// Evaluations of loads and energies.
    pub evaluations: u64,
    /// Assemblies of the stiffness.
    pub assemblies: u64,
    /// Numeric factorisations.
    pub factorizations: u64,
    /// Symbolic factorisations.
    pub symbolic_factorizations: u64,
    /// Entries of the factor.
    pub factor_entries: u64,
}

impl SolverWork {
    /// What has been done since `earlier`; the entries of the factor are those of now.
    pub(crate) fn since(&self, earlier: &Self) -> Self {
        Self {
            iterations: self.iterations - earlier.iterations,
            evaluations: self.evaluations - earlier.evaluations,
            assemblies: self.assemblies - earlier.assemblies,
            factorizations: self.factorizations - earlier.factorizations,
            symbolic_factorizations: self.symbolic_factorizations - earlier.symbolic_factorizations,
            factor_entries: self.factor_entries,
        }
    }
}

//! History and cost of a solve.

use crate::motion::StepSize;
use actin_mechanics::Residual;

/// Classification of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The energy decreased sufficiently.
    Decrease,
    /// The energy temporarily exceeds its previous value.
    Excursion,
    /// An unsuccessful excursion was reverted, and a shorter step made from its start.
    Return,
    /// The energy changed by less than rounding, and the work of the loads or the residual
    /// decreased.
    RoundOff,
}

/// One Newton step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Iteration {
    /// Potential energy before the step (pN nm).
    pub energy: f64,
    /// Residual before the step.
    pub residual: Residual,
    /// Negative pivots of the stiffness before the step, without regularisation.
    pub negative_pivots: usize,
    /// Multiple of the metric added to the stiffness (pN/nm); for carried steps the largest
    /// stiffness added to a pair of neighbours.
    pub regularization: f64,
    /// Stiffness added to each pair of neighbours per relative motion (pN/nm^2).
    pub stiffening: f64,
    /// Fraction of the regularised Newton step.
    pub fraction: f64,
    /// Largest displacement and rotation.
    pub extent: StepSize,
    /// Classification of the step.
    pub verdict: Verdict,
}

/// Cost of a solve.
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

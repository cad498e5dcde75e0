//! Result of a solve.

use crate::certificate::{Certificate, Stability};
use crate::history::{Iteration, SolverWork};
use actin_mechanics::Residual;
use thiserror::Error;

/// Reason for successful termination.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Convergence {
    /// The residual is within the tolerance, and one of the following holds:
    ///
    /// - The residual is below 1e-8 of the largest load.
    /// - The last step did not halve the residual.
    /// - The state is a saddle.
    /// - The residual is within 8 times its rounding error, and no interaction without stiffness
    ///   (such as a constant force) exerts loads.
    Converged,
    /// The residual exceeds the tolerance and does not decrease, but the loads on each body are
    /// within the tolerance or 8 times their rounding error. The factor is 100 instead of 8 if no
    /// step reduces the energy or the iteration limit is reached.
    FloorReached,
}

/// Equilibrium with its certificate and the history of the solve.
#[derive(Clone, Debug, PartialEq)]
pub struct Equilibrium {
    /// Reason for termination.
    pub ending: Convergence,
    /// Potential energy (pN nm).
    pub energy: f64,
    /// Residual of the state.
    pub residual: Residual,
    /// Estimated rounding error of the residual.
    pub floor: Residual,
    /// Certificate of stability; `None` if not requested.
    pub certificate: Option<Certificate>,
    /// Number of displacements along the lowest mode, from saddles and in slow descents of symmetric
    /// states.
    pub saddles_left: usize,
    /// Newton steps.
    pub history: Vec<Iteration>,
    /// Cost of the solve.
    pub work: SolverWork,
}

impl Equilibrium {
    /// Returns `true` if the stiffness has a negative eigenvalue according to the certificate.
    pub fn is_saddle(&self) -> bool {
        self.certificate
            .is_some_and(|c| matches!(c.stability(), Stability::Saddle { .. }))
    }
}

/// Cause of a failed solve.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SolveError {
    /// An interaction has no potential energy.
    #[error("the interaction {0:?} has no potential, so there is no energy to minimise")]
    NotConservative(&'static str),
    /// An interaction does not provide second derivatives.
    #[error(
        "the interaction {0:?} has no second derivatives: implement `Interaction::second_order`"
    )]
    NoStiffness(&'static str),
    /// Energy or loads of the initial state are not finite.
    #[error("energy or loads at the start are not finite")]
    NotFinite,
    /// A load acts along a motion whose stiffness is zero in the present state.
    #[error(
        "a load acts along a motion without stiffness in this state: hold a body, balance the loads, or tilt or \
         stretch linkers at rest that are perpendicular to the load"
    )]
    Unbounded,
    /// The iteration limit was reached.
    #[error("{0} steps were not enough")]
    IterationLimit(usize),
    /// No step reduces the energy or the residual.
    #[error("no step reduces the energy or the residual, whatever its length")]
    Stagnated,
    /// Every descent step moves bodies through each other.
    #[error("every descent step moves bodies through each other, which an interaction forbids")]
    PassesThrough,
    /// The stiffness is not finite, or no regularisation makes it positive definite.
    #[error("the stiffness cannot be made positive definite by adding {0:.3e} pN/nm")]
    NotFactorizable(f64),
    /// The observer interrupted the solve.
    #[error("interrupted by the observer")]
    Interrupted,
}

/// Failed solve. The state passed in has been set to the accepted state of lowest energy.
#[derive(Clone, Debug, PartialEq, Error)]
#[error(
    "no equilibrium after {} steps: {cause}; the residual is {:.3e} pN and {:.3e} pN nm \
     (round-off floor {:.1e} pN and {:.1e} pN nm); the best state was kept",
    history.len(), residual.force, residual.torque, floor.force, floor.torque
)]
pub struct NewtonFailure {
    /// Cause of the failure.
    pub cause: SolveError,
    /// Residual of the returned state.
    pub residual: Residual,
    /// Estimated rounding error of the residual.
    pub floor: Residual,
    /// Newton steps.
    pub history: Vec<Iteration>,
    /// Cost of the solve.
    pub work: SolverWork,
}

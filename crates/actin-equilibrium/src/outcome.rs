//! How a solve ends: an equilibrium, or a failure that says why.

use crate::certificate::{Certificate, Stability};
use crate::history::{Iteration, SolverWork};
use actin_mechanics::Residual;
use thiserror::Error;

/// Why a solve that ended well ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Convergence {
    /// The residual is within the tolerance and at most 1e-8 of the largest load, or it is within the tolerance and
    /// further steps are of no use: the last one did not halve it, the state is a saddle, or it is at most 8 times the
    /// rounding error and no interaction without stiffness exerts a load. Couples and forces at an arm have a
    /// stiffness, so that those below the rounding error cause no motion.
    Converged,
    /// The residual is above the tolerance and does not fall any more, but the loads of each body
    /// are within the tolerance or within 8 times what rounding leaves of them at that body (100
    /// times where no step, however short, helps, or the last one allowed has been made).
    FloorReached,
}

/// A state without residual loads, and what is known of it.
///
/// Whether it is stable is in the certificate; [`is_saddle`](Equilibrium::is_saddle) asks.
#[derive(Clone, Debug, PartialEq)]
pub struct Equilibrium {
    /// Why the solve ended.
    pub ending: Convergence,
    /// Potential energy (pN nm).
    pub energy: f64,
    /// Residual of the state.
    pub residual: Residual,
    /// Estimate of the residual that rounding of coordinates alone leaves.
    pub floor: Residual,
    /// What the stiffness says; `None` if it was not asked for.
    pub certificate: Option<Certificate>,
    /// Saddles that were left on the way here.
    pub saddles_left: usize,
    /// The steps.
    pub history: Vec<Iteration>,
    /// What it took.
    pub work: SolverWork,
}

impl Equilibrium {
    /// Whether the stiffness is known to have a negative eigenvalue.
    pub fn is_saddle(&self) -> bool {
        self.certificate
            .is_some_and(|c| matches!(c.stability(), Stability::Saddle { .. }))
    }
}

/// Why a solve failed.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SolveError {
    /// An interaction has no energy to be minimised.
    #[error("the interaction {0:?} has no potential, so there is no energy to minimise")]
    NotConservative(&'static str),
    /// An interaction does not know its second derivatives.
    #[error("the interaction {0:?} has no second derivatives")]
    NoStiffness(&'static str),
    /// Energy or loads at the start are not finite.
    #[error("energy or loads at the start are not finite")]
    NotFinite,
    /// The energy has no minimum.
    #[error(
        "a load acts along a motion that nothing resists, so that the energy falls without bound; hold a body \
         there, or balance the loads"
    )]
    Unbounded,
    /// Too many steps.
    #[error("{0} steps were not enough")]
    IterationLimit(usize),
    /// No step, however short, lowers the energy or the residual.
    #[error("no step, however short, lowers the energy or the residual")]
    Stagnated,
    /// Every step downhill leads bodies through each other that an interaction keeps apart.
    #[error("the way to lower energy leads through what an interaction keeps away")]
    PassesThrough,
    /// The stiffness has entries that are not finite, or no regularisation makes it definite.
    #[error("the stiffness cannot be made positive definite by adding {0:.3e} pN/nm")]
    NotFactorizable(f64),
    /// The observer asked for the end.
    #[error("the observer asked for the end")]
    Interrupted,
}

/// A solve that did not reach an equilibrium.
///
/// The state that was passed in has been left at the best state reached: the one of lowest energy
/// among those that were accepted.
#[derive(Clone, Debug, PartialEq, Error)]
#[error(
    "no equilibrium after {} steps: {cause}; the residual is {:.3e} pN and {:.3e} pN nm \
     (round-off floor {:.1e} pN and {:.1e} pN nm); the best state was kept",
    history.len(), residual.force, residual.torque, floor.force, floor.torque
)]
pub struct NewtonFailure {
    /// What went wrong.
    pub cause: SolveError,
    /// Residual of the state that was kept.
    pub residual: Residual,
    /// Estimate of the residual that rounding alone leaves.
    pub floor: Residual,
    /// The steps.
    pub history: Vec<Iteration>,
    /// What it took.
    pub work: SolverWork,
}

//! An equilibrium in one call, and the error of all of this crate's tasks.

use crate::{
    Equilibrium, Layout, LayoutError, Newton, NewtonFailure, NewtonOptions, OptionsError,
    PathFailure, SolveError,
};
use actin_mechanics::{Interaction, State};
use thiserror::Error;

/// Saddles that [`relax`] leaves before it gives up.
const SADDLES: usize = 8;

/// Why there is no equilibrium: what any function of this crate may return, for use with `?`.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum EquilibriumError {
    /// A setting makes no sense.
    #[error(transparent)]
    Options(#[from] OptionsError),
    /// The unknowns do not fit the state.
    #[error(transparent)]
    Layout(#[from] LayoutError),
    /// Interactions without energy or second derivatives, or with ones that are not finite.
    #[error(transparent)]
    SolveError(#[from] SolveError),
    /// The solver did not converge.
    #[error(transparent)]
    Newton(#[from] Box<NewtonFailure>),
    /// What was found is a saddle still.
    #[error("still at a saddle after {0} saddles were left")]
    Saddle(usize),
    /// A path of equilibria ended too early.
    #[error(transparent)]
    Path(#[from] Box<PathFailure>),
}

/// Moves the free bodies of `state` to a stable equilibrium of `interactions` near it.
///
/// This is [`Newton`] with its default options, on all free bodies; saddles are left on the way.
/// What is to be set (tolerances, order of unknowns, bodies that move as one) asks for a
/// [`Newton`] of one's own, and several solves of one model are faster with it.
///
/// # Errors
/// If none is found; `state` is then the best state reached.
pub fn relax(
    state: &mut State,
    interactions: &[Box<dyn Interaction>],
) -> Result<Equilibrium, EquilibriumError> {
    let mut newton = Newton::new(Layout::free(state), NewtonOptions::default())?;
    let equilibrium = newton.minimize(state, interactions, SADDLES)?;
    if equilibrium.is_saddle() {
        return Err(EquilibriumError::Saddle(equilibrium.saddles_left));
    }
    Ok(equilibrium)
}

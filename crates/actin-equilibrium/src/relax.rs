//! Equilibrium in one call.

use crate::{
    Equilibrium, Layout, LayoutError, Newton, NewtonFailure, NewtonOptions, OptionsError,
    PathFailure, SolveError,
};
use actin_mechanics::{Interaction, State};
use thiserror::Error;

/// Maximum number of displacements from saddles in [`relax`].
const SADDLES: usize = 8;

/// Error of any function of this crate, for use with `?`.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum EquilibriumError {
    /// An option is invalid.
    #[error(transparent)]
    Options(#[from] OptionsError),
    /// The layout does not match the state.
    #[error(transparent)]
    Layout(#[from] LayoutError),
    /// Invalid interactions: no energy, no second derivatives, or non-finite values.
    #[error(transparent)]
    SolveError(#[from] SolveError),
    /// Newton's method did not converge.
    #[error(transparent)]
    Newton(#[from] Box<NewtonFailure>),
    /// The result is a saddle.
    #[error(
        "the result is a saddle, after {0} displacements from saddles: displace the initial state"
    )]
    Saddle(usize),
    /// A path of equilibria ended early.
    #[error(transparent)]
    Path(#[from] Box<PathFailure>),
}

/// Moves the free bodies of `state` to a nearby stable equilibrium of `interactions`.
///
/// Equivalent to [`Newton::minimize`] with default options on all free bodies. Use [`Newton`]
/// directly to set tolerances or the order, and for repeated solves of one model.
///
/// # Errors
/// If no stable equilibrium is found; `state` is then the best state reached.
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

//! What a composition method is. The tables themselves are in `schemes`.

use crate::schemes;
use std::fmt;
use thiserror::Error;

/// The two flows that a method alternates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Free motion.
    Drift,
    /// Action of the loads at fixed positions.
    Kick,
}

impl Stage {
    /// The other one.
    #[must_use]
    pub const fn other(self) -> Self {
        match self {
            Self::Drift => Self::Kick,
            Self::Kick => Self::Drift,
        }
    }
}

/// A symmetric composition of drifts and kicks, as a table with its citation.
///
/// One step of size `h` applies the stages in turn, beginning with [`first`](Self::first), the
/// `k`-th for a time `coefficients[k] * h`. The table has an odd number of entries and reads the
/// same backwards; the entries of each stage add up to 1.
///
/// The order holds only if drift and kick are flows: `drift(a)` then `drift(b)` must be
/// `drift(a + b)`. Where a drift is only symmetric, compose steps of [`POSITION_VERLET`] by hand
/// with the [`SUZUKI_WEIGHT`].
///
/// [`POSITION_VERLET`]: crate::POSITION_VERLET
/// [`SUZUKI_WEIGHT`]: crate::SUZUKI_WEIGHT
///
/// ```
/// use actin_integrate::Composition;
/// let scheme = Composition::by_name("pefrl").unwrap();
/// assert_eq!((scheme.order, scheme.force_evaluations_per_step()), (4, 4));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Composition {
    /// The name by which scenes choose it.
    pub name: &'static str,
    /// Order of the global error in the step.
    pub order: u32,
    /// What a step begins and ends with.
    pub first: Stage,
    /// Durations of the stages in units of the step.
    pub coefficients: &'static [f64],
    /// Smallest `omega h` at which the harmonic oscillator is no longer stable.
    pub stability_limit: f64,
    /// Where the table is from.
    pub source: &'static str,
}

impl Composition {
    /// All methods.
    pub fn all() -> &'static [Self] {
        schemes::ALL
    }

    /// The method of that name.
    ///
    /// # Errors
    /// A name that no method has.
    pub fn by_name(name: &str) -> Result<&'static Self, UnknownScheme> {
        Self::all()
            .iter()
            .find(|scheme| scheme.name == name)
            .ok_or_else(|| UnknownScheme(name.to_owned()))
    }

    /// The stages of one step in order, with their durations in units of the step.
    pub fn stages(&self) -> impl Iterator<Item = (Stage, f64)> + '_ {
        let pair = [self.first, self.first.other()];
        pair.into_iter()
            .cycle()
            .zip(self.coefficients.iter().copied())
    }

    /// Evaluations of the loads per step in a long run.
    ///
    /// A method that ends with a kick leaves loads that its next step begins with; the very first
    /// step costs one more.
    pub fn force_evaluations_per_step(&self) -> usize {
        // Of an odd number of alternating stages, all but the repeated first of a method that
        // begins with kicks need loads at new positions.
        self.coefficients.len() / 2
    }
}

impl fmt::Display for Composition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}

/// A name that no method has.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("no integration method is called {0:?}; known are {known}", known = known_names())]
pub struct UnknownScheme(pub String);

/// The names of all methods, for messages.
fn known_names() -> String {
    let names: Vec<_> = Composition::all().iter().map(|s| s.name).collect();
    names.join(", ")
}

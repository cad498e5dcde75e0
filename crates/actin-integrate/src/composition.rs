//! What a composition method is. The tables themselves are in `schemes`.

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

/// By how much the coefficients of one stage may miss 1, and a table its reverse: round-off of a
/// dozen numbers of size one.
const ROUND_OFF: f64 = 1e-13;

/// A symmetric composition of drifts and kicks, as a table with its citation.
///
/// One step of size `h` applies the stages in turn, beginning with [`first`](Self::first), the
/// `k`-th for a time `coefficients()[k] * h`. The table has an odd number of entries and reads the
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
/// assert_eq!((scheme.order(), scheme.force_evaluations_per_step()), (4, 4));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Composition {
    pub(crate) name: &'static str,
    pub(crate) order: u32,
    pub(crate) first: Stage,
    pub(crate) coefficients: &'static [f64],
    pub(crate) stability_limit: f64,
    pub(crate) source: &'static str,
}

impl Composition {
    /// A method of one's own: its `name`, the `order` of its error, what a step begins with, the
    /// `coefficients` of its stages in units of the step, its `stability_limit` (the smallest
    /// `omega h` at which the harmonic oscillator is not stable) and the `source` of the table.
    ///
    /// Order and limit are taken as they are given; only the table is checked.
    ///
    /// # Errors
    /// A table of an even number of entries or of fewer than three, with a number that is not
    /// finite, that does not read the same backwards, or in which drifts or kicks do not add up to 1;
    /// an order of zero; a limit that is not positive and finite.
    ///
    /// ```
    /// use actin_integrate::{Composition, CompositionError, Stage};
    /// let table = |coefficients| {
    ///     Composition::new("mine", 2, Stage::Drift, coefficients, 2.0, "by hand")
    /// };
    /// assert!(table(&[0.5, 1.0, 0.5]).is_ok());
    /// let error = table(&[0.5, 0.6, 0.5]).unwrap_err();
    /// assert_eq!(error, CompositionError::Sum(Stage::Kick, 0.6));
    /// ```
    pub fn new(
        name: &'static str,
        order: u32,
        first: Stage,
        coefficients: &'static [f64],
        stability_limit: f64,
        source: &'static str,
    ) -> Result<Self, CompositionError> {
        if order == 0 {
            return Err(CompositionError::Order);
        }
        if !(stability_limit.is_finite() && stability_limit > 0.0) {
            return Err(CompositionError::Limit(stability_limit));
        }
        let method = Self {
            name,
            order,
            first,
            coefficients,
            stability_limit,
            source,
        };
        method.check_table().map(|()| method)
    }

    fn check_table(&self) -> Result<(), CompositionError> {
        let table = self.coefficients;
        if table.len() < 3 || table.len().is_multiple_of(2) {
            return Err(CompositionError::Length(table.len()));
        }
        if let Some(bad) = table.iter().find(|c| !c.is_finite()) {
            return Err(CompositionError::NotFinite(*bad));
        }
        let is_asymmetric = |k: &usize| (table[*k] - table[table.len() - 1 - k]).abs() > ROUND_OFF;
        if let Some(k) = (0..table.len()).find(is_asymmetric) {
            return Err(CompositionError::Asymmetric(k));
        }
        for stage in [Stage::Drift, Stage::Kick] {
            let of_stage = self.stages().filter(|(kind, _)| *kind == stage);
            let sum: f64 = of_stage.map(|(_, c)| c).sum();
            if (sum - 1.0).abs() > ROUND_OFF {
                return Err(CompositionError::Sum(stage, sum));
            }
        }
        Ok(())
    }

    /// The name by which scenes choose it.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// Order of the global error in the step.
    pub fn order(&self) -> u32 {
        self.order
    }

    /// What a step begins and ends with.
    pub fn first(&self) -> Stage {
        self.first
    }

    /// Durations of the stages in units of the step.
    pub fn coefficients(&self) -> &'static [f64] {
        self.coefficients
    }

    /// Smallest `omega h` at which the harmonic oscillator is no longer stable.
    pub fn stability_limit(&self) -> f64 {
        self.stability_limit
    }

    /// Where the table is from.
    pub fn source(&self) -> &'static str {
        self.source
    }

    /// The stages of one step in order, with their durations in units of the step.
    pub fn stages(&self) -> impl Iterator<Item = (Stage, f64)> + '_ {
        let pair = [self.first, self.first.other()];
        pair.into_iter()
            .cycle()
            .zip(self.coefficients.iter().copied())
    }

    /// `<k x^2>/kT` of an oscillator in a heat bath, 1 in theory, if a conservative step of this method
    /// lasts `theta` radians of it, `theta = b omega h` with `b` of
    /// [`Drag::time_rescaling`](crate::Drag::time_rescaling). Velocities have exactly `kT`.
    ///
    /// One step takes `(x, v/omega)` by a matrix `[[a, b], [c, a]]` of determinant 1, which leaves
    /// `-c x^2 + b (v/omega)^2` as it is: the ratio is `-b/c`. It has no meaning above the stability
    /// limit.
    ///
    /// ```
    /// // Positions are too cold by (omega h)^2/4 with position Verlet.
    /// let ratio = actin_integrate::POSITION_VERLET.configurational_temperature(1.0);
    /// assert!((ratio - 0.75).abs() < 1e-15);
    /// ```
    pub fn configurational_temperature(&self, theta: f64) -> f64 {
        let column = |mut x: f64, mut v: f64| {
            for (stage, coefficient) in self.stages() {
                match stage {
                    Stage::Drift => x += coefficient * theta * v,
                    Stage::Kick => v -= coefficient * theta * x,
                }
            }
            (x, v)
        };
        let ((_, c), (b, _)) = (column(1.0, 0.0), column(0.0, 1.0));
        -b / c
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

/// Why a table was refused.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum CompositionError {
    /// The number of entries is even, or less than three.
    #[error("a table has an odd number of at least 3 entries, got {0}")]
    Length(usize),
    /// An entry is not finite.
    #[error("the entries of a table must be finite, got {0}")]
    NotFinite(f64),
    /// The entry of this index, counted from 0, is not that of the same index from behind.
    #[error("a table reads the same backwards, but entry {0} does not")]
    Asymmetric(usize),
    /// The entries of one stage do not add up to 1, so that a step would not last its time.
    #[error("the entries of a stage must add up to 1, those of {0:?} add up to {1}")]
    Sum(Stage, f64),
    /// The order is zero.
    #[error("the order must be at least 1, got 0")]
    Order,
    /// The stability limit is not positive and finite.
    #[error("the stability limit must be positive and finite, got {0}")]
    Limit(f64),
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(coefficients: &'static [f64]) -> Result<Composition, CompositionError> {
        Composition::new("mine", 2, Stage::Kick, coefficients, 2.0, "by hand")
    }

    /// A table whose drifts add up to 0.6 would move a free body by 0.6 of its way without a word.
    #[test]
    fn tables_that_are_no_steps_are_refused() {
        let refused = |coefficients| table(coefficients).unwrap_err();
        for (len, coefficients) in [(0, &[][..]), (1, &[1.0]), (2, &[0.5; 2]), (4, &[0.5; 4])] {
            assert_eq!(refused(coefficients), CompositionError::Length(len));
        }
        for bad in [f64::NAN, f64::INFINITY] {
            let coefficients = Box::leak(Box::new([0.5, bad, 0.5]));
            assert!(matches!(
                refused(coefficients),
                CompositionError::NotFinite(_)
            ));
        }
        assert_eq!(refused(&[0.4, 1.0, 0.6]), CompositionError::Asymmetric(0));
        for (sum, coefficients) in [(0.0, &[0.5, 0.0, 0.5]), (0.6, &[0.5, 0.6, 0.5])] {
            let error = CompositionError::Sum(Stage::Drift, sum);
            assert_eq!(refused(coefficients), error);
        }
        assert_eq!(
            refused(&[1.0, 1.0, 1.0]),
            CompositionError::Sum(Stage::Kick, 2.0)
        );
    }

    #[test]
    fn orders_and_limits_without_a_meaning_are_refused() {
        let with = |order, limit| {
            Composition::new("mine", order, Stage::Drift, &[0.5, 1.0, 0.5], limit, "")
        };
        assert_eq!(with(0, 2.0), Err(CompositionError::Order));
        for bad in [0.0, -2.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(with(2, bad), Err(CompositionError::Limit(_))));
        }
    }

    /// The tables of this crate pass the check of any other.
    #[test]
    fn known_tables_pass() {
        for scheme in Composition::all() {
            scheme.check_table().unwrap();
        }
    }
}

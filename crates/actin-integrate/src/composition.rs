use std::fmt;
use thiserror::Error;

/// Stage of a method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Free motion.
    Drift,
    /// Effect of the loads at fixed positions.
    Kick,
}

impl Stage {
    /// Other kind of stage.
    #[must_use]
    pub(crate) const fn other(self) -> Self {
        match self {
            Self::Drift => Self::Kick,
            Self::Kick => Self::Drift,
        }
    }
}

/// Tolerance of sums and symmetry: rounding errors of a dozen numbers of order one.
const ROUND_OFF: f64 = 1e-13;

/// Symmetric composition of drifts and kicks: a table with its source.
///
/// A step of size `h` applies alternating stages, beginning with [`first`](Self::first). Stage `k`
/// lasts `coefficients()[k] * h`. The table has an odd number of entries and is symmetric, and the
/// entries of each kind of stage add up to 1.
///
/// The order holds if drift and kick are flows: `drift(a)` and `drift(b)` must equal
/// `drift(a + b)`. For drifts that are only symmetric, compose steps of [`POSITION_VERLET`] with
/// the kicks of [`SUZUKI`](crate::SUZUKI).
///
/// [`POSITION_VERLET`]: crate::POSITION_VERLET
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
    /// Creates a custom method from its `name`, `order`, `first` stage, `coefficients` in units of
    /// the step, `stability_limit` (smallest unstable `omega h` of the harmonic oscillator) and
    /// `source`.
    ///
    /// Order and limit are not verified.
    ///
    /// # Errors
    /// If the table is shorter than three entries, has an even length, is not finite or not
    /// symmetric, or if drifts or kicks do not add up to 1. Also if the order is zero or the limit
    /// is not positive and finite.
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

    /// Name of the method in scenes.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// Order of the global error in the step.
    pub fn order(&self) -> u32 {
        self.order
    }

    /// First and last stage of a step.
    pub fn first(&self) -> Stage {
        self.first
    }

    /// Durations of the stages in units of the step.
    pub fn coefficients(&self) -> &'static [f64] {
        self.coefficients
    }

    /// Smallest unstable `omega h` of the harmonic oscillator.
    pub fn stability_limit(&self) -> f64 {
        self.stability_limit
    }

    /// Source of the table.
    pub fn source(&self) -> &'static str {
        self.source
    }

    /// Stages of a step in order, with their durations in units of the step.
    pub fn stages(&self) -> impl Iterator<Item = (Stage, f64)> + '_ {
        let pair = [self.first, self.first.other()];
        pair.into_iter()
            .cycle()
            .zip(self.coefficients.iter().copied())
    }

    /// Ratio `<k x^2>/kT` of an oscillator in a heat bath, exactly 1 in theory, for a conservative
    /// step of `theta = b omega h` with `b` of
    /// [`Drag::time_rescaling`](crate::Drag::time_rescaling). Velocities have exactly `kT`.
    ///
    /// A step maps `(x, v/omega)` by a matrix `[[a, b], [c, a]]` of determinant 1, which conserves
    /// `-c x^2 + b (v/omega)^2`. The ratio is `-b/c`; it is meaningless above the stability limit.
    ///
    /// ```
    /// // Position Verlet: the temperature of positions is too low by (omega h)^2/4.
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
    /// Methods that end with a kick reuse the loads in the next step and need one more evaluation
    /// in the first.
    pub fn force_evaluations_per_step(&self) -> usize {
        // A method that begins with a kick reuses the loads of its last stage.
        self.coefficients.len() / 2
    }
}

impl fmt::Display for Composition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}

/// Error of the construction of a method.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum CompositionError {
    /// The number of entries is even, or less than three.
    #[error("a table must have an odd number of entries, at least 3, got {0}")]
    Length(usize),
    /// An entry is not finite.
    #[error("the entries of a table must be finite, got {0}")]
    NotFinite(f64),
    /// The table is not symmetric at this index, counted from 0.
    #[error("a table must be symmetric, but entry {0} differs from its mirror image")]
    Asymmetric(usize),
    /// The entries of a stage do not add up to 1.
    #[error("the entries of a stage must add up to 1, but those of {0:?} add up to {1}")]
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

    #[test]
    fn invalid_tables_are_refused() {
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
    fn invalid_orders_and_limits_are_refused() {
        let with = |order, limit| {
            Composition::new("mine", order, Stage::Drift, &[0.5, 1.0, 0.5], limit, "")
        };
        assert_eq!(with(0, 2.0), Err(CompositionError::Order));
        for bad in [0.0, -2.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(with(2, bad), Err(CompositionError::Limit(_))));
        }
    }

    #[test]
    fn known_tables_pass() {
        for scheme in Composition::all() {
            scheme.check_table().unwrap();
        }
    }

    #[test]
    fn errors_of_unknown_names_list_the_known_ones() {
        let message = Composition::by_name("verlet").unwrap_err().to_string();
        assert!(message.contains("\"verlet\"") && message.contains("position-verlet"));
    }
}

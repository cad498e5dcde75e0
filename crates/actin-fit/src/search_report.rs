//! What a search says of itself: why it ended, and how far it was from its end.

use std::fmt;

/// Why a search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Termination {
    /// The model meets the data to rounding.
    Exact,
    /// The residuals are orthogonal to what the free parameters can change, within the tolerance.
    Stationary,
    /// Chi squared changes by no more than its rounding.
    RoundingFloor,
    /// No shorter step lowers chi squared, though the derivatives promise it: they may be wrong, or
    /// the model is not smooth there.
    Stalled,
    /// The iterations were used up.
    Iterations,
    /// The model, its derivatives or their squares are not finite where the search is.
    NotFinite {
        /// The first such point, or the one that is farthest off.
        point: usize,
    },
}

impl fmt::Display for Termination {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Exact => write!(f, "meets the data to rounding"),
            Self::Stationary => write!(f, "reached a minimum"),
            Self::RoundingFloor => write!(f, "came down to the rounding of chi squared"),
            Self::Stalled => write!(
                f,
                "stalled: no shorter step lowers chi squared, though the derivatives promise it \
                 (are they those of the model?)"
            ),
            Self::Iterations => write!(f, "used up its iterations"),
            Self::NotFinite { point } => write!(
                f,
                "met a model or derivative that is infinite, not a number or too large to be \
                 squared at point {point}"
            ),
        }
    }
}

impl Termination {
    /// Whether what was found is a minimum within the bounds, as far as the search can tell.
    pub fn is_converged(self) -> bool {
        matches!(self, Self::Exact | Self::Stationary | Self::RoundingFloor)
    }
}

/// How far a search was from its end.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Progress {
    /// Largest cosine between the residuals and the derivatives by a free parameter, which must
    /// fall to that of [`Options`](crate::Options).
    pub cosine: f64,
    /// The parameter of that cosine; `None` where none is free.
    pub parameter: Option<usize>,
    /// Largest change of a parameter in the last step, over its value.
    pub step: f64,
    /// The last damping, relative to the squared lengths of columns.
    pub damping: f64,
}

/// How the search from one start ended.
#[derive(Clone, Debug, PartialEq)]
pub struct StartReport {
    /// Where it started.
    pub start: Vec<f64>,
    /// Where it ended.
    pub parameters: Vec<f64>,
    /// Chi squared where it ended.
    pub chi_squared: f64,
    /// Why it ended.
    pub ending: Termination,
    /// Number of linearisations.
    pub iterations: usize,
    /// Number of times that all points were evaluated, derivatives not counted.
    pub evaluations: usize,
    /// How far it was from its end.
    pub last: Progress,
}

impl StartReport {
    /// Why the search ended, in a sentence without its subject.
    pub(crate) fn reason(&self, allowed: f64) -> String {
        let Progress {
            cosine,
            parameter,
            step,
            damping,
        } = self.last;
        let gradient = parameter.map_or_else(String::new, |j| {
            format!(
                "; the cosine between residuals and the derivatives by parameter {j} is \
                 {cosine:.1e} and must be at most {allowed:.1e}; the last step changed a parameter \
                 by {step:.1e} of its value, damping {damping:.1e}"
            )
        });
        format!(
            "{} (iterations: {}, evaluations: {}, chi squared: {:.4e}){gradient}",
            self.ending, self.iterations, self.evaluations, self.chi_squared
        )
    }
}

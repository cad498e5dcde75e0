use std::fmt;

/// Reason why a search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Termination {
    /// The residuals are zero within rounding.
    Exact,
    /// The residuals are orthogonal to the columns of the free parameters, within the tolerance.
    Stationary,
    /// Changes of chi squared are within rounding.
    RoundingFloor,
    /// No step reduces chi squared, although the derivatives predict a decrease. The derivatives
    /// may be wrong, or the model may not be smooth.
    Stalled,
    /// The maximum number of iterations was reached.
    Iterations,
    /// The model, a derivative or one of their squares is not finite.
    NotFinite {
        /// First such point, or the one with the largest residual.
        point: usize,
    },
}

impl fmt::Display for Termination {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Exact => write!(f, "reached an exact fit"),
            Self::Stationary => write!(f, "reached a minimum"),
            Self::RoundingFloor => write!(f, "reached the rounding error of chi squared"),
            Self::Stalled => write!(
                f,
                "stalled: no step reduces chi squared, although the derivatives predict a decrease; \
                 check the derivatives of the model"
            ),
            Self::Iterations => write!(f, "reached the maximum number of iterations"),
            Self::NotFinite { point } => write!(
                f,
                "met a model or derivative that is infinite, not a number or too large to be squared \
                 at point {point}"
            ),
        }
    }
}

impl Termination {
    /// Returns `true` if the search ended at a minimum within the bounds.
    pub fn is_converged(self) -> bool {
        matches!(self, Self::Exact | Self::Stationary | Self::RoundingFloor)
    }
}

/// Convergence of a search.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Progress {
    /// Largest cosine between the residuals and the column of a free parameter. A search converges
    /// when it falls below the tolerance of [`Options`](crate::Options).
    pub cosine: f64,
    /// Parameter of the largest cosine, or `None` if all parameters are fixed or at a bound.
    pub parameter: Option<usize>,
    /// Largest relative change of a parameter in the last step.
    pub step: f64,
    /// Last damping, relative to the squared scales.
    pub damping: f64,
}

/// Report of the search from one start.
#[derive(Clone, Debug, PartialEq)]
pub struct StartReport {
    /// Start of the search.
    pub start: Vec<f64>,
    /// Parameters at the end of the search.
    pub parameters: Vec<f64>,
    /// Chi squared at the end of the search.
    pub chi_squared: f64,
    /// Reason why the search ended.
    pub ending: Termination,
    /// Number of linearisations.
    pub iterations: usize,
    /// Number of evaluations of the model at all points, without derivatives.
    pub evaluations: usize,
    /// Convergence at the end of the search.
    pub last: Progress,
}

impl StartReport {
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

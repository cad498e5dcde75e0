use std::fmt;

/// Function `f(x; p)` with derivatives with respect to the parameters.
///
/// [`check_gradient`](crate::check_gradient) compares `gradient` with finite differences of
/// `value`.
pub trait Model {
    /// Number of parameters.
    fn parameters(&self) -> usize;

    /// Evaluates `f(x; p)` for a row `x` of independent variables.
    fn value(&self, x: &[f64], p: &[f64]) -> f64;

    /// Writes `df/dp_j` of all parameters to `gradient`.
    fn gradient(&self, x: &[f64], p: &[f64], gradient: &mut [f64]);
}

/// Model defined by two closures.
///
/// ```
/// use actin_fit::{ClosureModel, Model};
///
/// // p0 exp(-p1 x)
/// let decay = ClosureModel::new(
///     2,
///     |x, p| p[0] * (-p[1] * x[0]).exp(),
///     |x, p, gradient| {
///         let e = (-p[1] * x[0]).exp();
///         gradient.copy_from_slice(&[e, -x[0] * p[0] * e]);
///     },
/// );
/// assert_eq!(decay.value(&[0.0], &[3.0, 1.0]), 3.0);
/// ```
#[derive(Clone, Copy)]
pub struct ClosureModel<V, G> {
    parameters: usize,
    value: V,
    gradient: G,
}

impl<V, G> ClosureModel<V, G>
where
    V: Fn(&[f64], &[f64]) -> f64,
    G: Fn(&[f64], &[f64], &mut [f64]),
{
    /// Creates a model from `value(x, p)` and `gradient(x, p, out)`.
    pub fn new(parameters: usize, value: V, gradient: G) -> Self {
        Self {
            parameters,
            value,
            gradient,
        }
    }
}

impl<V, G> Model for ClosureModel<V, G>
where
    V: Fn(&[f64], &[f64]) -> f64,
    G: Fn(&[f64], &[f64], &mut [f64]),
{
    fn parameters(&self) -> usize {
        self.parameters
    }

    fn value(&self, x: &[f64], p: &[f64]) -> f64 {
        (self.value)(x, p)
    }

    fn gradient(&self, x: &[f64], p: &[f64], gradient: &mut [f64]) {
        (self.gradient)(x, p, gradient);
    }
}

impl<V, G> fmt::Debug for ClosureModel<V, G> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ClosureModel")
            .field("parameters", &self.parameters)
            .finish_non_exhaustive()
    }
}

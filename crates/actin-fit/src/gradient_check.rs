use crate::data::Data;
use crate::error::{FitError, same_length};
use crate::model::Model;

/// Relative step: `eps^(1/5)` balances the truncation error of order `h^4` and the rounding error
/// of order `eps / h`. The remaining relative error is about `eps^(4/5)` = 3e-13.
const RELATIVE_STEP: f64 = 7.4e-4;

/// Largest deviation between analytic and numeric derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GradientCheck {
    /// Largest deviation, relative to the largest derivative with respect to the same parameter.
    pub error: f64,
    /// Index of the point.
    pub point: usize,
    /// Index of the parameter.
    pub parameter: usize,
    /// Derivative of the model.
    pub analytic: f64,
    /// Derivative by finite differences.
    pub numeric: f64,
}

/// Compares the gradient of a model with central differences of fourth order at all points.
///
/// The step is `7.4e-4 |p_j|`, or 7.4e-4 if `p_j = 0`; choose parameters near the fitted ones. The
/// error is near 1e-11 for a correct gradient of a smooth model and near 1 for a wrong one.
///
/// ```
/// use actin_fit::{ClosureModel, Data, Observations, check_gradient};
///
/// let data = Data::new(&[1.0, 2.0], Observations::new(&[0.0, 0.0])?)?;
/// let slip = ClosureModel::new(1, |x, p| p[0] * p[0] * x[0], |x, p, g| g[0] = p[0] * x[0]);
/// // The factor 2 is missing in the derivative.
/// let check = check_gradient(&slip, &data, &[3.0])?;
/// assert!((check.error - 0.5).abs() < 1e-9);
/// # Ok::<(), actin_fit::FitError>(())
/// ```
///
/// # Errors
/// If the number of parameters is wrong, or the model is not finite.
pub fn check_gradient(
    model: &dyn Model,
    data: &Data,
    parameters: &[f64],
) -> Result<GradientCheck, FitError> {
    same_length("parameters", model.parameters(), parameters.len())?;
    let n = parameters.len();
    let analytic = analytic(model, data, parameters)?;
    let mut worst = GradientCheck {
        error: 0.0,
        point: 0,
        parameter: 0,
        analytic: 0.0,
        numeric: 0.0,
    };
    for j in 0..n {
        let numeric: Vec<f64> = (0..data.len())
            .map(|i| difference(model, data.row(i), parameters, j))
            .collect();
        let column = || analytic.iter().skip(j).step_by(n).copied();
        let largest = column()
            .chain(numeric.iter().copied())
            .fold(f64::MIN_POSITIVE, |m, v| v.abs().max(m));
        for (i, (a, d)) in column().zip(&numeric).enumerate() {
            if !d.is_finite() {
                return Err(FitError::ModelNotFinite {
                    point: i,
                    value: *d,
                });
            }
            let error = (a - d).abs() / largest;
            if error > worst.error {
                worst = GradientCheck {
                    error,
                    point: i,
                    parameter: j,
                    analytic: a,
                    numeric: *d,
                };
            }
        }
    }
    Ok(worst)
}

fn analytic(model: &dyn Model, data: &Data, p: &[f64]) -> Result<Vec<f64>, FitError> {
    let mut all = vec![0.0; data.len() * p.len()];
    for (point, gradient) in all.chunks_exact_mut(p.len().max(1)).enumerate() {
        model.gradient(data.row(point), p, gradient);
        if let Some(&value) = gradient.iter().find(|g| !g.is_finite()) {
            return Err(FitError::ModelNotFinite { point, value });
        }
    }
    Ok(all)
}

fn difference(model: &dyn Model, x: &[f64], p: &[f64], j: usize) -> f64 {
    let size = if p[j] == 0.0 { 1.0 } else { p[j].abs() };
    let h = RELATIVE_STEP * size;
    let at = |shift: f64| {
        let mut moved = p.to_vec();
        moved[j] += shift;
        model.value(x, &moved)
    };
    (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h)
}

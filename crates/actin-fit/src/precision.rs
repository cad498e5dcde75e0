use crate::error::{FitError, not_lost};
use crate::factor::Factor;
use crate::observations::{Noise, Observations};
use faer::Mat;

/// Goodness of fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Goodness {
    /// Observation minus model at each point, in units of the observations.
    pub residuals: Vec<f64>,
    /// Unweighted root mean square of the residuals.
    pub rms: f64,
    /// Sum of squares of the residuals over deviations. Deviations are 1 if the noise is unknown.
    pub chi_squared: f64,
    /// Number of points minus rank.
    pub degrees_of_freedom: usize,
}

impl Goodness {
    pub(crate) fn new(residuals: Vec<f64>, observations: &Observations, rank: usize) -> Self {
        let points = residuals.len();
        // Scaled by the largest residual to avoid overflow.
        let largest = residuals
            .iter()
            .fold(f64::MIN_POSITIVE, |most, r| r.abs().max(most));
        let sum: f64 = residuals.iter().map(|r| (r / largest).powi(2)).sum();
        let chi_squared = residuals
            .iter()
            .zip(observations.deviations())
            .map(|(r, deviation)| (r / deviation).powi(2))
            .sum();
        Self {
            rms: largest * (sum / points.max(1) as f64).sqrt(),
            chi_squared,
            degrees_of_freedom: points - rank,
            residuals,
        }
    }

    /// Chi squared per degree of freedom, near 1 for a correct model with known deviations. `None`
    /// without degrees of freedom.
    pub fn reduced_chi_squared(&self) -> Option<f64> {
        let freedom = self.degrees_of_freedom;
        (freedom > 0).then(|| self.chi_squared / freedom as f64)
    }
}

/// Covariance of parameters.
///
/// ```text
/// C = s (J^T W J)^-1
/// ```
///
/// `J` is the Jacobian of the model at the solution, and `W` contains the inverse squared
/// deviations. The factor `s` is 1 if deviations are known, and chi squared per degree of freedom
/// otherwise. Exact for linear models with Gaussian noise, an approximation for others.
#[derive(Clone, Debug, PartialEq)]
pub struct Precision {
    /// Covariance matrix, square. Rows and columns of parameters without a standard error are zero.
    pub covariance: Mat<f64>,
    /// Rank of the scaled Jacobian.
    pub rank: usize,
    /// Condition number of the scaled Jacobian, possibly infinite. It bounds the amplification of
    /// relative errors of the data.
    pub condition: f64,
    known: Vec<bool>,
}

impl Precision {
    /// Covariance of `n` parameters. `columns` are the indices of the columns of the factor among
    /// them.
    ///
    /// # Errors
    /// If a variance overflows or underflows.
    pub(crate) fn new(
        n: usize,
        columns: &[usize],
        factor: &Factor,
        goodness: &Goodness,
        noise: Noise,
    ) -> Result<Self, FitError> {
        let scale = match noise {
            Noise::Known => 1.0,
            Noise::Unknown | Noise::Relative => goodness.reduced_chi_squared().unwrap_or(0.0),
        };
        let inverse = factor.inverse_normal();
        let mut covariance = Mat::zeros(n, n);
        let mut known = vec![false; n];
        for (a, (&i, determined)) in columns.iter().zip(factor.determined()).enumerate() {
            known[i] = determined;
            for (b, &j) in columns.iter().enumerate() {
                covariance[(i, j)] = scale * inverse[(a, b)];
            }
            if determined {
                not_lost("variance", i, scale, covariance[(i, i)])?;
            }
        }
        Ok(Self {
            covariance,
            rank: factor.rank(),
            condition: factor.condition(),
            known,
        })
    }

    /// Standard error of a parameter, or `None` if it is undetermined, fixed or at a bound.
    ///
    /// # Panics
    /// If the index is out of range.
    pub fn standard_error(&self, parameter: usize) -> Option<f64> {
        self.known[parameter].then(|| self.covariance[(parameter, parameter)].sqrt())
    }

    /// Correlation matrix with unit diagonal. Rows and columns of parameters without a standard
    /// error are zero off the diagonal.
    pub fn correlation(&self) -> Mat<f64> {
        let deviation = |j: usize| self.covariance[(j, j)].sqrt();
        Mat::from_fn(self.known.len(), self.known.len(), |i, j| {
            let product = deviation(i) * deviation(j);
            match (i == j, product > 0.0) {
                (true, _) => 1.0,
                (false, true) => self.covariance[(i, j)] / product,
                (false, false) => 0.0,
            }
        })
    }

    /// Standard error of a quantity with gradient `g` with respect to the parameters:
    /// `sqrt(g . C g)`.
    ///
    /// The gradient of the model at a point gives the uncertainty of the fitted curve. Parameters
    /// without a standard error count as exact.
    ///
    /// # Panics
    /// If the gradient is shorter than the number of parameters.
    pub fn propagated(&self, gradient: &[f64]) -> f64 {
        let n = self.known.len();
        let variance: f64 = (0..n)
            .flat_map(|i| (0..n).map(move |j| (i, j)))
            .map(|(i, j)| gradient[i] * self.covariance[(i, j)] * gradient[j])
            .sum();
        variance.max(0.0).sqrt()
    }
}

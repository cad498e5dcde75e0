//! How well parameters are known, and how well data are met.

use crate::error::{FitError, not_lost};
use crate::factor::Factor;
use crate::observations::{Noise, Observations};
use faer::Mat;

/// How well data are met.
#[derive(Clone, Debug, PartialEq)]
pub struct Goodness {
    /// Observation minus model at each point, in units of the observations.
    pub residuals: Vec<f64>,
    /// Root of the mean square of the residuals, without weights.
    pub rms: f64,
    /// Sum of squares of residuals over deviations. Deviations are 1 where the noise is unknown.
    pub chi_squared: f64,
    /// Points less parameters that the data determine.
    pub degrees_of_freedom: usize,
}

impl Goodness {
    pub(crate) fn new(residuals: Vec<f64>, observations: &Observations, rank: usize) -> Self {
        let points = residuals.len();
        // Over the largest: with weights residuals may be longer than what was observed.
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

    /// Chi squared per degree of freedom; `None` where no degree of freedom is left. Near 1 if the
    /// model is right and the deviations are known.
    pub fn reduced_chi_squared(&self) -> Option<f64> {
        let freedom = self.degrees_of_freedom;
        (freedom > 0).then(|| self.chi_squared / freedom as f64)
    }
}

/// How well parameters are known.
///
/// `C = s (J^T W J)^-1`, with the derivatives `J` of the model at the solution, the weights `W`,
/// one over squared deviations, and `s` = 1 where deviations are known, else chi squared per degree
/// of freedom. Exact for linear models with Gaussian noise; for others as good as the model is
/// linear over the range of the errors.
#[derive(Clone, Debug, PartialEq)]
pub struct Precision {
    /// Covariance of the parameters, square. Rows and columns of parameters without a standard
    /// error are zero.
    pub covariance: Mat<f64>,
    /// Rank of the scaled derivatives.
    pub rank: usize,
    /// Condition number of the scaled derivatives: the factor by which relative errors of data can
    /// grow. Infinite if the rank is deficient to the last digit.
    pub condition: f64,
    known: Vec<bool>,
}

impl Precision {
    /// The precision of `n` parameters, of which `columns` are those of the factor and the others
    /// were held.
    ///
    /// # Errors
    /// If a variance is outside of what a number can hold.
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

    /// Standard error of a parameter; `None` if the data do not determine it or a bound holds it.
    ///
    /// # Panics
    /// If there is no such parameter.
    pub fn standard_error(&self, parameter: usize) -> Option<f64> {
        self.known[parameter].then(|| self.covariance[(parameter, parameter)].sqrt())
    }

    /// Correlations of the parameters, square, with ones on the diagonal; zero in rows and columns
    /// of parameters without a standard error.
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

    /// Standard error of a quantity with this gradient by the parameters: `sqrt(g . C g)`.
    ///
    /// With the gradient of the model at a place, the uncertainty of the fitted curve there.
    /// Parameters without a standard error count as exact.
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

use crate::data::Data;
use crate::error::{FitError, not_lost, same_length};
use crate::linear::{LinearFit, fit_linear};
use faer::Mat;

/// A polynomial of one variable, with or without a constant term.
///
/// ```
/// use actin_fit::{Data, Observations, Polynomial};
///
/// // 2 x + x^2 at 1, 2, 3, 4.
/// let data = Data::new(&[1.0, 2.0, 3.0, 4.0], Observations::new(&[3.0, 8.0, 15.0, 24.0])?)?;
/// let polynomial = Polynomial::without_constant(2);
/// let fit = polynomial.fit(&data)?;
/// assert!((fit.parameters[0] - 2.0).abs() < 1e-12);
/// assert!((polynomial.value(&fit.parameters, 5.0) - 35.0).abs() < 1e-12);
/// # Ok::<(), actin_fit::FitError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Polynomial {
    lowest: i32,
    degree: i32,
}

impl Polynomial {
    /// `p_0 + p_1 x + ... + p_degree x^degree`.
    pub fn new(degree: u8) -> Self {
        Self {
            lowest: 0,
            degree: i32::from(degree),
        }
    }

    /// `p_1 x + ... + p_degree x^degree`, which vanishes at zero.
    pub fn without_constant(degree: u8) -> Self {
        Self {
            lowest: 1,
            degree: i32::from(degree),
        }
    }

    /// Exponents of the terms, one per coefficient.
    pub fn powers(&self) -> impl Iterator<Item = i32> + use<> {
        self.lowest..=self.degree
    }

    /// Number of coefficients.
    pub(crate) fn coefficients(self) -> usize {
        self.powers().count()
    }

    /// Fits the coefficients, in ascending order of powers.
    ///
    /// The variable is scaled by a power of two, which avoids overflow without rounding. For high
    /// degrees and values far from zero the scaled columns are nearly dependent; see the condition
    /// number.
    ///
    /// # Errors
    /// See [`fit_linear`]. Also if the data have more than one independent variable, or a
    /// coefficient or its variance overflows or underflows.
    pub fn fit(&self, data: &Data) -> Result<LinearFit, FitError> {
        same_length("a row of x", 1, data.width())?;
        let scale = power_of_two(data.rows());
        let powers: Vec<i32> = self.powers().collect();
        let design = Mat::from_fn(data.len(), powers.len(), |i, j| {
            (data.row(i)[0] / scale).powi(powers[j])
        });
        let mut fit = fit_linear(design.as_ref(), data.observations())?;
        let factors: Vec<f64> = powers.iter().map(|&k| scale.powi(-k)).collect();
        for (j, (p, factor)) in fit.parameters.iter_mut().zip(&factors).enumerate() {
            not_lost("value", j, *p, *p * factor)?;
            *p *= factor;
        }
        let covariance = &fit.precision.covariance;
        let scaled = Mat::from_fn(powers.len(), powers.len(), |i, j| {
            covariance[(i, j)] * factors[i] * factors[j]
        });
        for j in 0..powers.len() {
            not_lost("variance", j, covariance[(j, j)], scaled[(j, j)])?;
        }
        fit.precision.covariance = scaled;
        Ok(fit)
    }

    /// Value of the polynomial at `x`, by Horner's rule.
    ///
    /// # Panics
    /// If the number of coefficients is wrong.
    pub fn value(&self, coefficients: &[f64], x: f64) -> f64 {
        assert_eq!(coefficients.len(), self.coefficients(), "coefficients");
        let sum = coefficients.iter().rev().fold(0.0, |sum, p| sum * x + p);
        sum * x.powi(self.lowest)
    }

    /// Derivatives of the value at `x` with respect to the coefficients.
    pub fn gradient(&self, x: f64) -> Vec<f64> {
        self.powers().map(|k| x.powi(k)).collect()
    }
}

/// Smallest power of two above the largest magnitude, or 1 if all values are zero.
fn power_of_two(x: &[f64]) -> f64 {
    let largest = x.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let mut scale = 1.0;
    while scale < largest && scale < 0.5 * f64::MAX {
        scale *= 2.0;
    }
    while largest > 0.0 && 0.5 * scale >= largest {
        scale *= 0.5;
    }
    scale
}

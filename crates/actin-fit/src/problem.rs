use crate::bounds::Bounds;
use crate::data::Data;
use crate::model::Model;
use faer::linalg::solvers::Qr;
use faer::{Mat, MatRef};

pub(crate) struct Problem<'a> {
    pub(crate) model: &'a dyn Model,
    pub(crate) data: &'a Data,
    pub(crate) bounds: &'a Bounds,
}

impl Problem<'_> {
    /// Writes `(y_i - f(x_i)) / sigma_i` and returns the sum of squares.
    pub(crate) fn residuals(&self, p: &[f64], residuals: &mut [f64]) -> f64 {
        let observations = self.data.observations();
        let measured = observations.values().iter().zip(observations.deviations());
        let mut sum = 0.0;
        for (i, (residual, (y, deviation))) in residuals.iter_mut().zip(measured).enumerate() {
            *residual = (y - self.model.value(self.data.row(i), p)) / deviation;
            sum += *residual * *residual;
        }
        sum
    }

    pub(crate) fn derivatives(&self, p: &[f64]) -> Mat<f64> {
        let deviations = self.data.observations().deviations();
        let mut matrix = Mat::zeros(self.data.len(), p.len());
        let mut gradient = vec![0.0; p.len()];
        for (i, deviation) in deviations.iter().enumerate() {
            self.model.gradient(self.data.row(i), p, &mut gradient);
            for (j, g) in gradient.iter().enumerate() {
                matrix[(i, j)] = g / deviation;
            }
        }
        matrix
    }

    pub(crate) fn rounding(&self, chi_squared: f64) -> f64 {
        2.0 * ROUNDINGS * f64::EPSILON * self.size() * chi_squared.sqrt() + self.least()
    }

    pub(crate) fn least(&self) -> f64 {
        (ROUNDINGS * f64::EPSILON * self.size()).powi(2)
    }

    fn size(&self) -> f64 {
        let observations = self.data.observations();
        let measured = observations.values().iter().zip(observations.deviations());
        let sum: f64 = measured.map(|(y, s)| (y / s).powi(2)).sum();
        sum.sqrt()
    }

    /// Typical size of each parameter: the distance of its bounds, or its value if the bounds are
    /// infinite.
    pub(crate) fn units(&self, p: &[f64]) -> Vec<f64> {
        let unit = |(j, v): (usize, &f64)| match self.bounds.width(j) {
            width if width.is_finite() && width > 0.0 => width,
            _ if *v != 0.0 => v.abs(),
            _ => 1.0,
        };
        p.iter().enumerate().map(unit).collect()
    }
}

/// Estimated number of rounding errors in a value of the model.
const ROUNDINGS: f64 = 4.0;

/// Linearised residuals at a point:
///
/// ```text
/// |r - A s|^2 = |c - T L s|^2 + constant
/// ```
///
/// `L` holds the column norms of the weighted Jacobian `A`, and `T` is the triangle of its
/// normalised columns with `min(parameters, points)` rows. Columns of any norm are factored without
/// overflow.
#[derive(Debug)]
pub(crate) struct Linearisation {
    pub(crate) triangle: Mat<f64>,
    pub(crate) rotated: Vec<f64>,
    /// Column norms of `A`.
    pub(crate) lengths: Vec<f64>,
    /// `A^T r` over the column norms: minus half the scaled gradient of chi squared.
    pub(crate) descent: Vec<f64>,
}

impl Linearisation {
    pub(crate) fn new(matrix: MatRef<'_, f64>, residuals: &[f64]) -> Option<Self> {
        let (points, n) = matrix.shape();
        let lengths: Vec<f64> = (0..n).map(|j| matrix.col(j).norm_l2()).collect();
        let is_finite = |v: &f64| v.is_finite();
        if !(lengths.iter().all(is_finite) && residuals.iter().all(is_finite)) {
            return None;
        }
        let unit = |i: usize, j: usize| {
            if lengths[j] > 0.0 {
                matrix[(i, j)] / lengths[j]
            } else {
                0.0
            }
        };
        let along = |j: usize| (0..points).map(|i| unit(i, j) * residuals[i]).sum();
        let descent = (0..n).map(along).collect();
        let joined = Mat::from_fn(
            points,
            n + 1,
            |i, j| {
                if j < n { unit(i, j) } else { residuals[i] }
            },
        );
        let qr = Qr::new(joined.as_ref());
        let rows = n.min(points);
        Some(Self {
            triangle: qr.thin_R().get(..rows, ..n).to_owned(),
            rotated: (0..rows).map(|i| qr.thin_R()[(i, n)]).collect(),
            lengths,
            descent,
        })
    }

    /// `c - T L s`.
    pub(crate) fn remainder(&self, step: &[f64]) -> Vec<f64> {
        let row = |i: usize| {
            let terms = step.iter().zip(&self.lengths).enumerate();
            let moved = terms.map(|(j, (s, length))| self.triangle[(i, j)] * (length * s));
            self.rotated[i] - moved.sum::<f64>()
        };
        (0..self.rotated.len()).map(row).collect()
    }

    pub(crate) fn promised(&self, step: &[f64]) -> f64 {
        let square = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>();
        square(&self.rotated) - square(&self.remainder(step))
    }

    pub(crate) fn cosine(&self, parameter: usize, chi_squared: f64) -> f64 {
        if chi_squared > 0.0 {
            self.descent[parameter] / chi_squared.sqrt()
        } else {
            0.0
        }
    }
}

//! Nonlinear least squares: several searches, the best of them, and its report.

use crate::bounds::Bounds;
use crate::data::Data;
use crate::descent::{descend, free, not_finite};
use crate::error::{FitError, enough_points, same_length};
use crate::factor::Factor;
use crate::model::Model;
use crate::options::Options;
use crate::precision::{Goodness, Precision};
use crate::problem::{Linearisation, Problem};
use crate::report::{Fit, Status};
use crate::search_report::StartReport;
use crate::starts::Starts;
use faer::Mat;

/// Chi squared within this part of the least counts as the same: the first such start is the best,
/// so that rounding does not choose.
const SAME_CHI_SQUARED: f64 = 1e-9;

/// Levenberg and Marquardt's method within bounds, from several starts.
///
/// Steps are measured by the largest lengths of the columns of derivatives so far, so that units of
/// parameters do not matter: the same search results in nm and in m. A step that would cross a bound
/// ends on it. Where a model curves so much that straight steps must be short, their acceleration is
/// added, for one more evaluation each.
///
/// The results are the same in each run on one machine; on another one the last digits differ, as
/// those of exponential functions and of the kernels for matrices do.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LevenbergMarquardt {
    options: Options,
}

impl LevenbergMarquardt {
    /// The method with these settings.
    ///
    /// # Errors
    /// If one of them is not positive.
    pub fn new(options: Options) -> Result<Self, FitError> {
        options.check()?;
        Ok(Self { options })
    }

    /// The parameters that make `sum_i ((y_i - f(x_i; p)) / sigma_i)^2` least within bounds.
    ///
    /// The fit is the lowest of the minima that the searches reached; nothing says that there is no
    /// lower one.
    ///
    /// # Errors
    /// If bounds or starts do not match the model, there are too few points, no start converged, or
    /// a variance is outside of what a number can hold.
    pub fn fit(
        &self,
        model: &dyn Model,
        data: &Data,
        bounds: &Bounds,
        starts: &Starts,
    ) -> Result<Fit, FitError> {
        same_length("bounds", model.parameters(), bounds.len())?;
        enough_points(data.len(), data.observations().needed(bounds.varying()))?;
        let points = starts.points(bounds)?;
        let problem = Problem {
            model,
            data,
            bounds,
        };
        let ended: Vec<StartReport> = points
            .iter()
            .map(|start| descend(&problem, &self.options, start))
            .collect();
        match best(&ended, problem.least()) {
            Some(best) => self.report(&problem, ended, best),
            None => Err(FitError::NoConvergence {
                starts: ended,
                cosine: self.options.cosine,
            }),
        }
    }

    fn report(
        &self,
        problem: &Problem<'_>,
        starts: Vec<StartReport>,
        best: usize,
    ) -> Result<Fit, FitError> {
        let parameters = starts[best].parameters.clone();
        let observations = problem.data.observations();
        let mut weighted = vec![0.0; observations.len()];
        problem.residuals(&parameters, &mut weighted);
        let derivatives = problem.derivatives(&parameters);
        let Some(linear) = Linearisation::new(derivatives.as_ref(), &weighted) else {
            // Exact fits end before derivatives are asked for.
            return Err(model_not_finite(&derivatives));
        };
        let free = free(problem, &parameters, &linear);
        let columns: Vec<usize> = (0..parameters.len()).filter(|&j| free[j]).collect();
        let factor = self.factor(problem, &parameters, &derivatives, &columns)?;

        let deviations = observations.deviations();
        let residuals = weighted.iter().zip(deviations).map(|(r, s)| r * s);
        let goodness = Goodness::new(residuals.collect(), observations, factor.rank());
        let noise = observations.noise();
        let precision = Precision::new(parameters.len(), &columns, &factor, &goodness, noise)?;
        Ok(Fit {
            statuses: statuses(problem.bounds, &linear, &free, &precision),
            parameters,
            precision,
            goodness,
            starts,
            best,
        })
    }

    /// The derivatives by the free parameters, factored.
    fn factor(
        &self,
        problem: &Problem<'_>,
        p: &[f64],
        derivatives: &Mat<f64>,
        columns: &[usize],
    ) -> Result<Factor, FitError> {
        let units = problem.units(p);
        let units: Vec<f64> = columns.iter().map(|&j| units[j]).collect();
        let matrix = Mat::from_fn(derivatives.nrows(), columns.len(), |i, k| {
            derivatives[(i, columns[k])]
        });
        Factor::new(matrix.as_ref(), &units, self.options.rank_tolerance)
    }
}

/// The first of the lowest searches that converged; `rounding` is what an exact one may be above
/// zero.
fn best(starts: &[StartReport], rounding: f64) -> Option<usize> {
    let converged = || starts.iter().filter(|s| s.ending.is_converged());
    let least = converged().map(|s| s.chi_squared).min_by(f64::total_cmp)?;
    let same = least * (1.0 + SAME_CHI_SQUARED) + rounding;
    starts
        .iter()
        .position(|s| s.ending.is_converged() && s.chi_squared <= same)
}

fn model_not_finite(derivatives: &Mat<f64>) -> FitError {
    let point = not_finite(derivatives);
    let row = (0..derivatives.ncols()).map(|j| derivatives[(point, j)]);
    FitError::ModelNotFinite {
        point,
        value: row.fold(
            0.0,
            |bad, value| if value.is_finite() { bad } else { value },
        ),
    }
}

fn statuses(
    bounds: &Bounds,
    linear: &Linearisation,
    free: &[bool],
    precision: &Precision,
) -> Vec<Status> {
    (0..free.len())
        .map(|j| match precision.standard_error(j) {
            _ if bounds.holds(j) => Status::Held,
            _ if !free[j] && linear.descent[j] < 0.0 => Status::AtLowerBound,
            _ if !free[j] => Status::AtUpperBound,
            None => Status::Undetermined,
            Some(error) if error > bounds.width(j) => Status::Weak,
            Some(_) => Status::Determined,
        })
        .collect()
}

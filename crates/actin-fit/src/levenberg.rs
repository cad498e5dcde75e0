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

/// Relative tolerance for equal chi squared. Rounding thus does not select among equal minima.
const SAME_CHI_SQUARED: f64 = 1e-9;

/// Levenberg-Marquardt method with bounds and several starts.
///
/// Steps are scaled by the largest column norms of the Jacobian so far, so that a search does not
/// depend on the units of the parameters. Steps are truncated at bounds. Strongly curved models use
/// geodesic acceleration, at one more evaluation per step.
///
/// Results are reproducible on one machine. On other machines the last digits can differ.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LevenbergMarquardt {
    options: Options,
}

impl LevenbergMarquardt {
    /// Creates the method with the given options.
    ///
    /// # Errors
    /// If an option is not positive.
    pub fn new(options: Options) -> Result<Self, FitError> {
        options.check()?;
        Ok(Self { options })
    }

    /// Minimises `sum_i ((y_i - f(x_i; p)) / sigma_i)^2` over `p` within the bounds.
    ///
    /// The result is the lowest minimum that a search reached, which may be a local one.
    ///
    /// # Errors
    /// If bounds or starts do not match the model, there are too few points, no search converged,
    /// or a variance overflows or underflows.
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
            // `descend` evaluates no derivatives for exact fits.
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

use crate::error::{FitError, RANGE, all_finite, all_within, enough_points, same_length};
use crate::factor::Factor;
use crate::observations::Observations;
use crate::precision::{Goodness, Precision};
use faer::{Mat, MatRef};

/// Result of a linear fit.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearFit {
    /// Parameters, one per column of the design.
    pub parameters: Vec<f64>,
    /// Covariance, rank and condition number.
    pub precision: Precision,
    /// Residuals and chi squared.
    pub goodness: Goodness,
}

/// Minimises `sum_i ((y_i - sum_j A_ij p_j) / sigma_i)^2` over `p`.
///
/// Shapes: `m` observations and `n` columns -> `n` parameters. The method is QR of the weighted
/// design with columns of unit length. Errors grow with the reported condition number, not with its
/// square. Singular values below `m` units of rounding count as zero.
///
/// ```
/// use actin_fit::{Mat, Observations, fit_linear};
///
/// // Mean of 1, 2 and 6 with the standard error sqrt(7) / sqrt(3).
/// let ones = Mat::full(3, 1, 1.0);
/// let fit = fit_linear(ones.as_ref(), &Observations::new(&[1.0, 2.0, 6.0])?)?;
/// assert!((fit.parameters[0] - 3.0).abs() < 1e-14);
/// let error = fit.precision.standard_error(0).unwrap();
/// assert!((error * error - 7.0 / 3.0).abs() < 1e-14);
/// # Ok::<(), actin_fit::FitError>(())
/// ```
///
/// # Errors
/// If the design does not match the observations or is not finite, there are too few points, or the
/// design is rank deficient. Also if the norm of a weighted column is outside 1e-100 to 1e100 and
/// not zero, or if a variance overflows or underflows.
///
/// # Source
/// Golub and Van Loan, Matrix Computations (2013), 5.3; Bjorck, Numerical Methods for Least Squares
/// Problems (1996), 2.8.
pub fn fit_linear(
    design: MatRef<'_, f64>,
    observations: &Observations,
) -> Result<LinearFit, FitError> {
    let (points, parameters) = design.shape();
    same_length("rows of the design", observations.len(), points)?;
    for j in 0..parameters {
        let column: Vec<f64> = design.col(j).iter().copied().collect();
        all_finite("design row", &column)?;
    }
    enough_points(points, observations.needed(parameters))?;

    let deviations = observations.deviations();
    let weighted = Mat::from_fn(points, parameters, |i, j| design[(i, j)] / deviations[i]);
    let tolerance = points as f64 * f64::EPSILON;
    let columns = (0..parameters).map(|j| weighted.col(j).norm_l2());
    let columns: Vec<f64> = columns.collect();
    let lengths = columns.iter().map(|&l| if l == 0.0 { 1.0 } else { l });
    all_within("length of column", lengths, RANGE)?;
    // Units of the parameters are unknown, so only exactly zero columns count as zero.
    let units: Vec<f64> = columns
        .iter()
        .map(|l| 1.0 / l.max(f64::MIN_POSITIVE))
        .collect();
    let factor = Factor::new(weighted.as_ref(), &units, tolerance)?;
    full_rank(&factor, parameters)?;

    let right: Vec<f64> = observations
        .values()
        .iter()
        .zip(deviations)
        .map(|(y, deviation)| y / deviation)
        .collect();
    let solution = factor.solve(&right);
    report(design, observations, &factor, solution)
}

fn full_rank(factor: &Factor, parameters: usize) -> Result<(), FitError> {
    if factor.rank() == parameters {
        return Ok(());
    }
    let determined = factor.determined();
    Err(FitError::RankDeficient {
        rank: factor.rank(),
        parameters,
        undetermined: (0..parameters).filter(|&j| !determined[j]).collect(),
    })
}

fn report(
    design: MatRef<'_, f64>,
    observations: &Observations,
    factor: &Factor,
    parameters: Vec<f64>,
) -> Result<LinearFit, FitError> {
    let residuals = observations
        .values()
        .iter()
        .enumerate()
        .map(|(i, y)| {
            let terms = parameters.iter().enumerate();
            y - terms.map(|(j, p)| design[(i, j)] * p).sum::<f64>()
        })
        .collect();
    let goodness = Goodness::new(residuals, observations, factor.rank());
    let columns: Vec<usize> = (0..parameters.len()).collect();
    let noise = observations.noise();
    Ok(LinearFit {
        precision: Precision::new(columns.len(), &columns, factor, &goodness, noise)?,
        parameters,
        goodness,
    })
}

//! Fits of B3(kappa) and xi(kappa).

use super::data::{Column, TwistData};
use super::forms::{Rooted, Sided, Tanh};
use actin_cosserat::{PolynomialStretch, RootedStretch, SidedTwist, TanhTwist};
use actin_fit::{
    Bounds, Data, Fit, LevenbergMarquardt, LinearFit, Model, Observations, Polynomial, Starts,
};

/// Degree of the published polynomial.
const DEGREE: u8 = 6;
/// Starts that are drawn for each nonlinear fit, and the seed of the draws.
const STARTS: (usize, u64) = (200, 20_220_304);
/// Standard deviation of a number that is rounded to four decimals.
const ROUNDING_DEVIATION: f64 = 2.887e-5;
/// Bounds of the published form's parameters: steps lie within the data and are no narrower than
/// half the distance of two rows, below which every width fits as well.
const LAMBDA_BOUNDS: [(f64, f64); 7] = [
    (-0.05, 0.05),
    (1e-3, 0.06),
    (0.0, 40.0),
    (-0.02, 0.05),
    (2e-3, 0.06),
    (-0.02, 0.05),
    (2e-3, 0.06),
];

/// All fits to one table.
#[derive(Debug)]
pub(crate) struct TwistFits {
    /// `p_0` to `p_6`.
    pub polynomial: LinearFit,
    /// `p_1` to `p_6`, with nothing at rest.
    pub without_offset: LinearFit,
    /// `xi - 1` with two slopes.
    pub rooted: Fit,
    /// Published form of B3, every row with the same weight.
    pub tanh: Fit,
    /// The same with relative weights: the small rigidities of small twists count as much.
    pub tanh_relative: Fit,
    /// Saturation to either side, with relative weights.
    pub sided: Fit,
    /// Root mean square of the published `xi`, and of it without its offset.
    pub published_xi_rms: [f64; 2],
    /// Root mean square of the published B3 (pN nm^2), and relative.
    pub published_b3_rms: [f64; 2],
    pub ranges: [f64; 2],
}

impl TwistFits {
    /// Fits every form to `data`.
    ///
    /// # Errors
    /// What the least squares refuse: too few rows, and searches of which none converged.
    pub(crate) fn new(data: &TwistData) -> Result<Self, String> {
        let (rigidity, length) = (&data.rigidity, &data.length);
        let of_xi = |e| format!("xi against twist: {e}");
        let of_b3 = |e| format!("B3 against twist: {e}");
        let plain = observed(length, false).map_err(of_xi)?;
        let equal = observed(rigidity, false).map_err(of_b3)?;
        let relative = observed(rigidity, true).map_err(of_b3)?;
        let published = TanhTwist::published();
        let tanh = |data: &Data, extra: &[f64]| {
            let starts = Starts::at(extra).and_drawn(STARTS.0, STARTS.1);
            search(
                &Tanh {
                    limits: wide(published),
                },
                data,
                &LAMBDA_BOUNDS,
                &starts,
            )
            .map_err(of_b3)
        };
        let tanh_fit = tanh(&equal, &published.lambda)?;
        let ranges = [rigidity.range(), length.range()];
        Ok(Self {
            polynomial: Polynomial::new(DEGREE).fit(&plain).map_err(of_xi)?,
            without_offset: Polynomial::without_constant(DEGREE)
                .fit(&plain)
                .map_err(of_xi)?,
            rooted: fit_rooted(&plain, ranges[1]).map_err(of_xi)?,
            tanh_relative: tanh(&relative, &tanh_fit.parameters)?,
            tanh: tanh_fit,
            sided: fit_sided(&relative, ranges[0]).map_err(of_b3)?,
            published_xi_rms: [
                PolynomialStretch::published(),
                PolynomialStretch::published_without_offset(),
            ]
            .map(|law| rms(length, |k| law.jet(k)[0], false)),
            published_b3_rms: [false, true]
                .map(|relative| rms(rigidity, |k| wide(published).secant(k), relative)),
            ranges,
        })
    }

    /// What the rounding of the paper's rows does to coefficient `j` of the polynomial: its
    /// standard error if half a unit in the last decimal were all the noise.
    pub(crate) fn rounding_error(&self, j: usize) -> f64 {
        let fit = &self.polynomial;
        let noise = fit
            .goodness
            .reduced_chi_squared()
            .map_or(f64::NAN, f64::sqrt);
        let error = fit.precision.standard_error(j).unwrap_or(f64::NAN);
        error / noise * ROUNDING_DEVIATION
    }

    /// The published form with the parameters of a fit.
    pub(crate) fn tanh_law(&self, fit: &Fit) -> TanhTwist {
        let law = Tanh {
            limits: TanhTwist::published(),
        }
        .law(&fit.parameters);
        TanhTwist {
            range: self.ranges[0],
            ..law
        }
    }

    /// The saturating form as fitted.
    pub(crate) fn sided_law(&self) -> SidedTwist {
        Sided {
            range: self.ranges[0],
        }
        .law(&self.sided.parameters)
    }

    /// The form with two slopes as fitted.
    pub(crate) fn rooted_law(&self) -> RootedStretch {
        Rooted {
            range: self.ranges[1],
        }
        .law(&self.rooted.parameters)
    }

    /// A polynomial as fitted; one without offset has `p_0 = 0`.
    pub(crate) fn polynomial_law(&self, fit: &LinearFit) -> PolynomialStretch {
        let mut coefficients = [0.0; 7];
        let first = 7 - fit.parameters.len();
        coefficients[first..].copy_from_slice(&fit.parameters);
        PolynomialStretch {
            coefficients,
            range: self.ranges[1],
        }
    }
}

/// The law without the end of its range, since fits read the formula.
fn wide(law: TanhTwist) -> TanhTwist {
    TanhTwist {
        range: f64::MAX,
        ..law
    }
}

/// A column with equal or with relative weights. The scatter over samplings is no weight: a form
/// of few parameters misses the means by more than that, and is to miss them evenly.
fn observed(column: &Column, relative: bool) -> Result<Data, actin_fit::FitError> {
    let mut observations = Observations::new(&column.value)?;
    if relative {
        let weights: Vec<f64> = column.value.iter().map(|v| v.powi(-2)).collect();
        observations = observations.with_weights(&weights)?;
    }
    Data::new(&column.twist, observations)
}

fn search(
    model: &dyn Model,
    data: &Data,
    bounds: &[(f64, f64)],
    starts: &Starts,
) -> Result<Fit, actin_fit::FitError> {
    LevenbergMarquardt::default().fit(model, data, &Bounds::new(bounds)?, starts)
}

fn fit_sided(data: &Data, range: f64) -> Result<Fit, actin_fit::FitError> {
    let side = [(1e2, 2e5), (1e-4, 0.2), (0.0, 0.2)];
    let bounds: Vec<(f64, f64)> = std::iter::once((0.0, 5e3))
        .chain(side)
        .chain(side)
        .collect();
    let starts = Starts::at(&[300.0, 1.3e4, 0.01, 0.02, 2e4, 0.01, 0.02]);
    let starts = starts.and_drawn(STARTS.0, STARTS.1);
    search(&Sided { range }, data, &bounds, &starts)
}

fn fit_rooted(data: &Data, range: f64) -> Result<Fit, actin_fit::FitError> {
    let bounds = [(-1.0, 1.0), (0.0, 2.0), (1e-4, 0.1), (-1e3, 1e3)];
    let starts = Starts::at(&[-0.29, 0.46, 0.0067, 28.0]).and_drawn(STARTS.0, STARTS.1);
    search(&Rooted { range }, data, &bounds, &starts)
}

/// Root mean square of `law` against a column, of differences or of relative ones.
pub(crate) fn rms(column: &Column, law: impl Fn(f64) -> f64, relative: bool) -> f64 {
    let squares = column.twist.iter().zip(&column.value).map(|(&k, value)| {
        let scale = if relative { *value } else { 1.0 };
        ((law(k) - value) / scale).powi(2)
    });
    (squares.sum::<f64>() / column.value.len() as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use actin_fit::check_gradient;

    /// The published polynomial is the least-squares one, and
    /// the published lambda are not.
    #[test]
    fn paper_rows_give_the_published_polynomial_and_a_better_tanh() {
        let data = TwistData::from_paper(false).unwrap();
        let fits = TwistFits::new(&data).unwrap();
        assert!(
            fits.polynomial.goodness.rms <= 2.81e-4,
            "{}",
            fits.polynomial.goodness.rms
        );
        let published = PolynomialStretch::published().coefficients;
        for (j, (ours, theirs)) in fits.polynomial.parameters.iter().zip(published).enumerate() {
            let rounding = fits.rounding_error(j);
            assert!(
                (ours - theirs).abs() < rounding,
                "{ours} {theirs} {rounding}"
            );
            assert!(
                rounding < 0.1 * theirs.abs(),
                "a bound that says nothing: {rounding}"
            );
        }
        assert!((fits.published_b3_rms[0] - 349.0).abs() < 1.0);
        assert!(
            fits.tanh.goodness.rms <= 265.0,
            "{}",
            fits.tanh.goodness.rms
        );
    }

    #[test]
    fn derivatives_of_the_forms() {
        let data = TwistData::from_paper(false).unwrap();
        let data = observed(&data.rigidity, false).unwrap();
        let range = 1.0;
        let checks: [(&dyn Model, &[f64]); 3] = [
            (
                &Tanh {
                    limits: TanhTwist::published(),
                },
                &TanhTwist::published().lambda,
            ),
            (
                &Sided { range },
                &[300.0, 1.3e4, 0.009, 0.02, 2e4, 0.012, 0.016],
            ),
            (&Rooted { range }, &[-0.29, 0.46, 0.0067, 28.0]),
        ];
        for (model, parameters) in checks {
            let check = check_gradient(model, &data, parameters).unwrap();
            // Differences of 7e-4 of each parameter.
            assert!(check.error < 1e-5, "{check:?}");
        }
    }
}

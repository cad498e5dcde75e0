//! Fits of B3(kappa) and xi(kappa).

use super::catalogue::Form;
use super::column::Weight;
use super::forms::LawForm;
use super::groups::GroupFits;
use super::parameter_fit::{Fault, ParameterFit};
use super::search::STARTS;
use super::table::FitData;
use actin_cosserat::{PolynomialStretch, TanhTwist};
use actin_fit::{Data, Fit, LinearFit, Polynomial, Starts};

const DEGREE: u8 = 6;
/// Standard deviation of a number rounded to four decimals.
const ROUNDING_DEVIATION: f64 = 2.887e-5;

/// Bounds of the parameters of the published form. Steps lie within the data and are at least half
/// a row distance wide, since narrower steps all fit equally.
const LAMBDA_BOUNDS: [(f64, f64); 7] = [
    (-0.05, 0.05),
    (1e-3, 0.06),
    (0.0, 40.0),
    (-0.02, 0.05),
    (2e-3, 0.06),
    (-0.02, 0.05),
    (2e-3, 0.06),
];

pub(crate) struct TwistFits {
    /// Polynomial with `p_0` to `p_6`.
    pub polynomial: LinearFit,
    /// Polynomial with `p_1` to `p_6`.
    pub without_offset: LinearFit,
    /// Published form of B3 with equal weights.
    pub tanh: ParameterFit,
    /// Published form of B3 with relative weights.
    pub tanh_relative: ParameterFit,
    /// Smallest forms: separate saturation of B3 in both senses of twist, and `xi - 1` with two slopes.
    pub smallest: GroupFits,
    /// Root mean square residual of the published `xi`, with and without its offset.
    pub published_xi_rms: [f64; 2],
    /// Root mean square residual of the published B3 (pN nm^2), and relative.
    pub published_b3_rms: [f64; 2],
    pub ranges: [f64; 2],
}

impl TwistFits {
    pub(crate) fn new(data: &FitData) -> Result<Self, String> {
        let (rigidity, length) = (&data.rigidity, &data.length);
        let of_xi = |e| format!("xi against twist: {e}");
        let of_b3 = |e| format!("B3 against twist: {e}");
        let plain = length.observed(Weight::Equal).map_err(of_xi)?;
        let equal = rigidity.observed(Weight::Equal).map_err(of_b3)?;
        let relative = rigidity.observed(Weight::Relative).map_err(of_b3)?;
        let published = TanhTwist::published();
        let tanh = |data: &Data, extra: &[f64]| {
            let starts = Starts::at(extra).and_random(STARTS.0, STARTS.1);
            let (form, model) = (
                Form::of("published form of B3"),
                LawForm::tanh(wide(published)),
            );
            ParameterFit::search(form, &model, data, LAMBDA_BOUNDS.to_vec(), &starts)
        };
        let tanh_fit = tanh(&equal, &published.lambda)?;
        Ok(Self {
            polynomial: Polynomial::new(DEGREE).fit(&plain).map_err(of_xi)?,
            without_offset: Polynomial::without_constant(DEGREE)
                .fit(&plain)
                .map_err(of_xi)?,
            tanh_relative: tanh(&relative, &tanh_fit.fit.parameters)?,
            tanh: tanh_fit,
            smallest: GroupFits::new(data)?,
            published_xi_rms: [
                PolynomialStretch::published(),
                PolynomialStretch::published_without_offset(),
            ]
            .map(|law| length.rms(|k| law.jet(k)[0], false)),
            published_b3_rms: [false, true]
                .map(|relative| rigidity.rms(|k| wide(published).secant(k), relative)),
            ranges: [rigidity.range(), length.range()],
        })
    }

    /// Parameters that are undetermined or at a bound.
    pub(super) fn faults(&self) -> Vec<Fault> {
        [self.tanh.faults(), self.smallest.faults()].concat()
    }

    /// Standard error of coefficient `j` of the polynomial due to the rounding of the paper's rows.
    pub(crate) fn rounding_error(&self, j: usize) -> f64 {
        let fit = &self.polynomial;
        let noise = fit
            .goodness
            .reduced_chi_squared()
            .map_or(f64::NAN, f64::sqrt);
        let error = fit.precision.standard_error(j).unwrap_or(f64::NAN);
        error / noise * ROUNDING_DEVIATION
    }

    pub(crate) fn tanh_law(&self, fit: &Fit) -> TanhTwist {
        let limits = TanhTwist {
            range: self.ranges[0],
            ..TanhTwist::published()
        };
        (LawForm::tanh(limits).law)(&fit.parameters)
    }

    /// The law of a polynomial fit; `p_0 = 0` if the fit has no offset.
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

/// The law without a limited range, for fits of the formula.
fn wide(law: TanhTwist) -> TanhTwist {
    TanhTwist {
        range: f64::MAX,
        ..law
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use actin_fit::{Model, check_gradient};

    /// The published polynomial is the least-squares fit; the published `lambda` are not.
    #[test]
    fn paper_rows_give_the_published_polynomial_and_a_better_tanh() {
        let data = FitData::from_paper(false);
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
                "the rounding error {rounding} exceeds 10 % of {theirs}"
            );
        }
        assert!((fits.published_b3_rms[0] - 349.0).abs() < 1.0);
        assert!(
            fits.tanh.fit.goodness.rms <= 265.0,
            "{}",
            fits.tanh.fit.goodness.rms
        );
    }

    #[test]
    fn derivatives_of_the_forms() {
        let data = FitData::from_paper(false);
        let data = data.rigidity.observed(Weight::Equal).unwrap();
        let range = 1.0;
        #[rustfmt::skip]
        let checks: [(&dyn Model, &[f64]); 3] = [
            (&LawForm::tanh(TanhTwist::published()), &TanhTwist::published().lambda),
            (&LawForm::sided(range), &[300.0, 1.3e4, 0.009, 0.02, 2e4, 0.012, 0.016]),
            (&LawForm::rooted(range), &[-0.29, 0.46, 0.0067, 28.0]),
        ];
        for (model, parameters) in checks {
            let check = check_gradient(model, &data, parameters).unwrap();
            // The difference step is 7e-4 of each parameter.
            assert!(check.error < 1e-5, "{check:?}");
        }
    }
}

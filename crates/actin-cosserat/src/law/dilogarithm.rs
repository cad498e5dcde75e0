//! Integral for the energy of [`TanhTwist`](super::TanhTwist).

use std::f64::consts::PI;

/// `B_2k / (2k + 1)!` for k = 1 to 9. The first neglected term is below 1e-18 for `z <= 1`.
const SERIES: [f64; 9] = [
    1.0 / 36.0,
    -1.0 / 3_600.0,
    1.0 / 211_680.0,
    -1.0 / 10_886_400.0,
    1.0 / 526_901_760.0,
    -691.0 / 16_999_766_784e3,
    1.0 / 1_120_863_744e3,
    -3_617.0 / 18_140_058_832_896e4,
    43_867.0 / 9.707_279_012_624_794e19,
];

/// `-Li2(-z)` for `z` in [0, 1]: `u + u^2/4 + sum B_2k u^(2k+1)/(2k+1)!` with `u = ln(1 + z)`.
fn minus_dilogarithm(z: f64) -> f64 {
    let u = z.ln_1p();
    let u2 = u * u;
    let tail = SERIES.iter().rev().fold(0.0, |sum, c| (sum + c) * u2);
    u * (1.0 + 0.25 * u + tail)
}

/// `ln cosh x`, without overflow.
fn log_cosh(x: f64) -> f64 {
    let x = x.abs();
    x + (-2.0 * x).exp().ln_1p() - std::f64::consts::LN_2
}

/// `int_0^x y tanh(y) dy`, odd in `x`, with an absolute error below 1e-15 (1 + x^2).
fn moment_of_tanh(x: f64) -> f64 {
    let a = x.abs();
    let z = (-2.0 * a).exp();
    let moment = 0.5 * a * a + a * z.ln_1p() + 0.5 * minus_dilogarithm(z) - PI * PI / 24.0;
    moment.copysign(x)
}

/// `int_0^k s tanh((s - centre) / width) ds`.
pub(super) fn tanh_energy(k: f64, centre: f64, width: f64) -> f64 {
    let antiderivative = |s: f64| {
        let x = (s - centre) / width;
        width * (centre * log_cosh(x) + width * moment_of_tanh(x))
    };
    antiderivative(k) - antiderivative(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Li2(-1) = -pi^2/12, Li2(-1/2) = -0.448414206923646202 (Lewin, Polylogarithms).
    #[test]
    fn dilogarithm_at_known_points() {
        assert!(minus_dilogarithm(0.0).abs() < 1e-300);
        assert!((minus_dilogarithm(1.0) - PI * PI / 12.0).abs() < 1e-15);
        assert!((minus_dilogarithm(0.5) - 0.448_414_206_923_646_2).abs() < 1e-15);
    }

    #[test]
    fn closed_form_is_the_integral() {
        for (k, centre, width) in [
            (0.046, -0.016, 0.0072),
            (-0.03, 1e-6, 0.018),
            (0.02, 0.3, 0.01),
        ] {
            let integral =
                crate::law::tests::integral(k, |s: f64| s * ((s - centre) / width).tanh());
            let error = tanh_energy(k, centre, width) - integral;
            // Round-off of the antiderivative, of order width (|centre| + width).
            assert!(
                error.abs() < 2e-15 * width * (1.0f64 + centre.abs() / width),
                "{error:e}"
            );
        }
    }
}

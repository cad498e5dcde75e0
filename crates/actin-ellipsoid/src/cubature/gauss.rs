//! Gauss-Legendre quadrature.

use std::f64::consts::PI;

/// Nodes in (-1, 1) and weights of the `n`-point rule, exact for polynomials of degree `2n - 1`.
///
/// Newton's method for the roots of the Legendre polynomial, starting from
/// `cos(pi (k + 3/4) / (n + 1/2))`. Accurate to about 1e-14.
///
/// # Source
/// Abramowitz and Stegun, Handbook of Mathematical Functions, 25.4.29 and 22.16.6.
pub(super) fn legendre(n: usize) -> Vec<(f64, f64)> {
    (0..n)
        .map(|k| {
            let mut x = (PI * (k as f64 + 0.75) / (n as f64 + 0.5)).cos();
            for _ in 0..100 {
                let (value, slope) = polynomial(n, x);
                let step = value / slope;
                x -= step;
                if step.abs() < 1e-15 {
                    break;
                }
            }
            let (_, slope) = polynomial(n, x);
            (x, 2.0 / ((1.0 - x * x) * slope * slope))
        })
        .collect()
}

fn polynomial(n: usize, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (0.0, 1.0);
    for k in 0..n {
        let k = k as f64;
        let next = ((2.0 * k + 1.0) * x * value - k * before) / (k + 1.0);
        (before, value) = (value, next);
    }
    let slope = n as f64 * (x * value - before) / (x * x - 1.0);
    (value, slope)
}

#[cfg(test)]
mod tests {
    use super::legendre;

    /// Even powers integrate to `2 / (p + 1)`, odd ones to 0.
    #[test]
    fn the_rule_is_exact_to_its_degree() {
        for n in [1, 2, 5, 24, 48] {
            let rule = legendre(n);
            let integral = |p: i32| rule.iter().map(|(x, w)| w * x.powi(p)).sum::<f64>();
            for p in 0..2 * i32::try_from(n).unwrap() {
                let exact = if p % 2 == 0 {
                    2.0 / f64::from(p + 1)
                } else {
                    0.0
                };
                assert!((integral(p) - exact).abs() < 1e-13, "{n} points, power {p}");
            }
            let p = 2 * i32::try_from(n).unwrap();
            let exact = 2.0 / f64::from(p + 1);
            assert!(n > 12 || (integral(p) - exact).abs() > 1e-7);
        }
    }
}

//! The inextensible elastica under a tip force, which relates deflection to bending rigidity.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2};

/// Largest ratio of deflection to length for which the elastica is inverted; the ratio tends to 1
/// for an infinite force.
const LARGEST_DEFLECTION: f64 = 0.95;

/// Ratio of deflection to length of a clamped inextensible elastica under a tip force across its
/// undeformed axis, with `alpha = F L^2 / B`.
///
/// With the slope `theta` at the tip, `k^2 = (1 + sin theta) / 2` and `sin phi = 1 / (k sqrt 2)`:
/// `sqrt(alpha) = K(k) - F(phi, k)` and `d / L = 1 - 2 (E(k) - E(phi, k)) / sqrt(alpha)`, with
/// Legendre's elliptic integrals. Relative error below 1e-9 for `alpha` from 1e-3 to 20.
///
/// # Source
/// Bisshopp and Drucker, Q. Appl. Math. 3 (1945) 272.
///
/// ```
/// let deflection = actin_paper::measure::elastica_deflection(1.0);
/// assert!((deflection - 0.301_720_773_8).abs() < 1e-9);
/// ```
pub fn elastica_deflection(alpha: f64) -> f64 {
    let slope = bisect(0.0, FRAC_PI_2, |slope| at_slope(slope).0 - alpha);
    at_slope(slope).1
}

/// Ratio `(3 d / L) / alpha` of the elastica rigidity to `F L^3 / 3 d` at the deflection `d / L`; 1
/// for small deflections. NaN above 0.95, where the deflection hardly depends on the force.
pub(super) fn rigidity_ratio(deflection: f64) -> f64 {
    if deflection > LARGEST_DEFLECTION || deflection.is_nan() {
        return f64::NAN;
    }
    let slope = bisect(0.0, FRAC_PI_2, |slope| at_slope(slope).1 - deflection);
    let (alpha, at) = at_slope(slope);
    if alpha == 0.0 { 1.0 } else { 3.0 * at / alpha }
}

/// `alpha` and the ratio of deflection to length at a tip slope (rad).
fn at_slope(slope: f64) -> (f64, f64) {
    let k2 = 0.5 * (1.0 + slope.sin());
    let phi = (FRAC_1_SQRT_2 / k2.sqrt()).min(1.0).asin();
    let root = |t: f64| (1.0 - k2 * t.sin().powi(2)).sqrt();
    let first = integrate(phi, FRAC_PI_2, |t| 1.0 / root(t));
    // 1 - 2 E / F as the integral of 1/root - 2 root, which avoids cancellation at small slopes.
    let deflection = integrate(phi, FRAC_PI_2, |t| 1.0 / root(t) - 2.0 * root(t));
    if first == 0.0 {
        return (0.0, 0.0);
    }
    (first * first, deflection / first)
}

/// Composite Gauss-Legendre rule with 3 points in 64 intervals.
fn integrate(from: f64, to: f64, f: impl Fn(f64) -> f64) -> f64 {
    const INTERVALS: usize = 64;
    let half = 0.5 * (to - from) / INTERVALS as f64;
    let node = half * 0.6_f64.sqrt();
    let sum: f64 = (0..INTERVALS)
        .map(|i| {
            let middle = from + (2 * i + 1) as f64 * half;
            5.0 * (f(middle - node) + f(middle + node)) + 8.0 * f(middle)
        })
        .sum();
    sum * half / 9.0
}

/// The zero of an increasing function between two bounds.
fn bisect(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if f(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::{elastica_deflection, rigidity_ratio};

    /// Literature values with ten digits.
    const ORACLE: [(f64, f64); 5] = [
        (0.2, 0.066_364_482_1),
        (1.0, 0.301_720_773_8),
        (2.0, 0.493_457_480_4),
        (5.0, 0.713_791_523_6),
        (10.0, 0.810_609_024_9),
    ];

    #[test]
    fn deflections_equal_literature_values() {
        for (alpha, expected) in ORACLE {
            let deflection = elastica_deflection(alpha);
            // The literature values are rounded to 5e-11.
            assert!(
                (deflection - expected).abs() < 1e-10,
                "{alpha}: {deflection}"
            );
        }
    }

    /// The inverse of the deflection at rigidity 1 is 1. Small deflections agree with linear
    /// theory.
    #[test]
    fn the_inverse_recovers_the_rigidity() {
        for (alpha, deflection) in ORACLE {
            let rigidity = alpha / (3.0 * deflection) * rigidity_ratio(deflection);
            // The inverse multiplies the rounding error of the literature values by at most ten.
            assert!((rigidity - 1.0).abs() < 1e-8, "{alpha}: {rigidity}");
        }
        assert!((rigidity_ratio(1e-4) - 1.0).abs() < 1e-6);
        assert!(rigidity_ratio(0.99).is_nan());
    }
}

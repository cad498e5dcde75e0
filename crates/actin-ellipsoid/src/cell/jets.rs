//! Rotation matrix and left Jacobian of SO(3) with first and second derivatives.

use actin_mechanics::{Matrix3, Vector3};

/// Terms of the series of `c_6` and `c_7`, sufficient for angles up to pi.
const TERMS: u32 = 16;

/// Stumpff functions `c_n(p) = sum_k (-p)^k / (2 k + n)!` for `n` from 0 to 7.
///
/// At `p = a^2`, `c_0 = cos(a)`, `c_1 = sin(a)/a`, `c_2 = (1 - cos(a))/a^2` and
/// `c_3 = (a - sin(a))/a^3`. The series gives `c_6` and `c_7`, the recursion
/// `c_n = 1/n! - p c_{n+2}` the others. The relative error is below 1e-13 for `p` up to 10.
fn stumpff(p: f64) -> [f64; 8] {
    let series = |n: u32| {
        let mut sum = 0.0;
        for k in (1..=TERMS).rev() {
            let divisor = f64::from((2 * k + n) * (2 * k + n - 1));
            sum = -p / divisor * (1.0 + sum);
        }
        1.0 + sum
    };
    let mut c = [0.0; 8];
    c[7] = series(7) / 5040.0;
    c[6] = series(6) / 720.0;
    let mut factorial = 120.0;
    for n in (0..6).rev() {
        c[n] = 1.0 / factorial - p * c[n + 2];
        factorial /= (n as f64).max(1.0);
    }
    c
}

/// Derivatives of the Stumpff functions with respect to `p`: `(n c_{n+2} - c_{n+1}) / 2`.
fn slopes<const N: usize, const M: usize>(c: &[f64; N]) -> [f64; M] {
    std::array::from_fn(|n| 0.5 * (n as f64 * c[n + 2] - c[n + 1]))
}

/// Rotation by `w` and left Jacobian at `w`, without derivatives.
pub(super) fn turned(w: Vector3) -> (Matrix3, Matrix3) {
    let c = stumpff(w.norm_squared());
    let (cross, outer) = (w.cross_matrix(), w * w.transpose());
    let sum = |n: usize| Matrix3::identity() * c[n] + cross * c[n + 1] + outer * c[n + 2];
    (sum(0), sum(1))
}

/// `ln((sin(a/2)/(a/2))^2)` at `p = a^2`, with two derivatives with respect to `p`: logarithm of
/// the density of the uniform measure on SO(3) in rotation vectors of length `a`.
pub(super) fn log_density(p: f64) -> [f64; 3] {
    let c = stumpff(p);
    let first: [f64; 6] = slopes(&c);
    let second: [f64; 4] = slopes(&first);
    let slope = first[2] / c[2];
    [(2.0 * c[2]).ln(), slope, second[2] / c[2] - slope * slope]
}

/// Matrix function of a rotation vector `w` (rad), with derivatives.
#[derive(Clone, Copy, Debug)]
pub(super) struct MatrixJet {
    pub(super) value: Matrix3,
    /// First derivatives with respect to the components of `w`.
    pub(super) first: [Matrix3; 3],
    /// Second derivatives.
    pub(super) second: [[Matrix3; 3]; 3],
}

impl MatrixJet {
    /// Rotation `exp([w]x)`.
    pub(super) fn rotation(w: Vector3) -> Self {
        Self::new(w, 0)
    }

    /// Left Jacobian `J_l(w)`: mean of the rotations by `t w` over `t` in [0, 1].
    pub(super) fn left_jacobian(w: Vector3) -> Self {
        Self::new(w, 1)
    }

    /// `c_n 1 + c_{n+1} [w]x + c_{n+2} w w^T`.
    fn new(w: Vector3, n: usize) -> Self {
        let c = stumpff(w.norm_squared());
        let first: [f64; 6] = slopes(&c);
        let second: [f64; 4] = slopes(&first);
        let (cross, outer) = (w.cross_matrix(), w * w.transpose());
        let sum = |k: &[f64]| Matrix3::identity() * k[n] + cross * k[n + 1] + outer * k[n + 2];
        let unit = |a| Vector3::ith(a, 1.0);
        let turned = |a: usize| unit(a).cross_matrix();
        let along = |a: usize| unit(a) * w.transpose() + w * unit(a).transpose();
        let partial = |k: &[f64], a: usize| turned(a) * k[n + 1] + along(a) * k[n + 2];
        let [by_p, by_p_twice] = [sum(&first), sum(&second)];
        let mixed = |a: usize, b: usize| {
            let both = unit(a) * unit(b).transpose() + unit(b) * unit(a).transpose();
            let diagonal = if a == b { 2.0 } else { 0.0 };
            by_p_twice * (4.0 * w[a] * w[b])
                + by_p * diagonal
                + partial(&first, b) * (2.0 * w[a])
                + partial(&first, a) * (2.0 * w[b])
                + both * c[n + 2]
        };
        Self {
            value: sum(&c),
            first: std::array::from_fn(|a| by_p * (2.0 * w[a]) + partial(&c, a)),
            second: std::array::from_fn(|a| std::array::from_fn(|b| mixed(a, b))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use actin_mechanics::rotation;
    use actin_mechanics::testing::derivative;

    const TURNS: [[f64; 3]; 4] = [
        [0.0, 0.0, 0.0],
        [1e-9, 2e-9, -3e-9],
        [0.2, -0.5, 0.1],
        [1.5, 1.0, -2.0],
    ];

    #[test]
    fn values_are_those_of_the_rotation_group() {
        for turn in TURNS.map(Vector3::from) {
            let expected = rotation::exp(turn).to_rotation_matrix().into_inner();
            assert!((MatrixJet::rotation(turn).value - expected).norm() < 1e-13);
            let inverse = rotation::right_jacobian_inverse(turn).transpose();
            let product = MatrixJet::left_jacobian(turn).value * inverse;
            assert!((product - Matrix3::identity()).norm() < 1e-13);
        }
    }

    #[test]
    fn functions_without_jets_are_the_same() {
        for turn in TURNS.map(Vector3::from) {
            let (rotation, jacobian) = turned(turn);
            assert!((rotation - MatrixJet::rotation(turn).value).norm() < 1e-15);
            assert!((jacobian - MatrixJet::left_jacobian(turn).value).norm() < 1e-15);
            let half = (0.5 * turn.norm()).max(1e-12);
            let [value, slope, second] = log_density(turn.norm_squared());
            assert!((value - 2.0 * (half.sin() / half).ln()).abs() < 1e-14);
            let at = |h: f64| log_density(turn.norm_squared() + h);
            assert!((slope - derivative(0.02, |h| at(h)[0])).abs() < 1e-11);
            assert!((second - derivative(0.02, |h| at(h)[1])).abs() < 1e-11);
        }
    }

    /// Eight-point differences have an error of about 1e-12 here.
    #[test]
    fn jets_hold_the_derivatives() {
        for turn in TURNS.map(Vector3::from) {
            for of in [MatrixJet::rotation, MatrixJet::left_jacobian] {
                let jet = of(turn);
                for a in 0..3 {
                    let at = |h: f64| of(turn + Vector3::ith(a, h));
                    let first = derivative(0.02, |h| at(h).value);
                    assert!((jet.first[a] - first).norm() < 1e-11, "{turn}");
                    for b in 0..3 {
                        let second = derivative(0.02, |h| at(h).first[b]);
                        assert!((jet.second[a][b] - second).norm() < 1e-11, "{turn}");
                    }
                }
            }
        }
    }
}

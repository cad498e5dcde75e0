//! The laws of rods as models to fit: values, and derivatives with respect to the parameters.

use actin_cosserat::{RootedStretch, SidedTwist, Stiffening, StretchLaw, TanhTwist, TwistRise};
use actin_fit::Model;

/// Published form of B3 against twist with fixed limits: `lambda_1` to `lambda_7`.
#[derive(Debug)]
pub(super) struct Tanh {
    pub limits: TanhTwist,
}

/// B3 against twist, saturating separately in under-twist and over-twist: `rest`, then `rise`,
/// `half` and `slow` of each side.
#[derive(Debug)]
pub(super) struct Sided {
    pub range: f64,
}

/// `xi - 1` against twist with two slopes: `slope`, `bend`, `half`, `cubic`.
#[derive(Debug)]
pub(super) struct Rooted {
    pub range: f64,
}

/// Bending rigidity against curvature: `rest`, `rise` and the curvature at half the rise.
#[derive(Debug)]
pub(super) struct Stiffened {
    pub range: f64,
}

impl Tanh {
    pub(super) fn law(&self, p: &[f64]) -> TanhTwist {
        let mut law = self.limits;
        law.lambda.copy_from_slice(p);
        law
    }
}

impl Model for Tanh {
    fn parameters(&self) -> usize {
        7
    }

    fn value(&self, x: &[f64], p: &[f64]) -> f64 {
        self.law(p).secant(x[0])
    }

    fn gradient(&self, x: &[f64], p: &[f64], gradient: &mut [f64]) {
        gradient.copy_from_slice(&self.law(p).secant_gradient(x[0])[2..]);
    }
}

impl Sided {
    pub(super) fn law(&self, p: &[f64]) -> SidedTwist {
        let side = |p: &[f64]| TwistRise {
            rise: p[0],
            half: p[1],
            slow: p[2],
        };
        SidedTwist {
            rest: p[0],
            under: side(&p[1..4]),
            over: side(&p[4..7]),
            range: self.range,
        }
    }
}

impl Model for Sided {
    fn parameters(&self) -> usize {
        7
    }

    fn value(&self, x: &[f64], p: &[f64]) -> f64 {
        self.law(p).secant(x[0])
    }

    fn gradient(&self, x: &[f64], p: &[f64], gradient: &mut [f64]) {
        gradient.copy_from_slice(&self.law(p).secant_gradient(x[0]));
    }
}

impl Rooted {
    pub(super) fn law(&self, p: &[f64]) -> RootedStretch {
        RootedStretch {
            slope: p[0],
            bend: p[1],
            half: p[2],
            cubic: p[3],
            range: self.range,
        }
    }
}

impl Model for Rooted {
    fn parameters(&self) -> usize {
        4
    }

    fn value(&self, x: &[f64], p: &[f64]) -> f64 {
        self.law(p).jet(x[0])[0]
    }

    fn gradient(&self, x: &[f64], p: &[f64], gradient: &mut [f64]) {
        gradient.copy_from_slice(&self.law(p).gradient(x[0]));
    }
}

impl Stiffened {
    pub(super) fn law(&self, p: &[f64]) -> Stiffening {
        Stiffening {
            rest: p[0],
            rise: p[1],
            curvature: p[2],
            twist: f64::INFINITY,
            shear: f64::INFINITY,
            range: self.range,
        }
    }
}

impl Model for Stiffened {
    fn parameters(&self) -> usize {
        3
    }

    fn value(&self, x: &[f64], p: &[f64]) -> f64 {
        self.law(p).secant(x[0], 0.0)
    }

    fn gradient(&self, x: &[f64], p: &[f64], gradient: &mut [f64]) {
        gradient.copy_from_slice(&self.law(p).secant_gradient(x[0]));
    }
}

/// Strain against axial force: `tension`, `compression` and `width` of the law.
#[derive(Debug)]
pub(super) struct Stretched;

impl Stretched {
    pub(super) fn law(p: &[f64]) -> StretchLaw {
        StretchLaw::Sided {
            tension: p[0],
            compression: p[1],
            width: p[2],
        }
    }
}

impl Model for Stretched {
    fn parameters(&self) -> usize {
        3
    }

    /// Root of a quadratic equation, refined by one Newton step against cancellation.
    fn value(&self, x: &[f64], p: &[f64]) -> f64 {
        let (force, law) = (x[0], Self::law(p));
        let (mean, half) = (0.5 * (p[0] + p[1]), 0.5 * (p[0] - p[1]));
        let shifted = mean * (force + half * p[2]);
        let squared = (mean * p[2]).powi(2) + force * (force + 2.0 * half * p[2]);
        let root = (shifted - half * squared.max(0.0).sqrt()) / (p[0] * p[1]);
        root - (law.force(root) - force) / law.tangent(root)
    }

    /// `de/dp = -(dF/dp) / (dF/de)` at the strain of the force.
    fn gradient(&self, x: &[f64], p: &[f64], gradient: &mut [f64]) {
        let strain = self.value(x, p);
        let tangent = Self::law(p).tangent(strain);
        let root = strain.hypot(p[2]);
        let bent = strain * strain / (root + p[2]);
        let by = [
            0.5 * (strain + bent),
            0.5 * (strain - bent),
            0.5 * (p[0] - p[1]) * (p[2] / root - 1.0),
        ];
        for (slope, by) in gradient.iter_mut().zip(by) {
            *slope = -by / tangent;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use actin_fit::{Data, Observations, check_gradient};

    /// The force at the strain of a force equals that force to rounding.
    #[test]
    fn strains_of_forces() {
        for p in [[3e4, 1.5e4, 1e-3], [1e4, 2e4, 1e-4], [2e4, 2e4, 1e-3]] {
            for force in [-500.0, -20.0, -1.0, -1e-3, 0.0, 1e-6, 0.1, 5.0, 300.0] {
                let strain = Stretched.value(&[force], &p);
                let borne = Stretched::law(&p).force(strain);
                assert!(
                    (borne - force).abs() <= 1e-13 * f64::abs(force),
                    "{p:?} {force} {borne}"
                );
            }
        }
    }

    #[test]
    fn gradient_of_the_strain() {
        let x = [-50.0, -3.0, 1.0, 20.0];
        let data = Data::new(&x, Observations::new(&[0.0; 4]).unwrap()).unwrap();
        let check = check_gradient(&Stretched, &data, &[3e4, 1.5e4, 1e-3]).unwrap();
        assert!(check.error < 1e-9, "{check:?}");
    }
}

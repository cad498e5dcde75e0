//! The rod's laws as models to fit: their values and derivatives in the parameters.
//!
//! The forms themselves live with the rod; here they only get their parameters in a row.

use actin_cosserat::{RootedStretch, SidedTwist, Stiffening, TanhTwist, TwistRise};
use actin_fit::Model;

/// B3 against twist as published, the two limits held: `lambda_1` to `lambda_7`.
#[derive(Debug)]
pub(super) struct Tanh {
    pub limits: TanhTwist,
}

/// B3 against twist with its own saturation to either side: `rest`, then rise, half and slow of
/// under-twist and of over-twist.
#[derive(Debug)]
pub(super) struct Sided {
    pub range: f64,
}

/// `xi - 1` against twist with two slopes: slope, bend, half, cubic.
#[derive(Debug)]
pub(super) struct Rooted {
    pub range: f64,
}

/// Bending rigidity against curvature: rest, rise and the curvature of half the rise.
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

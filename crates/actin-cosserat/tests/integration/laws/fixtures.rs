//! Laws with scales of the order of the strains in tests.

use super::{PolynomialStretch, RootedStretch, SidedTwist, Stiffening, TwistRise, TwistStretch};

pub(crate) const STIFFENING: Stiffening = Stiffening {
    rest: 3e4,
    rise: 1e4,
    curvature: 0.05,
    twist: 0.06,
    shear: 0.2,
    range: 0.2,
};

pub(crate) const fn sided(range: f64) -> SidedTwist {
    SidedTwist {
        rest: 272.0,
        under: TwistRise {
            rise: 1.3e4,
            half: 0.04,
            slow: 0.08,
        },
        over: TwistRise {
            rise: 2.2e4,
            half: 0.05,
            slow: 0.07,
        },
        range,
    }
}

pub(crate) const fn rooted(range: f64) -> TwistStretch {
    TwistStretch::Rooted(RootedStretch {
        slope: -0.29,
        bend: 0.46,
        half: 0.03,
        cubic: 2.0,
        range,
    })
}

pub(crate) const fn polynomial(range: f64) -> TwistStretch {
    TwistStretch::Polynomial(PolynomialStretch {
        coefficients: [-5e-4, -0.3, -5.0, 20.0, 300.0, -1e3, -1e4],
        range,
    })
}

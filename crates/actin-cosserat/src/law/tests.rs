//! Derivatives, integrals and validation of the laws of twist and stretch.

use super::{
    PolynomialStretch, RootedStretch, SidedTwist, Stiffening, TanhTwist, TwistLaw, TwistRise,
    TwistStretch,
};
use actin_mechanics::testing::derivative;

pub(super) const ROOTED: RootedStretch = RootedStretch {
    slope: -0.29,
    bend: 0.46,
    half: 0.0067,
    cubic: 28.5,
    range: 0.0475,
};

pub(super) const SIDED: SidedTwist = SidedTwist {
    rest: 272.0,
    under: TwistRise {
        rise: 1.29e4,
        half: 0.009,
        slow: 0.0192,
    },
    over: TwistRise {
        rise: 2.2e4,
        half: 0.0119,
        slow: 0.0163,
    },
    range: 0.0475,
};

pub(super) const STIFFENING: Stiffening = Stiffening {
    rest: 3e4,
    rise: 1e4,
    curvature: 3e-3,
    twist: 0.02,
    shear: 0.01,
    range: 0.02,
};

/// `SidedTwist` has positive, negative and nearly zero discriminants of the denominator.
fn twists() -> [TwistLaw; 4] {
    let sided = |slow| {
        let under = TwistRise {
            slow,
            ..SIDED.under
        };
        TwistLaw::Sided(SidedTwist { under, ..SIDED })
    };
    let tanh = TwistLaw::Tanh(TanhTwist::published());
    [tanh, sided(0.0192), sided(0.005), sided(0.018)]
}

/// `int_0^k f` by five-point Gauss-Legendre quadrature on a thousand panels.
pub(super) fn integral(k: f64, f: impl Fn(f64) -> f64) -> f64 {
    let nodes = [
        (0.0, 0.568_888_888_888_888_9),
        (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
        (0.906_179_845_938_664, 0.236_926_885_056_189_08),
    ];
    let half = k / 2000.0;
    let panel = |i: u32| {
        let middle = half * f64::from(2 * i + 1);
        let pair = |(x, w): (f64, f64)| {
            let both = f(middle + half * x) + f(middle - half * x);
            if x == 0.0 { 0.5 * w * both } else { w * both }
        };
        half * nodes.map(pair).iter().sum::<f64>()
    };
    (0..1000).map(panel).sum()
}

#[test]
fn energies_are_integrals_of_the_couple() {
    for law in twists() {
        let range = law.range().unwrap();
        for k in [-0.09, -0.0462, -0.02, -0.003, 0.001, 0.01, 0.04, 0.06] {
            let expected = integral(k, |s| law.couple(s));
            let error = (law.energy_density(k) - expected).abs();
            // Relative to terms of order rise slow k, which cancel at small twist; outside the
            // range a panel contains the kink.
            let inside = 1e-14 * 2e4 * 0.02 * f64::abs(k);
            let bound = if f64::abs(k) > range {
                1e-8 * expected
            } else {
                inside
            };
            assert!(error < bound, "{law:?} {k}: {error:e}");
        }
    }
}

#[test]
fn tangents_are_slopes_of_the_couple_and_both_are_extrapolated() {
    for law in twists() {
        for k in [-0.2, -0.05, -0.03, -0.01, 0.004, 0.02, 0.045, 0.1] {
            let slope = derivative(1e-5, |h| law.couple(k + h));
            assert!((law.tangent(k) - slope).abs() < 1e-7 * 1.6e4, "{law:?} {k}");
        }
        for side in [-1.0, 1.0] {
            let (k, edge) = (0.2 * side, side * law.range().unwrap());
            let expected = law.couple(edge) + law.tangent(edge) * (k - edge);
            assert!((law.couple(k) - expected).abs() < 1e-10, "{law:?}");
        }
    }
    assert!((SIDED.tangent(0.0) - SIDED.rest).abs() < 1e-12);
}

#[test]
fn jets_contain_the_derivatives_inside_and_outside_the_range() {
    for (law, largest) in [
        (TwistStretch::published(), 50.0),
        (TwistStretch::Rooted(ROOTED), 70.0),
    ] {
        for k in [-0.1, -0.04, -0.01, 0.0, 0.02, 0.045, 0.2] {
            let jet = law.jet(k);
            for (order, scale) in [(0, 1.0), (1, largest)] {
                let slope = derivative(1e-4, |h| law.jet(k + h)[order]);
                assert!(
                    (jet[order + 1] - slope).abs() < 1e-7 * scale,
                    "{law:?} {k} {order}"
                );
            }
        }
    }
}

#[test]
fn bad_numbers_are_refused() {
    const NAN: f64 = f64::NAN;
    let polynomial = PolynomialStretch::published();
    let over = SIDED.over;
    #[rustfmt::skip]
    let refused = [
        ("coefficients", PolynomialStretch { coefficients: [0.0, 0.0, 0.0, NAN, 0.0, 0.0, 0.0], ..polynomial }.validate()),
        ("range_per_nm", PolynomialStretch { range: 0.0, ..polynomial }.validate()),
        ("slope_nm", RootedStretch { slope: NAN, ..ROOTED }.validate()),
        ("bend_nm", RootedStretch { bend: f64::INFINITY, ..ROOTED }.validate()),
        ("half_per_nm", RootedStretch { half: 0.0, ..ROOTED }.validate()),
        ("cubic_nm3", RootedStretch { cubic: NAN, ..ROOTED }.validate()),
        ("range_per_nm", RootedStretch { range: -1.0, ..ROOTED }.validate()),
        ("rest_pn_nm2", SidedTwist { rest: -1.0, ..SIDED }.validate()),
        ("rise_pn_nm2", SidedTwist { over: TwistRise { rise: 0.0, ..over }, ..SIDED }.validate()),
        ("half_per_nm", SidedTwist { over: TwistRise { half: NAN, ..over }, ..SIDED }.validate()),
        ("slow_per_nm", SidedTwist { over: TwistRise { slow: -1.0, ..over }, ..SIDED }.validate()),
        ("range_per_nm", SidedTwist { range: 0.0, ..SIDED }.validate()),
        ("rest_pn_nm2", Stiffening { rest: 0.0, ..STIFFENING }.validate()),
        ("rise_pn_nm2", Stiffening { rise: -1.0, ..STIFFENING }.validate()),
        ("curvature_per_nm", Stiffening { curvature: NAN, ..STIFFENING }.validate()),
        ("twist_per_nm", Stiffening { twist: 0.0, ..STIFFENING }.validate()),
        ("shear", Stiffening { shear: NAN, ..STIFFENING }.validate()),
        ("range_per_nm", Stiffening { range: -1.0, ..STIFFENING }.validate()),
    ];
    for (key, result) in refused {
        assert_eq!(result.unwrap_err().key, key);
    }
    assert!(twists().iter().all(|law| law.validate().is_ok()));
    assert!(TwistStretch::linear(9.35e3, 3.4e4).validate().is_ok());
}

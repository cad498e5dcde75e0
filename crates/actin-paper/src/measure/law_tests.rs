//! Closed forms for twisted filaments, and statistics over samplings.

use super::*;
use actin_sim::{Monomers, RodLaw, RodModel};

fn rod() -> Specimen {
    Specimen::rod(75.0, Some(48), RodModel::with_law(RodLaw::Constant))
}

fn monomers() -> Specimen {
    let monomers = Monomers::default();
    Specimen::ellipsoids(14.0 * monomers.rise_nm, monomers)
}

fn assert_near(value: f64, expected: f64, tolerance: f64) {
    let error = (value / expected - 1.0).abs();
    assert!(
        error <= tolerance,
        "{value} for {expected}: {error:.2e} above {tolerance:.0e}"
    );
}

/// A twisted and bent rod is a helix under one couple. Both of its rigidities are recovered for
/// both senses of twist, also beyond half a turn.
#[test]
fn a_helix_has_both_rigidities_of_the_rod() {
    for (twist, azimuth) in [(0.03, 0.0), (-0.03, 50.0), (0.06, 0.0), (1e-4, 120.0)] {
        let curve = bend_twisted(&rod(), twist, &[-0.01, 0.002], azimuth).unwrap();
        assert_eq!(curve.points.len(), 2);
        for point in &curve.points {
            // Elements of 1.6 nm turn by up to 0.1 rad: the error is (theta^2) / 12 of the
            // difference of the rigidities.
            assert_near(point.rigidity_pn_nm2, 3.9e4, 2e-3);
            let twisting = point.twisting_couple_pn_nm / point.helix_twist_rad_per_nm;
            assert_near(twisting, 1.3e4, 2e-3);
            assert!(point.curvature_rad_per_nm * point.tilt_rad_per_nm > 0.0);
        }
    }
}

/// Samplings are in the order of their seeds, independent of scheduling.
#[test]
fn samplings_come_in_the_order_of_their_seeds() {
    let seeds = [7, 2, 5];
    let measure = |s: &Specimen| stretch_by_force(s, &[10.0, -5.0]);
    let mut drawn = monomers();
    drawn.filament.monomers = Monomers::with_sampled_bonds(64, 0);
    let curves = over_samplings_and_azimuths(&drawn, &seeds, &[0.0], |s, _| measure(s)).unwrap();
    for (curve, &seed) in curves.iter().zip(&seeds) {
        let mut alone = drawn.clone();
        alone.filament.monomers.seed = seed;
        assert_eq!(*curve, measure(&alone).unwrap());
    }
    let sampled = sampled_by(&curves, |p| p.force_pn, |p| p.rigidity_pn);
    assert_eq!(
        sampled.iter().map(|s| s.0).collect::<Vec<_>>(),
        [-5.0, 10.0]
    );
    let by_hand: f64 = curves.iter().map(|c| c.points[1].rigidity_pn / 3.0).sum();
    // Rounding of a sum of three numbers in another order.
    assert_near(sampled[1].1.mean, by_hand, 1e-14);
    assert!(sampled.iter().all(|s| s.1.count == 3 && s.1.error > 0.0));
    assert_near(
        sampled[0].1.deviation,
        sampled[0].1.error * 3.0_f64.sqrt(),
        1e-14,
    );
}

/// The scatter of one value is unknown, not zero: zero would give an infinite weight in a fit.
#[test]
fn one_value_has_no_scatter() {
    let one = SampleStatistics::from_values([2.0]);
    assert!((one.mean - 2.0).abs() < f64::EPSILON);
    assert!(one.deviation.is_nan() && one.error.is_nan());
    assert!(SampleStatistics::from_values([]).mean.is_nan());
}

#[test]
fn undefined_twists_and_tilts_are_refused() {
    let refused = |name: &str, error: MeasureError| match error {
        MeasureError::Value { name: found, .. } => assert_eq!(found, name),
        other => panic!("{other}"),
    };
    let rod = rod();
    let error = bend_twisted(&rod, f64::NAN, &[0.01], 0.0).unwrap_err();
    refused("twist_rad_per_nm", error);
    let error = bend_twisted(&rod, 0.0, &[0.0], 0.0).unwrap_err();
    refused("tilt_rad_per_nm", error);
}

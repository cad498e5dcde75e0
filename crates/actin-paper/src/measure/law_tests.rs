//! Closed forms for twisted and pulled filaments, and statistics over samplings.

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

/// Tension increases the end couple of a bent rod by `x / tanh x`, here by a half; compression
/// decreases it.
#[test]
fn the_rigidity_is_independent_of_tension() {
    for force in [50.0, -20.0] {
        let curve = bend_under_tension(&rod(), force, &[-1e-3, 1e-3], 30.0).unwrap();
        for point in &curve.points {
            // Shear adds F / S1 = 3e-3 to slopes; finite angles (0.04 rad) add their squares.
            assert_near(point.rigidity_pn_nm2, 3.9e4, 5e-3);
            let secant = point.couple_pn_nm / point.curvature_rad_per_nm;
            assert!((secant > 1.4 * 3.9e4) == (force > 0.0), "{secant}");
        }
    }
    let without = bend_under_tension(&rod(), 0.0, &[1e-3], 30.0).unwrap();
    // Newton's tolerance is 1e-7 pN nm of 39.
    assert_near(without.points[0].rigidity_pn_nm2, 3.9e4, 1e-6);
}

/// Without force the protocol equals `twist`. With force, the torque at a blocked turn equals the
/// torque of `stretch_by_force`.
#[test]
fn twist_under_tension_is_twist_without_force() {
    let specimen = monomers();
    let free = twist(&specimen, &[-60.0, 40.0]).unwrap();
    let pulled = twist_under_tension(&specimen, 0.0, &[-60.0, 40.0]).unwrap();
    for (a, b) in free.points.iter().zip(&pulled.points) {
        // Both paths have a tolerance of 1e-7.
        assert_near(b.twist.torque_pn_nm, a.torque_pn_nm, 1e-7);
        assert_near(
            b.twist.relative_length_change,
            a.relative_length_change,
            1e-6,
        );
    }
    // The twist-stretch slope at rest is -0.283 nm, so that a torque of +0.283 nm F blocks the
    // turn.
    let blocked = stretch_by_force(&specimen, &[10.0]).unwrap().points[0].torque_pn_nm;
    let near = twist_under_tension(&specimen, 10.0, &[1e-3]).unwrap();
    assert!((2.6..3.0).contains(&blocked), "{blocked}");
    // 1e-3 deg adds at most 3e-4 nm F, from the twisting rigidity of a short specimen.
    assert!((near.points[0].twist.torque_pn_nm - blocked).abs() < 1e-3);
}

/// Over-twist shortens monomers, so that tension unwinds them. The turn grows less than in
/// proportion, since the torque stiffness grows with the twist.
#[test]
fn tension_unwinds_an_end_that_is_free_to_turn() {
    let specimen = monomers();
    let curve = free_turn_under_tension(&specimen, &[10.0, 100.0]).unwrap();
    assert!(curve.unreached.is_empty() && curve.points.len() == 2);
    for point in &curve.points {
        let turn = point.twist.turn_deg;
        let again = twist_under_tension(&specimen, point.force_pn, &[turn]).unwrap();
        let blocked = 0.283 * point.force_pn;
        // The tolerance is 1e-4 of the blocking torque, which is below 0.283 nm F at 100 pN.
        assert!(again.points[0].twist.torque_pn_nm.abs() < 1.1e-4 * blocked);
    }
    let twist_at = |i: usize| curve.points[i].twist.curvature_rad_per_nm;
    assert!(twist_at(0) < 0.0 && twist_at(1) < twist_at(0) && twist_at(1) > 10.0 * twist_at(0));
}

/// Samplings are in the order of their seeds, independent of scheduling.
#[test]
fn samplings_come_in_the_order_of_their_seeds() {
    let seeds = [7, 2, 5];
    let measure = |s: &Specimen| stretch_by_force(s, &[10.0, -5.0]);
    let mut drawn = monomers();
    drawn.filament.monomers = Monomers::with_sampled_bonds(64, 0);
    let curves = over_samplings(&drawn, &seeds, measure).unwrap();
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
fn undefined_twists_and_forces_are_refused() {
    let refused = |name: &str, error: MeasureError| match error {
        MeasureError::Value { name: found, .. } => assert_eq!(found, name),
        other => panic!("{other}"),
    };
    let (rod, nan) = (rod(), f64::NAN);
    let error = bend_twisted(&rod, nan, &[0.01], 0.0).unwrap_err();
    refused("twist_rad_per_nm", error);
    let error = bend_twisted(&rod, 0.0, &[0.0], 0.0).unwrap_err();
    refused("tilt_rad_per_nm", error);
    let error = bend_under_tension(&rod, nan, &[0.01], 0.0).unwrap_err();
    refused("force_pn", error);
    let error = twist_under_tension(&rod, f64::INFINITY, &[1.0]).unwrap_err();
    refused("force_pn", error);
    let error = free_turn_under_tension(&rod, &[]).unwrap_err();
    refused("force_pn", error);
}

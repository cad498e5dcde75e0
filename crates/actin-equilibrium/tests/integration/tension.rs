//! Rods under extreme tension.

use crate::common;
use actin_equilibrium::Convergence;
use actin_mechanics::{Interaction, PointLoad, State, UnitQuaternion, Vector3};
use common::{ACTIN, Rod};

const SHORT: Rod = Rod {
    segments: 10,
    length: 100.0,
    ..ACTIN
};

/// Clamped rod along the rotated z axis with a longitudinal tip force.
fn pulled(force: f64, turn: UnitQuaternion) -> (State, Vec<Box<dyn Interaction>>) {
    let mut state = SHORT.state();
    for i in 0..=SHORT.segments {
        let place = turn * state.points.position.get(i);
        state.points.position.set(i, place);
        state.frames.orientation.set(i, turn);
    }
    let control = state.add_control(1.0);
    let force = turn * Vector3::z() * force;
    let load = PointLoad::new(&state, vec![(SHORT.segments, 1.0)], force, control).unwrap();
    let mut terms = SHORT.interactions();
    terms.push(Box::new(load));
    (state, terms)
}

/// `L F / S3` at any tension. Beyond the critical tension of the next test the stiffness has
/// negative eigenvalues, which loads along the axis do not meet. In other directions rounding may
/// lead off the saddle.
#[test]
fn a_straight_rod_stretches_linearly_at_any_tension() {
    for (force, is_saddle) in [(1e2, false), (3e4, false), (1e5, true), (1e6, true)] {
        for tilt in [0.0_f64, 0.9, -2.0] {
            let is_exact = !is_saddle || tilt.abs() < 0.5;
            let turn = UnitQuaternion::from_scaled_axis(Vector3::new(0.3, -0.2, 0.9) * tilt);
            let (mut state, terms) = pulled(force, turn);
            let found = SHORT.newton(&state).solve(&mut state, &terms).unwrap();
            let (tip, steps) = (SHORT.tip(&state), found.history.len());
            let (strain, exact) = (tip.norm() / SHORT.length - 1.0, force / ACTIN.shear.z);
            let is_at_floor = found.ending == Convergence::FloorReached;
            assert!(is_at_floor || found.residual.force <= 1e-8, "{force}");
            assert!(steps <= 150 || is_at_floor, "{force}: {steps}");
            let is_straight = (strain - exact).abs() < 1e-12 * (1.0 + exact);
            assert!(is_straight || !is_exact, "{force}: {strain}");
            assert_eq!(found.is_saddle(), is_saddle && is_straight, "{force}");
            let aside = tip.cross(&(turn * Vector3::z()));
            let is_aligned = aside.norm() < 1e-9 * tip.norm();
            assert!(is_aligned || !is_straight, "{force}: {aside}");
        }
    }
}

/// Shear instability beyond `F* = S1 S3 / (S3 - S1)` (3.0e4 pN). The frames rotate to
/// `cos(theta) = F* / F`, and the tip moves along the force by `F / S1` of the length. With the
/// force `n`, `r' = Q (e3 + S^-1 Q^T n)` and `B theta'' = F sin(theta) (1 - F cos(theta) / F*)`.
#[test]
fn a_rod_under_great_tension_turns_its_frames() {
    let [shear, stretch] = [ACTIN.shear.x, ACTIN.shear.z];
    let critical = shear * stretch / (stretch - shear);
    for (share, negative) in [(0.999, false), (1.01, true)] {
        let (mut state, terms) = pulled(share * critical, UnitQuaternion::identity());
        let found = SHORT.newton(&state).solve(&mut state, &terms).unwrap();
        let certificate = found.certificate.unwrap();
        assert_eq!(certificate.negative > 0, negative, "{certificate:?}");
        assert_eq!(certificate.negative % 2, 0, "{certificate:?}");
    }
    let force = 1e5;
    let (mut state, terms) = pulled(force, UnitQuaternion::identity());
    let found = SHORT.newton(&state).minimize(&mut state, &terms, 3);
    let found = found.unwrap();
    let tangent = state.frames.orientation.get(SHORT.segments) * Vector3::z();
    let last = SHORT.tip(&state) - state.points.position.get(SHORT.segments - 1);
    println!(
        "{} saddles, {} steps, {:?}: cosine {}, segment {}",
        found.saddles_left,
        found.history.len(),
        found.certificate.unwrap().stability(),
        tangent.z,
        last.norm()
    );
    assert!(found.saddles_left >= 1 && !found.is_saddle());
    // Rotations decay by a factor of a thousand per segment.
    assert!((tangent.z - critical / force).abs() < 1e-3);
    assert!((last.norm() / 10.0 - force / shear).abs() < 1e-3);
}

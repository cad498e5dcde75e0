//! Michell's ring: a closed twisted rod buckles out of its plane.

use super::common::{PRECISION, frame, material, point, to};
use crate::theory::{bisect, second_order_limit};
use actin_cosserat::{RodElements, RodJoint, RodSegment};
use actin_equilibrium::{Layout, Newton};
use actin_mechanics::{Interaction, State, UnitQuaternion, Vector3, rotation};
use std::f64::consts::TAU;

const RATIO: f64 = 1.5;

/// Straight rod of length 2 pi and unit bending rigidity, bent to a ring of `n` segments and closed
/// with a twist of `twist` (rad).
fn ring(n: usize, twist: f64) -> (State, Vec<Box<dyn Interaction>>) {
    let h = TAU / n as f64;
    let radius = 0.5 * h / (0.5 * h).sin();
    let none = UnitQuaternion::identity();
    let mut state = State::default();
    let (mut segments, mut joints) = (Vec::new(), Vec::new());
    for k in 0..n {
        let angle = h * k as f64;
        point(
            &mut state,
            Vector3::new(1.0 - angle.cos(), 0.0, angle.sin()) * radius,
        );
        let around = rotation::exp(Vector3::y() * (angle + 0.5 * h));
        let spin = rotation::exp(Vector3::z() * (twist * k as f64 / n as f64));
        frame(&mut state, around * spin);
    }
    for k in 0..n {
        let neighbours = [k, (k + 1) % n];
        segments.push(RodSegment {
            points: neighbours,
            frame: k,
            rest_length: h,
        });
        // At the closure the first frame appears rotated by the twist.
        let closing = rotation::exp(Vector3::z() * twist);
        let seen = if k + 1 == n { closing } else { none };
        joints.push(RodJoint {
            frames: neighbours,
            rest_distance: h,
            offsets: [none, seen],
        });
    }
    // Removes rigid motions except the rotation about the centre line.
    state.points.hold(0);
    state.frames.hold(0);
    let material = material([1e6; 3], [1.0, 1.0, 1.0 / RATIO]);
    let ring = RodElements::new(material, segments, joints).unwrap();
    (state, vec![Box::new(ring)])
}

/// The ring is unstable beyond a twist of `2 pi sqrt(3) B / B3`. Source: Michell (1889).
#[test]
fn a_twisted_ring_leaves_its_plane() {
    let exact = TAU * 3.0_f64.sqrt() * RATIO;
    let values = [32, 64, 128].map(|n| {
        let is_unstable = |twist: f64| {
            let (mut state, terms) = ring(n, twist);
            let mut newton = Newton::new(Layout::free(&state), to(1e-9)).unwrap();
            let flat: f64 = terms.iter().map(|term| term.energy(&state)).sum();
            let found = newton.solve(&mut state, &terms).unwrap();
            // Round-off leads out of the plane to a figure of eight, which has a third of the
            // energy.
            found.is_saddle() || found.energy < 0.8 * flat
        };
        bisect(is_unstable, [0.9 * exact, 1.1 * exact], PRECISION)
    });
    let limit = second_order_limit("Michell's ring", values, exact, 0.1);
    assert!(limit.abs() < 1e-4, "{limit:e}");
}

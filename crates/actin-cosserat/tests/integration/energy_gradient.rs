//! Analytic states of the gradient law.

use crate::common;
use actin_cosserat::{End, EnergyGradient, Rigidities, RodLayout, RodMaterial, StraightRod};
use actin_mechanics::testing::loads_of;
use actin_mechanics::{Interaction, State, Vector3, rotation};
use common::ALL_WALLS;
use std::f64::consts::TAU;

fn table4() -> RodMaterial {
    RodMaterial::new(Rigidities::table4()).unwrap()
}

/// 16 segments of 10 nm along z.
fn actin_rod() -> (State, RodLayout) {
    let mut state = State::default();
    let layout = StraightRod::uniform(16, 10.0).push(&mut state).unwrap();
    (state, layout)
}

fn assert_only_end_couples(state: &State, layout: &RodLayout, couple: Vector3) {
    let law = EnergyGradient::new(layout.clone(), table4());
    let loads = loads_of(&law, state);
    for (i, torque) in loads.torque.iter().enumerate() {
        let expected = if i == layout.end_frame(End::Start) {
            couple
        } else if i == layout.end_frame(End::End) {
            -couple
        } else {
            Vector3::zeros()
        };
        // Differences of torques of 1e3 pN nm, and forces of round-off over 10 nm.
        assert!((torque - expected).norm() < 1e-9, "frame {i}: {torque}");
    }
    for force in loads.force.iter() {
        assert!(force.norm() < 1e-9, "{force}");
    }
}

#[test]
fn uniform_twist() {
    let (mut state, layout) = actin_rod();
    let twist = 0.02;
    for (k, frame) in layout.frames().enumerate() {
        let q = rotation::exp(Vector3::z() * (twist * 10.0 * k as f64));
        state.frames.orientation.set(frame, q);
    }
    assert_only_end_couples(&state, &layout, Vector3::z() * (1.3e4 * twist));
}

#[test]
fn an_end_moment_closes_a_circle() {
    let (mut state, layout) = actin_rod();
    let n = layout.segments();
    let mut position = Vector3::zeros();
    for (k, (point, frame)) in layout.points().zip(layout.frames()).enumerate() {
        let q = rotation::exp(Vector3::x() * (TAU * k as f64 / n as f64));
        state.frames.orientation.set(frame, q);
        position += q * Vector3::z() * 10.0;
        state.points.position.set(point + 1, position);
    }
    assert!(position.norm() < 1e-12, "the circle closes");
    let moment = TAU * 3.9e4 / layout.length();
    assert_only_end_couples(&state, &layout, Vector3::x() * moment);
}

#[test]
fn uniform_stretch() {
    let (mut state, layout) = actin_rod();
    for i in 0..state.points.len() {
        let stretched = 1.01 * state.points.position.get(i);
        state.points.position.set(i, stretched);
    }
    let law = EnergyGradient::new(layout, table4());
    let loads = loads_of(&law, &state);
    for (i, force) in loads.force.iter().enumerate() {
        let expected = match i {
            0 => 340.0,
            16 => -340.0,
            _ => 0.0,
        };
        // Positions of 160 nm are accurate to 3e-14 nm, times S3 over 10 nm.
        assert!((force - Vector3::z() * expected).norm() < 1e-8);
    }
    assert!((law.energy(&state) - 0.5 * 3.4e4 * 1e-4 * 160.0).abs() < 1e-8);
}

/// Shear g: force S1 g, torque |l| x S sigma = S1 g |lhat| about +y to first order.
#[test]
fn simple_shear() {
    let mut state = State::default();
    let layout = StraightRod::uniform(1, 10.0).push(&mut state).unwrap();
    state.points.position.add(1, Vector3::x() * 0.1);
    let law = EnergyGradient::new(layout, table4());
    let loads = loads_of(&law, &state);
    assert!((loads.force.get(0) - Vector3::x() * 160.0).norm() < 1e-9);
    assert!((loads.torque.get(0) - Vector3::y() * 1600.0).norm() < 1e-9);
}

#[test]
fn walls_bend_over_half_a_segment() {
    let mut state = State::default();
    let rod = StraightRod {
        walls: ALL_WALLS[1],
        ..StraightRod::uniform(2, 10.0)
    };
    let layout = rod.push(&mut state).unwrap();
    let [wall, first, second] = [0, 1, 2];
    let turn = rotation::exp(Vector3::y() * 0.01);
    state.frames.orientation.set(first, turn);
    let law = EnergyGradient::new(layout, table4());
    let loads = loads_of(&law, &state);
    let couple = |frame: usize| loads.torque.get(frame).y;
    assert!((couple(wall) - 3.9e4 * 0.01 / 5.0).abs() < 1e-9);
    assert!((couple(second) - 3.9e4 * 0.01 / 10.0).abs() < 1e-9);
}

#[test]
fn energies_are_in_the_order_of_the_elements() {
    let (mut state, layout) = actin_rod();
    state.points.position.add(16, Vector3::z() * 0.01);
    let last = layout.end_frame(End::Start);
    let turned = rotation::exp(Vector3::z() * 0.01);
    state.frames.orientation.set(last, turned);
    let law = EnergyGradient::new(layout, table4());
    let mut energies = vec![f64::NAN; law.elements()];
    law.write_energies(&state, &mut energies);
    assert_eq!(energies.len(), 31);
    for (i, energy) in energies.iter().enumerate() {
        let expected = match i {
            15 => 0.5 * 3.4e4 * 1e-6 * 10.0,
            16 => 0.5 * 1.3e4 * 1e-6 * 10.0,
            _ => 0.0,
        };
        assert!((energy - expected).abs() < 1e-9, "element {i}");
    }
}

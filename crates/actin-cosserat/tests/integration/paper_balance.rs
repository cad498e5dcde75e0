//! Printed law: agreement with the gradient law to first order, and violated balances.

use crate::common;
use actin_cosserat::{EnergyGradient, PaperBalance, Rigidities, RodMaterial, StraightRod};
use actin_mechanics::testing::{loads_of, resultant};
use actin_mechanics::{Interaction, Loads, State, Vector3, rotation};
use actin_mechanics::{Xorshift, perturb};
use common::{ALL_WALLS, material, rod, strained_rod};

/// Relative norm of the difference of loads: maximum over forces and torques.
fn relative_difference(a: &Loads, b: &Loads) -> f64 {
    let difference = |a: &actin_mechanics::Vectors, b: &actin_mechanics::Vectors| {
        let squares = a.iter().zip(b.iter()).map(|(a, b)| (a - b).norm_squared());
        let scale: f64 = b.iter().map(|b| b.norm_squared()).sum();
        (squares.sum::<f64>() / scale).sqrt()
    };
    difference(&a.force, &b.force).max(difference(&a.torque, &b.torque))
}

#[test]
fn the_difference_of_the_laws_is_of_the_order_of_the_strain() {
    for walls in ALL_WALLS {
        for segments in [1, 2, 6] {
            let difference = |strain: f64| {
                let mut noise = Xorshift::new(11);
                let (mut state, layout) = rod(segments, walls, &mut noise);
                perturb(&mut state, &mut noise, 10.0 * strain, strain);
                let gradient = EnergyGradient::new(layout.clone(), material());
                let printed = PaperBalance::new(layout, material()).unwrap();
                relative_difference(&loads_of(&printed, &state), &loads_of(&gradient, &state))
            };
            let (coarse, fine) = (difference(2e-4), difference(1e-4));
            assert!(coarse > 1e-5 && coarse < 2e-3, "{coarse}");
            // Second-order terms are 1e-3 times first-order terms.
            assert!((coarse / fine - 2.0).abs() < 0.02, "{}", coarse / fine);
        }
    }
}

#[test]
fn forces_balance_and_shear_keeps_angular_momentum() {
    let mut noise = Xorshift::new(12);
    for walls in ALL_WALLS {
        let (state, layout) = strained_rod(5, walls, &mut noise);
        let loads = loads_of(&PaperBalance::new(layout, material()).unwrap(), &state);
        let scale: f64 = loads.force.iter().map(|f| f.norm()).sum();
        let (force, _) = resultant(&state, &loads);
        assert!(force.norm() < 1e-14 * scale);
    }
    let (state, layout) = strained_rod(1, ALL_WALLS[0], &mut noise);
    let loads = loads_of(&PaperBalance::new(layout, material()).unwrap(), &state);
    let (_, torque) = resultant(&state, &loads);
    assert!(torque.norm() < 1e-13 * loads.torque.get(1).norm());
}

fn residual_torque(theta: Vector3) -> Vector3 {
    let mut state = State::default();
    let layout = StraightRod::uniform(2, 10.0).push(&mut state).unwrap();
    let q = rotation::exp(theta);
    state.frames.orientation.set(1, q);
    let tip = state.points.position.get(1) + q * Vector3::z() * 10.0;
    state.points.position.set(2, tip);
    let loads = loads_of(&PaperBalance::new(layout, material()).unwrap(), &state);
    resultant(&state, &loads).1
}

/// The printed torques are truncated after the first power of the angle: residual theta x (theta x
/// (theta x m)) / 12.
#[test]
fn couples_balance_up_to_the_third_power_of_the_angle() {
    let theta = Vector3::new(0.04, 0.02, 0.05);
    let m = material().bending_couple(theta / 10.0);
    let expected = theta.cross(&theta.cross(&theta.cross(&m))) / 12.0;
    let torque = residual_torque(theta);
    assert!((torque - expected).norm() < 0.6 * theta.norm() * expected.norm());
    // The residual vanishes for torques parallel to the angle.
    for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
        assert!(residual_torque(axis * 0.5).norm() < 1e-9);
    }
}

/// Two segments along their frames, stretched by `e` and bent by `angle`.
fn bent_and_stretched(e: f64, angle: f64) -> State {
    let mut state = State::default();
    StraightRod::uniform(2, 10.0).push(&mut state).unwrap();
    let mut position = Vector3::zeros();
    for (k, sign) in [-0.5, 0.5].into_iter().enumerate() {
        let q = rotation::exp(Vector3::x() * (sign * angle));
        state.frames.orientation.set(k, q);
        position += q * Vector3::z() * (10.0 * e);
        state.points.position.set(k + 1, position);
    }
    state
}

/// Work of the loads along a path, by the midpoint rule.
fn work(law: &dyn Interaction, corners: &[(f64, f64)]) -> f64 {
    const STEPS: u32 = 200;
    let mut work = 0.0;
    for pair in corners.windows(2) {
        let at = |t: f64| {
            bent_and_stretched(
                pair[0].0 + t * (pair[1].0 - pair[0].0),
                pair[0].1 + t * (pair[1].1 - pair[0].1),
            )
        };
        for step in 0..STEPS {
            let t = |offset: f64| (f64::from(step) + offset) / f64::from(STEPS);
            let (before, middle, after) = (at(t(0.0)), at(t(0.5)), at(t(1.0)));
            let loads = loads_of(law, &middle);
            for i in 0..3 {
                let moved = after.points.position.get(i) - before.points.position.get(i);
                work += loads.force.get(i).dot(&moved);
            }
            for i in 0..2 {
                let q = &before.frames.orientation.get(i);
                let turned = rotation::log(q.inverse() * after.frames.orientation.get(i));
                work += loads.torque.get(i).dot(&turned);
            }
        }
    }
    work
}

/// Cycle of stretch and bend: the printed law has a net work of (1 - 1/e^3) of the bending energy.
#[test]
fn a_closed_loop_of_strains_does_net_work() {
    let (e, angle) = (1.01, 0.1);
    let corners = [(1.0, 0.0), (e, 0.0), (e, angle), (1.0, angle), (1.0, 0.0)];
    let mut state = State::default();
    let layout = StraightRod::uniform(2, 10.0).push(&mut state).unwrap();
    let material = RodMaterial::new(Rigidities::table4()).unwrap();
    let bending_energy = 0.5 * 3.9e4 * angle * angle / 10.0;

    let printed = work(
        &PaperBalance::new(layout.clone(), material).unwrap(),
        &corners,
    );
    let expected = bending_energy * (1.0 - e.powi(-3));
    // Second order in the step of 1/200: 1e-5 relative.
    assert!((printed / expected - 1.0).abs() < 1e-4, "{printed}");
    assert!((expected / bending_energy - 0.0294).abs() < 1e-4);

    let gradient = work(&EnergyGradient::new(layout, material), &corners);
    assert!(gradient.abs() < 1e-6 * bending_energy, "{gradient}");
}

#[test]
fn it_is_not_conservative_and_has_the_printed_energy() {
    let mut noise = Xorshift::new(13);
    let (state, layout) = strained_rod(4, ALL_WALLS[3], &mut noise);
    let gradient = EnergyGradient::new(layout.clone(), material());
    let printed = PaperBalance::new(layout, material()).unwrap();
    assert!(gradient.is_conservative() && !printed.is_conservative());
    assert!(gradient.second_order().is_some() && printed.second_order().is_none());
    assert_eq!(
        gradient.energy(&state).to_bits(),
        printed.energy(&state).to_bits()
    );
}

#[test]
fn extension_of_a_bending_element_is_that_of_its_own_segments() {
    let walls = ALL_WALLS[3];
    let rod = StraightRod {
        walls,
        ..StraightRod::uniform(2, 10.0)
    };
    let mut state = State::default();
    let layout = rod.push(&mut state).unwrap();
    // Uniform twist; the first segment is stretched to e = 1.2.
    for frame in 0..4 {
        let q = rotation::exp(Vector3::z() * [0.0, 0.05, 0.15, 0.2][frame]);
        state.frames.orientation.set(frame, q);
    }
    for point in [1, 2] {
        state.points.position.add(point, Vector3::z() * 2.0);
    }
    let law = PaperBalance::new(layout, RodMaterial::new(Rigidities::table4()).unwrap()).unwrap();
    let torque = loads_of(&law, &state).torque;
    let couple = 1.3e4 * 0.01;
    let [at_wall, inside, far_wall] = [1.2_f64, 1.1, 1.0].map(|e| couple / e.powi(3));
    for (frame, expected) in [at_wall, inside - at_wall, far_wall - inside, -far_wall]
        .into_iter()
        .enumerate()
    {
        assert!(
            (torque.get(frame).z - expected).abs() < 1e-9,
            "frame {frame}"
        );
    }
}

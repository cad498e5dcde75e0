use crate::common;
use actin_integrate::{Composition, Drag, PEFRL, Run, VEFRL, advance};
use actin_mechanics::testing::Loading;
use actin_mechanics::testing::{push_frame, push_point};
use actin_mechanics::{Loads, Slider, State, System, UnitQuaternion, Vector3, rotation};
use common::{distance, spinning_tops, springs, three_tops};

fn free_bodies() -> System {
    let mut state = State::default();
    for _ in 0..2 {
        push_point(&mut state, Vector3::zeros(), 0.07);
    }
    state.points.hold(1);
    state.points.velocity.set(0, Vector3::new(1.0, -2.0, 3.0));
    state.points.velocity.set(1, Vector3::y());
    push_frame(&mut state, UnitQuaternion::identity(), [1.0, 1.0, 2.0]);
    let l = Vector3::new(0.5, 0.2, -0.4);
    state.frames.angular_momentum.set(0, l);
    System::new(state, Vec::new())
}

/// v(t) = v(0) exp(-gamma t) at any step with both rates; a driven body keeps its velocity.
#[test]
fn free_motion_decays_exponentially_at_any_step() {
    let drag = Drag::new(2.0, 3.0).unwrap();
    for scheme in Composition::all() {
        for (h, steps) in [(0.001, 1000), (0.1, 10), (1.0, 1)] {
            let mut system = free_bodies();
            let start = system.state().clone();
            advance(&mut system, scheme, h, steps, &drag);
            let v = system.state().points.velocity.get(0);
            let v_start = start.points.velocity.get(0);
            // One rounding error per step.
            assert!((v / (-2.0f64).exp() - v_start).norm() < 1e-13 * v_start.norm());
            // The top precesses about its axis; the magnitude decays.
            let l = system.state().frames.angular_momentum.get(0).norm();
            let l_start = start.frames.angular_momentum.get(0).norm();
            assert!((l / (-3.0f64).exp() / l_start - 1.0).abs() < 1e-12);
            assert_eq!(system.state().points.velocity.get(1), Vector3::y());
            // The driven body moves in its own time.
            let moved = system.state().points.position.get(1) - Vector3::y();
            assert!(moved.norm() < 1e-12, "{moved:?}");
        }
    }
}

const MASS: f64 = 0.07;
const AXIAL: f64 = 2.0;

/// A free point, a slider of two points along z with mass 0.3, and a top under loads along z, at
/// their terminal velocities at the end of a step.
fn driven_bodies(force: f64, torque: f64, drag: &Drag, h: f64) -> System {
    let mut state = State::default();
    for _ in 0..3 {
        let position = Vector3::zeros();
        let mass = MASS;
        push_point(&mut state, position, mass);
    }
    (1..3).for_each(|i| state.points.hold(i));
    state.sliders.push(Slider {
        points: vec![1, 2],
        directions: vec![Vector3::z()],
        mass: 0.3,
    });
    push_frame(&mut state, UnitQuaternion::identity(), [1.0, 1.0, AXIAL]);
    let (translation, rotation) = drag.recorded_drift(h);
    let speed = translation * force / drag.translational();
    for (i, speed) in [speed / MASS, 2.0 * speed / 0.3, 2.0 * speed / 0.3]
        .into_iter()
        .enumerate()
    {
        state.points.velocity.set(i, Vector3::z() * speed);
    }
    let momentum = rotation * torque / drag.rotational();
    state
        .frames
        .angular_momentum
        .set(0, Vector3::z() * momentum);
    let add = move |state: &State, loads: &mut Loads| {
        (0..state.points.len()).for_each(|i| loads.force.add(i, Vector3::z() * force));
        loads.torque.add(0, Vector3::z() * torque);
    };
    let term = "constant";
    System::new(state, vec![Box::new(Loading { term, add })])
}

/// Terminal displacement `F h/(m gamma)` per step for rates from 1e-3 to 1e4 per ns. Without
/// rescaling the last would be 15 times too large.
#[test]
fn terminal_motion_is_exact_at_any_step() {
    let (h, steps) = (0.003, 100);
    for scheme in Composition::all() {
        for (translational, rotational) in [(1e-3, 1e4), (1.0, 1e3), (1e2, 10.0), (1e4, 0.1)] {
            let drag = Drag::new(translational, rotational).unwrap();
            // The total rotation is 0.3 rad.
            let (force, torque) = (2.0, rotational * AXIAL);
            let mut system = driven_bodies(force, torque, &drag, h);
            let start = system.state().clone();
            advance(&mut system, scheme, h, steps, &drag);
            let (t, state) = (h * steps as f64, system.state());
            let z = |i: usize| state.points.position.get(i).z;
            let expected = force * t / (MASS * translational);
            let of_slider = 2.0 * force * t / (0.3 * translational);
            for (z, expected) in [(z(0), expected), (z(1), of_slider), (z(2), of_slider)] {
                assert!(
                    (z / expected - 1.0).abs() < 1e-12,
                    "{scheme}, {translational}: {z}"
                );
            }
            let turn = rotation::log(state.frames.orientation.get(0)).z;
            assert!(
                (turn / t - 1.0).abs() < 1e-12,
                "{scheme}, {rotational}: {turn}"
            );
            // The velocities at the ends of steps are stationary.
            let (before, after) = (&start.points.velocity, &state.points.velocity);
            assert!((after.z[0] - before.z[0]).abs() <= 1e-12 * before.z[0]);
        }
    }
}

/// Relaxation rate (1/ns) of a point on a spring of frequency `omega`, after the decay of the fast
/// mode.
fn relaxation(scheme: &Composition, gamma: f64, omega: f64, h: f64, rate: f64) -> f64 {
    let mut state = State::default();
    for _ in 0..2 {
        let (position, mass) = (Vector3::zeros(), 1.0);
        push_point(&mut state, position, mass);
    }
    state.points.hold(0);
    state.points.position.set(1, Vector3::x());
    let spring = springs(&state, omega * omega, 0.0);
    let mut system = System::new(state, vec![Box::new(spring)]);
    let drag = Drag::new(gamma, 0.0).unwrap();
    // The fast mode is then below 1e-13 of the slow one.
    let gap = gamma - 2.0 * rate;
    let steps_of = |time: f64| Run::from_duration(&PEFRL, h, time).unwrap().steps();
    let warm = steps_of(30.0 / gap);
    let steps = steps_of((1.0 / rate).min(3000.0 * h));
    advance(&mut system, scheme, h, warm, &drag);
    let before = system.state().points.position.get(1).x;
    advance(&mut system, scheme, h, steps, &drag);
    let after = system.state().points.position.get(1).x;
    (before / after).ln() / (steps as f64 * h)
}

/// Overdamped modes relax at the rate `r = g/2 - sqrt(g^2/4 - omega^2)` with a relative error of
/// `r h/2`.
#[test]
fn modes_relax_at_their_rate_at_any_drag() {
    let h = 1.0;
    for scheme in Composition::all() {
        for gamma in [0.1f64, 1.0, 10.0, 100.0, 1000.0] {
            for omega in [0.03, 0.1, 0.4, 1.0] {
                if gamma < 2.2 * omega {
                    continue;
                }
                let rate =
                    2.0 * omega * omega / (gamma + (gamma * gamma - 4.0 * omega * omega).sqrt());
                let error = relaxation(scheme, gamma, omega, h, rate) / rate - 1.0;
                println!(
                    "{scheme}, g h {gamma}, omega h {omega}: r h {rate:.1e}, error {error:.1e} = \
                     {:.2} r h",
                    error / rate
                );
                // Rounding errors of differences of logarithms over few digits of decay.
                assert!(
                    error.abs() < 0.5 * rate * h + 1e-8,
                    "{scheme}, {gamma}, {omega}"
                );
            }
        }
    }
}

#[test]
fn steps_with_drag_are_symmetric_in_time() {
    for (translational, rotational) in [(0.3, 40.0), (40.0, 0.3)] {
        let drag = Drag::new(translational, rotational).unwrap();
        for scheme in Composition::all() {
            let mut system = spinning_tops();
            let start = system.state().clone();
            advance(&mut system, scheme, 0.1, 2, &drag);
            assert!(distance(system.state(), &start) > 0.1);
            advance(&mut system, scheme, -0.1, 2, &drag);
            let error = distance(system.state(), &start);
            // Rounding errors times exp(8).
            assert!(error < 1e-10, "{scheme}: {error:e}");
        }
    }
}

/// A damped oscillation has order 2, due to the alternation of drag and motion.
#[test]
fn damped_motion_is_of_second_order() {
    let drag = Drag::new(0.4, 0.7).unwrap();
    for scheme in [PEFRL, VEFRL] {
        let end = |steps: u32| {
            let mut system = three_tops();
            advance(
                &mut system,
                &scheme,
                2.0 / f64::from(steps),
                steps.into(),
                &drag,
            );
            system.state().clone()
        };
        let reference = end(8000);
        let order = (distance(&end(40), &reference) / distance(&end(80), &reference)).log2();
        println!("{scheme} with drag: order {order:.3}");
        assert!((order - 2.0).abs() < 0.05, "{scheme}: {order}");
    }
}

/// Calls differ by rounding in exp(-gamma h/2)^2 and in merged drifts.
#[test]
fn two_halves_are_one_whole() {
    for drag in [Drag::NONE, Drag::new(0.3, 0.2).unwrap()] {
        for scheme in Composition::all() {
            let (mut whole, mut halves) = (three_tops(), three_tops());
            advance(&mut whole, scheme, 0.05, 100, &drag);
            advance(&mut halves, scheme, 0.05, 50, &drag);
            advance(&mut halves, scheme, 0.05, 50, &drag);
            let error = distance(whole.state(), halves.state());
            assert!(error < 1e-13, "{scheme}: {error:e}");
        }
    }
}

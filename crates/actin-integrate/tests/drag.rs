//! Drag is exact, and leaves equilibria where they are.

mod common;

use actin_integrate::{
    Composition, Drag, PEFRL, POSITION_VERLET, Reason, Run, StopRule, VEFRL, advance,
};
use actin_mechanics::{Frame, Inertia, Point, State, System, UnitQuaternion, Vector3};
use common::{chain, distance, three_tops};

/// A free point and a free top in motion, and a driven point.
fn free_bodies() -> System {
    let mut state = State::default();
    for _ in 0..2 {
        state.points.push(Point {
            position: Vector3::zeros(),
            mass: 0.07,
        });
    }
    state.points.hold(1);
    state.points.velocity.set(0, Vector3::new(1.0, -2.0, 3.0));
    state.points.velocity.set(1, Vector3::y());
    state.frames.push(Frame {
        orientation: UnitQuaternion::identity(),
        inertia: Inertia::from_moments([1.0, 1.0, 2.0]).unwrap(),
    });
    let l = Vector3::new(0.5, 0.2, -0.4);
    state.frames.angular_momentum.set(0, l);
    System::new(state, Vec::new())
}

/// v(t) = v(0) exp(-gamma t) at any step, the two rates apart; a driven body keeps its speed.
/// Drag inside sub-steps, or as a force, would miss by the square of gamma h.
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
            // One rounding per step.
            assert!((v / (-2.0f64).exp() - v_start).norm() < 1e-13 * v_start.norm());
            // The top precesses about its axis: the length decays.
            let l = system.state().frames.angular_momentum.get(0).norm();
            let l_start = start.frames.angular_momentum.get(0).norm();
            assert!((l / (-3.0f64).exp() / l_start - 1.0).abs() < 1e-12);
            assert_eq!(system.state().points.velocity.get(1), Vector3::y());
        }
    }
}

/// Of two runs to rest with a tenfold difference in drag, and of unlike drag on places and turns,
/// both end in the same state. Drag within the step would shift the equilibrium by gamma h.
#[test]
fn equilibrium_does_not_depend_on_the_drag() {
    let rest = |translational, rotational, h| {
        let mut system = chain(6, 4.0, 1.0);
        let displaced = Vector3::new(0.2, 0.3, -0.1);
        system.state_mut().points.position.add(5, displaced);
        let outcome = Run::new(&PEFRL, h, 100_000)
            .unwrap()
            .with_drag(Drag::new(translational, rotational).unwrap())
            .with_stop_rule(StopRule::new(1e-12, 1e-12, 1e-20).unwrap())
            .execute(&mut system, &mut [])
            .unwrap();
        assert_eq!(outcome.reason, Reason::Converged);
        assert!(outcome.residual.force <= 1e-12 && outcome.kinetic <= 1e-20);
        system
    };
    let reference = rest(0.3, 0.3, 0.2);
    for (translational, rotational, h) in [(3.0, 0.3, 0.2), (0.3, 3.0, 0.1), (1.0, 1.0, 0.5)] {
        let other = rest(translational, rotational, h);
        // Residual 1e-12 over the smallest stiffness, of the chain's transverse modes (0.03).
        assert!(distance(reference.state(), other.state()) < 1e-10);
    }
}

/// A damped oscillation of rate gamma/2 and shifted frequency is followed to second order: the
/// alternation of drag and motion costs the fourth, as documented.
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

/// Two halves differ from the whole by round-off, in exp(-gamma h/2)^2 and in merged drifts.
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

/// With one step per call nothing is merged and nothing differs, to the last bit.
#[test]
fn single_steps_are_reproducible_to_the_bit() {
    let run = || {
        let mut system = three_tops();
        for _ in 0..50 {
            advance(&mut system, &POSITION_VERLET, 0.05, 1, &Drag::NONE);
        }
        system.state().clone()
    };
    assert_eq!(run(), run());
}

//! Paths of controls.

use crate::common;
use actin_equilibrium::{
    Jumps, Layout, Newton, NewtonOptions, Path, PathEnd, PathError, PathFailure, PathOptions,
    PathPoint, Saddles,
};
use actin_mechanics::{Interaction, PointLoad, State, Vector3, rotation};
use common::{ACTIN, Rod, point, push_slider, springs};
use std::f64::consts::PI;
use std::ops::ControlFlow;

type Terms = Vec<Box<dyn Interaction>>;

const RISE: f64 = 2.0;

/// Two bars with half span 10 nm. The top moves vertically under `force` at control 1.
fn arch(rise: f64, force: f64) -> (State, Terms, Newton) {
    let mut state = State::default();
    for x in [-10.0, 10.0] {
        let i = point(&mut state, Vector3::x() * x);
        state.points.hold(i);
    }
    point(&mut state, Vector3::y() * rise);
    let control = state.add_control(0.0);
    let rest = rise.hypot(10.0);
    let springs = springs(&state, vec![(0, 2, 50.0, rest), (1, 2, 50.0, rest)]);
    let load = PointLoad::new(&state, vec![(2, 1.0)], Vector3::y() * -force, control).unwrap();
    push_slider(&mut state, vec![2], vec![Vector3::y()]);
    let newton = Newton::new(Layout::free(&state), NewtonOptions::default()).unwrap();
    (state, vec![springs, Box::new(load)], newton)
}

/// The maximum is at `L^3 = L0 a^2`.
fn arch_force(rise: f64, y: f64) -> f64 {
    let length = (100.0 + y * y).sqrt();
    2.0 * 50.0 * (rise.hypot(10.0) / length - 1.0) * y
}

fn arch_limit(rise: f64) -> (f64, f64) {
    let length = (rise.hypot(10.0) * 100.0).cbrt();
    let y = (length * length - 100.0).sqrt();
    (y, arch_force(rise, y))
}

fn followed<T>(
    options: PathOptions,
    (newton, state, terms): (&mut Newton, &mut State, &Terms),
    drive: &mut dyn FnMut(&mut State, f64),
    see: impl Fn(&PathPoint<'_>) -> T,
) -> (Result<PathEnd, Box<PathFailure>>, Vec<T>) {
    let mut seen = Vec::new();
    let path = Path::new(options).unwrap();
    let end = path.follow(newton, state, terms, &mut |s, t| drive(s, t), &mut |p| {
        seen.push(see(p));
        ControlFlow::Continue(())
    });
    (end, seen)
}

fn proportional(state: &mut State, parameter: f64) {
    let control = state.controls.ids().next().unwrap();
    state.controls[control] = parameter;
}

#[test]
fn a_limit_point_ends_the_path() {
    let (y, limit) = arch_limit(RISE);
    let (mut state, terms, mut newton) = arch(RISE, 2.0 * limit);
    let solver = (&mut newton, &mut state, &terms);
    let (end, _) = followed(PathOptions::default(), solver, &mut proportional, |_| ());
    let failure = end.unwrap_err();
    // The limit is at one half.
    assert!(
        failure.parameter <= 0.5 && failure.parameter > 0.5 - 2e-4,
        "{failure}"
    );
    assert!(matches!(failure.cause, PathError::Jump(_)), "{failure}");
    let reached = state.points.position.get(2).y;
    assert!(reached > y && reached < y + 0.05, "{reached}");
    assert!((arch_force(RISE, reached) - failure.parameter * 2.0 * limit).abs() < 1e-7);
    let last = failure.equilibrium.as_ref().unwrap();
    assert!(!last.is_saddle());
    let message = failure.to_string();
    assert!(message.starts_with("the path ends at 0.4999"), "{message}");
    assert!(
        message.contains("the next equilibrium is far away"),
        "{message}"
    );
}

#[test]
fn a_jump_may_be_accepted() {
    let (_, limit) = arch_limit(RISE);
    let (mut state, terms, mut newton) = arch(RISE, 2.0 * limit);
    let options = PathOptions {
        jumps: Jumps::Accept,
        ..PathOptions::default()
    };
    let solver = (&mut newton, &mut state, &terms);
    let (end, jumps) = followed(options, solver, &mut proportional, |p| p.jumped);
    assert_eq!(jumps.iter().filter(|jumped| **jumped).count(), 1);
    let y = state.points.position.get(2).y;
    assert!(
        y < -2.0 && (arch_force(RISE, y) - 2.0 * limit).abs() < 1e-7,
        "{y}"
    );
    assert!(!end.unwrap().equilibrium.is_saddle());
}

const COLUMN: Rod = Rod {
    segments: 32,
    bending: Vector3::new(3.9e4, 3.0e4, 1.3e4),
    shear: Vector3::new(1e7, 1e7, 1e7),
    ..ACTIN
};

fn compressed() -> (State, Terms) {
    COLUMN.loaded(Vector3::z() * -6.0, 0.0)
}

#[test]
fn the_euler_load_ends_a_path_that_must_be_stable() {
    let (mut state, terms) = compressed();
    let mut newton = COLUMN.newton(&state);
    let options = PathOptions {
        saddles: Saddles::Stop,
        ..PathOptions::default()
    };
    let solver = (&mut newton, &mut state, &terms);
    let (end, _) = followed(options, solver, &mut proportional, |_| ());
    let failure = end.unwrap_err();
    assert_eq!(failure.cause, PathError::Unstable { negative: 1 });
    let euler = PI.powi(2) * 3.0e4 / (4.0 * 160.0 * 160.0);
    let found = 6.0 * failure.parameter;
    // The discrete load deviates by (pi/64)^2 / 12 = 2e-4; steps of 6e-4 pN.
    assert!((found / euler - 1.0).abs() < 6e-4, "{found} not {euler}");
}

#[test]
fn buckling_is_followed_if_requested() {
    for (saddles, buckled) in [(Saddles::Leave(3), true), (Saddles::Keep, false)] {
        let (mut state, terms) = compressed();
        let mut newton = COLUMN.newton(&state);
        let options = PathOptions {
            saddles,
            ..PathOptions::default()
        };
        let solver = (&mut newton, &mut state, &terms);
        let see = |p: &PathPoint<'_>| (p.parameter, p.equilibrium.saddles_left);
        let (end, seen) = followed(options, solver, &mut proportional, see);
        let (end, left) = (
            end.unwrap(),
            seen.iter().map(|(_, left)| left).sum::<usize>(),
        );
        println!("{saddles:?}: {} points, {:?}", end.points, end.work);
        assert_eq!(end.equilibrium.is_saddle(), !buckled);
        assert_eq!(left > 0, buckled);
        assert_eq!(end.points, seen.len());
        assert!(seen.windows(2).all(|pair| pair[0].0 < pair[1].0));
        assert_eq!(COLUMN.tip(&state).x.abs() > 50.0, buckled);
    }
}

#[test]
fn a_path_can_be_interrupted() {
    let (_, limit) = arch_limit(RISE);
    let (mut state, terms, mut newton) = arch(RISE, 0.5 * limit);
    let mut seen = Vec::new();
    let failure = Path::new(PathOptions::default())
        .unwrap()
        .follow(
            &mut newton,
            &mut state,
            &terms,
            &mut proportional,
            &mut |p| {
                seen.push(p.state.clone());
                if seen.len() == 3 {
                    return ControlFlow::Break(());
                }
                ControlFlow::Continue(())
            },
        )
        .unwrap_err();
    assert_eq!(failure.cause, PathError::Interrupted);
    assert_eq!(failure.points, 3);
    assert_eq!(state, seen[2]);
}

#[test]
fn options_are_checked() {
    let options = PathOptions {
        first_step: 1e-6,
        ..PathOptions::default()
    };
    let message = "first_step must be at least the smallest step, but is 0.000001";
    assert_eq!(Path::new(options).unwrap_err().to_string(), message);
}

/// The motion is too small to be a jump by its size.
#[test]
fn a_small_snap_is_reported() {
    let rise = 0.2;
    let (_, limit) = arch_limit(rise);
    let (mut state, terms, mut newton) = arch(rise, 2.0 * limit);
    let solver = (&mut newton, &mut state, &terms);
    let see = |p: &PathPoint<'_>| p.jumped.then_some(p.parameter);
    let (end, jumps) = followed(PathOptions::default(), solver, &mut proportional, see);
    let (end, jumps) = (
        end.unwrap(),
        jumps.into_iter().flatten().collect::<Vec<_>>(),
    );
    println!("jumps at {jumps:?}, {} steps refused", end.refused);
    assert_eq!(jumps.len(), 1);
    assert!(end.refused <= 8, "{}", end.refused);
    assert!(end.work.iterations < 200, "{:?}", end.work);
    assert!((jumps[0] - 0.5).abs() < 2e-4, "{jumps:?}");
    assert!(state.points.position.get(2).y < -rise);
}

/// The end of a rod abruptly bends in another direction.
#[test]
fn a_change_of_direction_is_not_a_jump() {
    let mut state = ACTIN.state();
    state.frames.hold(16);
    let terms = ACTIN.interactions();
    let mut newton = ACTIN.newton(&state);
    let mut turn_end = |state: &mut State, t: f64| {
        let [first, second] = [t.min(0.5), (t - 0.5).max(0.0)];
        let turn = rotation::exp(Vector3::y() * second) * rotation::exp(Vector3::x() * first);
        state.frames.orientation.set(16, turn);
    };
    let solver = (&mut newton, &mut state, &terms);
    let (end, jumps) = followed(PathOptions::default(), solver, &mut turn_end, |p| p.jumped);
    let end = end.unwrap();
    println!(
        "a kink: {} points, {} steps refused, {:?}",
        end.points, end.refused, end.work
    );
    assert!(!jumps.contains(&true));
    assert!(end.refused <= 11, "{}", end.refused);
}

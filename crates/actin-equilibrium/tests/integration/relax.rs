//! Equilibrium in one call.

use crate::common;
use actin_equilibrium::{
    Coordinates, EquilibriumError, Interaction, Loads, Matrix3, Newton, NewtonOptions, PointLoad,
    SecondOrder, SolveError, State, Stiffness, Vector3, relax,
};
use actin_mechanics::UnitQuaternion;
use common::{ACTIN, Rod, frame, point};

/// Newton's method alone stays on the saddle.
#[test]
fn a_column_under_too_much_force_buckles() {
    let mut state = ACTIN.state();
    let mut terms = ACTIN.interactions();
    let critical = (0.5 * std::f64::consts::PI / ACTIN.length).powi(2) * ACTIN.bending.x;
    let force = Vector3::z() * (-1.5 * critical);
    terms.push(Box::new(PointLoad::at(&mut state, 16, force).unwrap()));
    let mut straight = state.clone();
    let layout = actin_equilibrium::Layout::free(&straight);
    let mut newton = Newton::new(layout, NewtonOptions::default()).unwrap();
    assert!(newton.solve(&mut straight, &terms).unwrap().is_saddle());
    let found = relax(&mut state, &terms).unwrap();
    assert!(found.saddles_left == 1 && !found.is_saddle());
    assert!(ACTIN.tip(&state).xy().norm() > 0.1 * ACTIN.length);
}

/// Unconstrained rod of 8 segments of 5 nm.
const UNCLAMPED: Rod = Rod {
    segments: 8,
    length: 40.0,
    ..ACTIN
};

fn failure(mut state: State, rod: &Rod, force: f64) -> SolveError {
    let mut terms = rod.interactions();
    let load = PointLoad::at(&mut state, rod.segments, Vector3::x() * force).unwrap();
    terms.push(Box::new(load));
    match relax(&mut state, &terms) {
        Err(EquilibriumError::Newton(failure)) => failure.cause,
        other => panic!("{force} pN: {other:?}"),
    }
}

#[test]
fn a_net_load_on_a_rigid_motion_has_no_equilibrium() {
    for force in [1.0, 1e-3] {
        let mut unclamped = State::default();
        for (i, x) in UNCLAMPED.state().points.position.iter().enumerate() {
            assert_eq!(point(&mut unclamped, x), i);
            frame(&mut unclamped, UnitQuaternion::identity());
        }
        assert_eq!(failure(unclamped, &UNCLAMPED, force), SolveError::Unbounded);
    }
}

/// The lowest stiffness is close to rounding.
#[test]
fn a_long_filament_is_not_unbounded() {
    let rod = Rod {
        segments: 400,
        length: 16e3,
        ..ACTIN
    };
    let mut state = rod.state();
    let mut terms = rod.interactions();
    for i in 1..=rod.segments {
        let load = PointLoad::at(&mut state, i, Vector3::x() * 1e-3).unwrap();
        terms.push(Box::new(load));
    }
    let options = NewtonOptions {
        iterations: 2,
        ..NewtonOptions::default()
    };
    let mut newton = Newton::new(rod.layout(&state), options).unwrap();
    let failure = newton.solve(&mut state, &terms).unwrap_err();
    assert_eq!(failure.cause, SolveError::IterationLimit(2));
}

/// `E = -x^n` of a point next to another.
#[derive(Debug)]
struct Hill(i32);

impl Interaction for Hill {
    fn term(&self) -> &'static str {
        "hill"
    }
    fn add_loads(&self, state: &State, loads: &mut Loads) {
        let x = state.points.position.get(0).x;
        let force = f64::from(self.0) * x.powi(self.0 - 1);
        loads.force.add(0, Vector3::x() * force);
    }
    fn elements(&self) -> usize {
        1
    }
    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        energies[0] = -state.points.position.get(0).x.powi(self.0);
    }
    fn second_order(&self) -> Option<&dyn SecondOrder> {
        Some(self)
    }
}

impl SecondOrder for Hill {
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        let x = state.points.position.get(0).x;
        let along = -f64::from(self.0 * (self.0 - 1)) * x.powi(self.0 - 2);
        let block = Matrix3::from_diagonal(&(Vector3::x() * along));
        stiffness.push(Coordinates::Point(0), Coordinates::Point(0), block);
    }
}

#[test]
fn an_energy_without_lower_bound_has_no_equilibrium() {
    for power in [2, 4] {
        let mut state = State::default();
        point(&mut state, Vector3::x());
        point(&mut state, Vector3::x() * 3.0);
        match relax(&mut state, &[Box::new(Hill(power))]) {
            Err(EquilibriumError::Newton(failure)) => {
                assert_eq!(failure.cause, SolveError::Unbounded, "{failure}");
            }
            other => panic!("{other:?}"),
        }
    }
}

/// Displacement (nm) of the tip of a rotated rod by a transverse force.
fn tip_moved(rod: &Rod, turn: UnitQuaternion, force: f64) -> f64 {
    let mut state = rod.state();
    for i in 0..=rod.segments {
        let x = turn * state.points.position.get(i);
        state.points.position.set(i, x);
        state.frames.orientation.set(i, turn);
    }
    let before = rod.tip(&state);
    let mut terms = rod.interactions();
    let force = turn * Vector3::x() * force;
    terms.push(Box::new(
        PointLoad::at(&mut state, rod.segments, force).unwrap(),
    ));
    relax(&mut state, &terms).unwrap();
    (rod.tip(&state) - before).norm()
}

/// Rod of 10 um: F L^3 / 3 B.
#[test]
fn forces_below_the_tolerance_are_solved() {
    let rod = Rod {
        segments: 100,
        length: 1e4,
        ..ACTIN
    };
    let skew = UnitQuaternion::new(Vector3::new(0.3, -1.0, 0.7));
    for turn in [UnitQuaternion::identity(), skew] {
        for force in [5e-9, 1e-12] {
            let theory = force * rod.length.powi(3) / (3.0 * rod.bending.x);
            let moved = tip_moved(&rod, turn, force);
            // The discretisation error is 1 / (2 n^2) = 5e-5.
            assert!((moved / theory - 1.0).abs() < 1e-4, "{moved:e}");
        }
    }
}

#[test]
fn stiffness_and_loads_scale_together() {
    let tip = |scale: f64| {
        let rod = Rod {
            shear: ACTIN.shear * scale,
            bending: ACTIN.bending * scale,
            ..ACTIN
        };
        tip_moved(&rod, UnitQuaternion::identity(), scale)
    };
    let full = tip(1.0);
    for scale in [1e-3, 1e-6, 1e-9, 1e-12] {
        let scaled = tip(scale);
        // Residuals of 1e-8 of the load at each of 16 nodes.
        assert!((scaled / full - 1.0).abs() < 16e-8, "{scale:e}: {scaled}");
    }
}

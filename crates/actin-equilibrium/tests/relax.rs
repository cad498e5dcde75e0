//! An equilibrium in one call: that of a solver with default options, off saddles, or the reason
//! why there is none.

mod common;

use actin_equilibrium::{
    EquilibriumError, Interaction, Loads, Newton, NewtonOptions, PointLoad, SolveError, State,
    Vector3, relax,
};
use common::ACTIN;

/// The compressed column is straight: a solver by itself stays there, on a saddle.
#[test]
fn a_column_under_too_much_force_buckles() {
    let mut state = ACTIN.state();
    let mut terms = ACTIN.interactions();
    let critical = (0.5 * std::f64::consts::PI / ACTIN.length).powi(2) * ACTIN.bending.x;
    let force = Vector3::z() * (-1.5 * critical);
    terms.push(Box::new(PointLoad::at(&mut state, 16, force)));
    let mut straight = state.clone();
    let layout = actin_equilibrium::Layout::free(&straight);
    let mut newton = Newton::new(layout, NewtonOptions::default()).unwrap();
    assert!(newton.solve(&mut straight, &terms).unwrap().is_saddle());
    let found = relax(&mut state, &terms).unwrap();
    assert!(found.saddles_left == 1 && !found.is_saddle());
    assert!(ACTIN.tip(&state).xy().norm() > 0.1 * ACTIN.length);
}

/// A load without second derivatives.
#[derive(Debug)]
struct Unknown;

impl Interaction for Unknown {
    fn term(&self) -> &'static str {
        "unknown"
    }
    fn add_loads(&self, _: &State, _: &mut Loads) {}
    fn elements(&self) -> usize {
        0
    }
    fn write_energies(&self, _: &State, _: &mut [f64]) {}
}

#[test]
fn what_cannot_be_relaxed_is_named() {
    let mut state = ACTIN.state();
    let terms: Vec<Box<dyn Interaction>> = vec![Box::new(Unknown)];
    match relax(&mut state, &terms) {
        Err(EquilibriumError::Newton(failure)) => {
            assert_eq!(failure.cause, SolveError::NoStiffness("unknown"));
        }
        other => panic!("{other:?}"),
    }
}

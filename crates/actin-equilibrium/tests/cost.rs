//! Cost grows linearly with the number of bodies.

mod common;

use actin_equilibrium::{Layout, Newton, NewtonOptions};
use actin_mechanics::{PointLoad, State, Vector3};
use common::{ACTIN, Rod};

/// How a rod's unknowns are ordered.
type Order = fn(&Rod, &State) -> Layout;

const GIVEN: Order = Rod::layout;
const FOUND: Order = |_, state| Layout::free(state);
const CHEAPER: Order = |rod, state| rod.layout(state).with_least_fill();

fn work(segments: usize, order: Order) -> actin_equilibrium::SolverWork {
    let rod = Rod {
        segments,
        length: 10.0 * segments as f64,
        ..ACTIN
    };
    let mut state = rod.state();
    let control = state.add_control(1e-6);
    let load = PointLoad::new(&state, vec![(segments, 1.0)], Vector3::x(), control);
    let mut terms = rod.interactions();
    terms.push(Box::new(load));
    let layout = order(&rod, &state);
    let mut newton = Newton::new(layout, NewtonOptions::default()).unwrap();
    newton.solve(&mut state, &terms).unwrap().work
}

/// Along the filament the factor has a band: each segment adds the same number of entries.
#[test]
fn the_factor_grows_linearly() {
    let [a, b, c] = [100, 200, 400].map(|n| work(n, GIVEN).factor_entries);
    assert_eq!(2 * (b - a), c - b, "{a} {b} {c}");
    // Six unknowns per segment, each coupled with eight others at most.
    assert!(c <= 400 * 6 * 9);
}

/// Without a given order, minimum degree does nearly as well on a chain.
#[test]
fn minimum_degree_is_linear_too() {
    let given = work(400, GIVEN).factor_entries as f64;
    let found = work(400, FOUND).factor_entries as f64;
    assert!(found < 1.5 * given, "{found} against {given}");
}

/// Of the order given and the one found the cheaper is taken, which on a chain is the one given.
#[test]
fn a_chain_keeps_the_order_given() {
    let [given, cheaper] = [GIVEN, CHEAPER].map(|order| work(400, order));
    assert_eq!(cheaper, given);
}

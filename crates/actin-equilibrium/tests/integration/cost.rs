//! Cost of solves.

use crate::common;
use actin_equilibrium::{
    Equilibrium, Iteration, Layout, Newton, NewtonOptions, Residual, Stability, Verdict,
};
use actin_mechanics::{Interaction, PointLoad, State, Vector3};
use common::{ACTIN, Rod, filament, in_order};

/// Monomers, maximum number of Newton steps, of factorisations and of steps that overshoot. Measured:
/// 21, 52 and 4; 16, 49 and 0; 27, 70 and 1; 54, 146 and 0. Straight steps need 31 and 100, 110 and
/// 489 for the second and third; without stiffening the longest needs 98, of which 39 overshoot.
const STEPS: [(usize, u64, u64, usize); 4] = [
    (61, 25, 77, 8),
    (234, 23, 59, 8),
    (585, 36, 93, 8),
    (1200, 65, 195, 15),
];

type Order = fn(&Rod, &State) -> Layout;

const GIVEN: Order = Rod::layout;
const FOUND: Order = |_, state| Layout::free(state);
const CHEAPER: Order = |rod, state| rod.layout(state).with_links();

fn work(segments: usize, order: Order) -> actin_equilibrium::SolverWork {
    let rod = Rod {
        segments,
        length: 10.0 * segments as f64,
        ..ACTIN
    };
    let (mut state, terms) = rod.loaded(Vector3::x(), 1e-6);
    let layout = order(&rod, &state);
    let mut newton = Newton::new(layout, NewtonOptions::default()).unwrap();
    newton.solve(&mut state, &terms).unwrap().work
}

/// Each segment adds the same number of entries to a band.
#[test]
fn the_factor_grows_linearly() {
    let [a, b, c] = [100, 200, 400].map(|n| work(n, GIVEN).factor_entries);
    assert_eq!(2 * (b - a), c - b, "{a} {b} {c}");
    // Six unknowns per segment, each coupled with at most eight others.
    assert!(c <= 400 * 6 * 9);
}

#[test]
fn minimum_degree_is_linear_too() {
    let given = work(400, GIVEN).factor_entries as f64;
    let found = work(400, FOUND).factor_entries as f64;
    assert!(found < 1.5 * given, "{found} against {given}");
}

#[test]
fn a_chain_keeps_the_order_given() {
    let [given, cheaper] = [GIVEN, CHEAPER].map(|order| work(400, order));
    assert_eq!(cheaper, given);
}

/// Equilibrium of a cantilever of floppy monomers, bent by the same angle at every length.
fn floppy(monomers: usize) -> Equilibrium {
    let (mut state, bonds) = filament(monomers, 10, 5);
    let control = state.add_control(2.0 * (60.0 / monomers as f64).powi(2));
    let shares = vec![(monomers - 1, 0.5), (monomers - 2, 0.5)];
    let load = PointLoad::new(&state, shares, Vector3::x(), control).unwrap();
    let terms: Vec<Box<dyn Interaction>> = vec![Box::new(bonds), Box::new(load)];
    let layout = Layout::new(&state, Some(&in_order(&state))).unwrap();
    let tolerance = Residual {
        force: 1e-6,
        torque: 1e-6,
    };
    let options = NewtonOptions {
        tolerance,
        ..NewtonOptions::default()
    };
    let mut newton = Newton::new(layout, options).unwrap();
    newton.minimize(&mut state, &terms, 3).unwrap()
}

#[test]
fn steps_hardly_grow_with_length() {
    for (monomers, steps, factorizations, outings) in STEPS {
        let found = floppy(monomers);
        let stability = found.certificate.unwrap().stability();
        assert_eq!(stability, Stability::Stable, "{monomers}");
        let is_outing = |step: &&Iteration| step.verdict != Verdict::Decrease;
        let overshoot = found.history.iter().filter(is_outing).count();
        let work = found.work;
        println!("{monomers}: {work:?}, {overshoot} steps overshoot");
        assert!(
            work.iterations <= steps && work.factorizations <= factorizations,
            "{monomers}"
        );
        assert!(overshoot <= outings, "{monomers}: {overshoot}");
    }
}

//! Random search.

use crate::common;
use actin_equilibrium::{
    Equilibrium, Iteration, KnownEquilibrium, Newton, NewtonOptions, Search, SearchObserver,
    SearchResult, SolveError,
};
use actin_mechanics::{Interaction, State, Vector3};
use common::COLUMN;
use std::ops::ControlFlow;

/// Fraction of the critical load of the softer axis.
fn column(share: f64) -> (State, Vec<Box<dyn Interaction>>, Newton) {
    let critical = std::f64::consts::PI.powi(2) * 3.0e4 / (4.0 * COLUMN.length.powi(2));
    let (state, terms) = COLUMN.loaded(Vector3::z() * (-share * critical), 1.0);
    let newton = Newton::new(COLUMN.layout(&state), NewtonOptions::default()).unwrap();
    (state, terms, newton)
}

fn of<'a>(state: &'a State, equilibrium: &'a Equilibrium) -> KnownEquilibrium<'a> {
    KnownEquilibrium {
        state,
        equilibrium,
        reference: state,
    }
}

const SEARCH: Search = Search {
    starts: 16,
    seed: 1,
};

fn searched(share: f64, search: &Search) -> SearchResult {
    let (mut state, terms, mut newton) = column(share);
    let known = newton.minimize(&mut state, &terms, 8).unwrap();
    newton
        .search(&of(&state, &known), &terms, search, &mut ())
        .unwrap()
}

/// Between the critical loads of both axes the column bends in either direction about the softer
/// axis.
#[test]
fn a_column_leans_to_either_side() {
    let straight = searched(0.9, &SEARCH);
    assert_eq!(straight.states.len(), 1);
    assert_eq!((straight.states[0].found, straight.lost), (17, 0));
    let leaning = searched(1.2, &SEARCH);
    let tips: Vec<Vector3> = leaning
        .states
        .iter()
        .map(|s| s.state.points.position.get(16))
        .collect();
    println!(
        "{tips:?}, {:?}",
        leaning.states.iter().map(|s| s.found).collect::<Vec<_>>()
    );
    assert_eq!((tips.len(), leaning.lost), (2, 0));
    let apart = tips[0].x + tips[1].x;
    assert!(tips[0].x.abs() > 10.0 && apart.abs() < 1e-4, "{tips:?}");
    let [a, b] = [0, 1].map(|i| leaning.states[i].equilibrium.energy);
    assert!((a - b).abs() < 1e-8 * a.abs(), "{a} and {b}");
    assert_eq!(leaning.states.iter().filter(|s| s.is_known).count(), 1);
    let fewer = searched(1.2, &Search { starts: 8, seed: 1 });
    let found = |found: &SearchResult| found.states.iter().map(|s| s.found).sum::<usize>();
    assert_eq!((found(&leaning), found(&fewer)), (17, 9));
}

#[test]
fn observers_interrupt_and_reject() {
    struct Ends(usize);
    impl SearchObserver for Ends {
        fn iterate(&mut self, _: &Iteration) -> ControlFlow<()> {
            self.0 -= 1;
            if self.0 == 0 {
                return ControlFlow::Break(());
            }
            ControlFlow::Continue(())
        }
    }
    struct Right;
    impl SearchObserver for Right {
        fn counts(&mut self, state: &State) -> bool {
            state.points.position.get(16).x > 0.0
        }
    }
    let (mut state, terms, mut newton) = column(1.2);
    let known = newton.minimize(&mut state, &terms, 8).unwrap();
    let ended = newton.search(&of(&state, &known), &terms, &SEARCH, &mut Ends(10));
    assert_eq!(ended.unwrap_err(), SolveError::Interrupted);
    let found = newton
        .search(&of(&state, &known), &terms, &SEARCH, &mut Right)
        .unwrap();
    let counted: usize = found.states.iter().map(|s| s.found).sum();
    assert!(
        found.lost > 0 && counted + found.lost == 17,
        "{counted}, {}",
        found.lost
    );
    let right = |s: &&actin_equilibrium::StableEquilibrium| {
        s.is_known || s.state.points.position.get(16).x > 0.0
    };
    assert_eq!(
        found.states.iter().filter(right).count(),
        found.states.len()
    );
}

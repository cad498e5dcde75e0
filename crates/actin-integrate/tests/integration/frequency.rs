use crate::common;
use actin_integrate::{
    Drag, FrequencyError, KRYLOV_VECTORS, POSITION_VERLET, advance, largest_frequency,
    largest_frequency_with, stable_step,
};
use actin_mechanics::testing::{push_frame, push_point};
use actin_mechanics::{Interaction, Loads, Split, Springs, State, System, UnitQuaternion, Vector3};
use common::{Torsion, chain, equal_springs, spinning_tops};
use std::f64::consts::PI;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// Exact value for `n` free points between walls: `omega = 2 sqrt(k/m) cos(pi / (2 (n + 1)))`.
fn chain_frequency(n: usize, stiffness: f64, mass: f64) -> f64 {
    2.0 * (stiffness / mass).sqrt() * (0.5 * PI / (n as f64 + 1.0)).cos()
}

#[test]
fn chain_of_springs() {
    for n in [1, 2, 10, 200, 3000] {
        let system = chain(n + 2, 2000.0, 0.07);
        let ratio = largest_frequency(&system).unwrap() / chain_frequency(n, 2000.0, 0.07);
        // High only by the error of the difference; low by less than the bound.
        assert!(ratio < 1.0 + 1e-6, "{n}: {ratio}");
        assert!(ratio > 0.99, "{n}: {ratio}");
        if n <= 20 {
            assert!(ratio > 1.0 - 1e-6, "{n}: the space is full, yet {ratio}");
        }
    }
}

/// A stiffer spring in a long chain has a localised mode: omega^2 = (k/m)(2 + r + 1/r), r = k / (2
/// k' - k). The random start has hardly any overlap with it.
#[test]
fn local_mode_in_a_long_chain() {
    let (n, k, m) = (3000, 2000.0, 0.07);
    let state = chain(n, k, m).state().clone();
    let mut all = equal_springs(&state, k, 1.0);
    all[n / 2].stiffness *= 1.5;
    let springs = Springs::new(&state, all).unwrap();
    let system = System::new(state, vec![Box::new(springs)]);
    let r: f64 = 1.0 / (2.0 * 1.5 - 1.0);
    let exact = (k / m * (2.0 + r + 1.0 / r)).sqrt();
    let ratio = largest_frequency(&system).unwrap() / exact;
    println!("local mode: 1 - {:.2e}", 1.0 - ratio);
    assert!((ratio - 1.0).abs() < 1e-6);
}

#[test]
fn fewer_vectors_find_less_and_never_more() {
    let system = chain(202, 2000.0, 0.07);
    let exact = chain_frequency(200, 2000.0, 0.07);
    let mut last = 0.0;
    for vectors in [2, 5, 10, 20, 30, 45, 60, 90] {
        let estimate = largest_frequency_with(&system, vectors).unwrap();
        println!("{vectors} vectors: 1 - {:.2e}", 1.0 - estimate / exact);
        assert!(estimate >= last * (1.0 - 1e-9) && estimate < exact * (1.0 + 1e-6));
        last = estimate;
    }
}

/// A frame on a torsion spring at a held frame: sqrt(k / I) about the axis of the smallest moment.
#[test]
fn frame_on_a_torsion_spring() {
    let mut state = State::default();
    for moments in [[1e-6, 1e-6, 1e-6], [0.5, 0.5, 0.2]] {
        push_frame(&mut state, UnitQuaternion::identity(), moments);
    }
    state.frames.hold(0);
    let torsion = Torsion {
        pairs: vec![(0, 1)],
        stiffness: 1300.0,
    };
    let system = System::new(state, vec![Box::new(torsion)]);
    let expected = (1300.0f64 / 0.2).sqrt();
    let error = largest_frequency(&system).unwrap() / expected - 1.0;
    println!("torsion: {error:.1e}");
    assert!(error.abs() < 1e-8);
}

#[test]
fn verlet_is_stable_up_to_the_estimate() {
    assert!(stays_bounded(0.99));
    assert!(!stays_bounded(1.01));
}

/// Returns `true` if a chain keeps its energy over 2000 steps at `share` of the limit.
fn stays_bounded(share: f64) -> bool {
    let mut system = chain(12, 4.0, 1.0);
    for i in 1..11 {
        let v = Vector3::x() * 1e-6 * (i as f64).sin();
        system.state_mut().points.velocity.set(i, v);
    }
    let frequency = largest_frequency(&system).unwrap();
    let h = share * stable_step(&POSITION_VERLET, frequency, 1.0).unwrap();
    advance(&mut system, &POSITION_VERLET, h, 2000, &Drag::NONE);
    system.state().kinetic_energy() < 1e-6
}

#[test]
fn frequency_is_zero_without_bodies_or_stiffness() {
    assert!(largest_frequency(&System::new(State::default(), Vec::new())).unwrap() == 0.0);
    assert!(largest_frequency(&chain(2, 4.0, 1.0)).unwrap() == 0.0);
    let (state, none) = (spinning_tops().state().clone(), Vec::new());
    assert!(largest_frequency(&System::new(state, none)).unwrap() == 0.0);
}

#[test]
fn estimates_are_reproducible_and_do_not_change_the_system() {
    let mut system = spinning_tops();
    system.loads();
    let (state, count) = (system.state().clone(), system.force_evaluations());
    let frequency = largest_frequency(&system).unwrap();
    assert_eq!(
        frequency.to_bits(),
        largest_frequency(&system).unwrap().to_bits()
    );
    assert_eq!(*system.state(), state);
    assert_eq!(system.force_evaluations(), count);
}

#[derive(Debug)]
struct Linear {
    rows: [Vector3; 3],
    evaluations: Arc<AtomicU64>,
}

impl Interaction for Linear {
    fn term(&self) -> &'static str {
        "linear"
    }

    fn add_loads(&self, state: &State, loads: &mut Loads) {
        self.evaluations.fetch_add(1, Ordering::Relaxed);
        for i in 0..state.points.len() {
            let x = state.points.position.get(i);
            let force = Vector3::from_iterator(self.rows.iter().map(|row| -row.dot(&x)));
            loads.force.add(i, force);
        }
    }

    fn elements(&self) -> usize {
        1
    }

    fn write_energies(&self, _state: &State, energies: &mut [f64]) {
        energies.fill(0.0);
    }

    fn is_conservative(&self) -> bool {
        false
    }
}

/// `n` points of mass 2 under a [`Linear`] force, and the counter of its evaluations.
fn linear(n: usize, rows: [[f64; 3]; 3]) -> (System, Arc<AtomicU64>) {
    let mut state = State::default();
    for _ in 0..n {
        push_point(&mut state, Vector3::new(1.0, -2.0, 0.5), 2.0);
    }
    let evaluations = Arc::new(AtomicU64::new(0));
    let force = Linear {
        rows: rows.map(Vector3::from),
        evaluations: Arc::clone(&evaluations),
    };
    (System::new(state, vec![Box::new(force)]), evaluations)
}

#[test]
fn loads_without_an_energy_do_not_fail() {
    let (system, _) = linear(1, [[8.0, 5.0, 0.0], [-5.0, 8.0, 0.0], [0.0, 0.0, 2.0]]);
    assert!((largest_frequency(&system).unwrap() - 2.0).abs() < 1e-8);
}

#[test]
fn negative_stiffness_does_not_count() {
    let (system, _) = linear(1, [[-800.0, 0.0, 0.0], [0.0, 8.0, 0.0], [0.0, 0.0, 2.0]]);
    assert!((largest_frequency(&system).unwrap() - 2.0).abs() < 1e-8);
    let (system, _) = linear(1, [[-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]]);
    assert!(largest_frequency(&system).unwrap() == 0.0);
}

#[test]
fn few_eigenvalues_cost_few_evaluations() {
    let (system, evaluations) = linear(100, [[8.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 2.0]]);
    largest_frequency(&system).unwrap();
    // Three eigenvalues close the space after three vectors.
    assert_eq!(evaluations.load(Ordering::Relaxed), 6);
}

#[test]
fn loads_that_are_not_finite_are_named() {
    let (system, _) = linear(1, [[f64::NAN, 0.0, 0.0], [0.0; 3], [0.0; 3]]);
    assert_eq!(
        largest_frequency(&system),
        Err(FrequencyError { term: "linear" })
    );
}

#[test]
fn a_broken_term_among_many_is_found_in_few_evaluations() {
    let terms: u64 = 1024;
    let (system, _) = linear(2, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    let evaluations = Arc::new(AtomicU64::new(0));
    let term = |i: u64| -> Box<dyn Interaction> {
        let entry = if i + 1 == terms { f64::NAN } else { 1.0 };
        Box::new(Linear {
            rows: [Vector3::new(entry, 0.0, 0.0), Vector3::y(), Vector3::z()],
            evaluations: Arc::clone(&evaluations),
        })
    };
    let system = System::new(system.state().clone(), (0..terms).map(term).collect());
    let error = largest_frequency(&system).unwrap_err();
    assert_eq!(error, FrequencyError { term: "linear" });
    // Trial motion, repetition of all, prefixes of the bisection, and the term found.
    let most = terms * (3 + u64::from(terms.ilog2()));
    let found = evaluations.load(Ordering::Relaxed);
    assert!(found <= most, "{found} of at most {most}");
}

/// Unequal masses give 300 different eigenvalues.
#[test]
fn sound_terms_are_evaluated_twice_for_each_vector() {
    for terms in [1_u64, 50] {
        let (_, evaluations) = linear(1, [[0.0; 3]; 3]);
        let mut state = State::default();
        for i in 0..100_u32 {
            push_point(&mut state, Vector3::zeros(), 1.0 + f64::from(i));
        }
        let term = |_| -> Box<dyn Interaction> {
            Box::new(Linear {
                rows: [Vector3::x() * 8.0, Vector3::y() * 4.0, Vector3::z() * 2.0],
                evaluations: Arc::clone(&evaluations),
            })
        };
        let system = System::new(state, (0..terms).map(term).collect());
        largest_frequency(&system).unwrap();
        let expected = 2 * terms * KRYLOV_VECTORS as u64;
        assert_eq!(evaluations.load(Ordering::Relaxed), expected);
    }
}

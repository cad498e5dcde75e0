//! Certificates of singular matrices.

use crate::common;
use Coordinates::{Frame as F, Point as P};
use actin_equilibrium::{Layout, Newton, NewtonOptions, Stability};
use actin_mechanics::{
    Coordinates, Interaction, Loads, Matrix3, SecondOrder, State, Stiffness, UnitQuaternion,
    Vector3,
};
use common::{ACTIN, chain, frame, in_order, point};

type Terms = Vec<Box<dyn Interaction>>;

/// Constant stiffness of points about the origin, `E = x . K x / 2`.
#[derive(Debug)]
struct Wells(Vec<(usize, Matrix3)>);

impl Interaction for Wells {
    fn term(&self) -> &'static str {
        "wells"
    }
    fn add_loads(&self, state: &State, loads: &mut Loads) {
        for &(i, k) in &self.0 {
            loads.force.add(i, -(k * state.points.position.get(i)));
        }
    }
    fn elements(&self) -> usize {
        self.0.len()
    }
    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        for (e, &(i, k)) in energies.iter_mut().zip(&self.0) {
            let x = state.points.position.get(i);
            *e = 0.5 * x.dot(&(k * x));
        }
    }
    fn second_order(&self) -> Option<&dyn SecondOrder> {
        Some(self)
    }
}

impl SecondOrder for Wells {
    fn add_stiffness(&self, _: &State, stiffness: &mut Stiffness) {
        for &(i, k) in &self.0 {
            stiffness.push(P(i), P(i), k);
        }
    }
}

fn bodies(points: usize, frames: usize) -> State {
    let mut state = State::default();
    for _ in 0..points {
        point(&mut state, Vector3::zeros());
    }
    for _ in 0..frames {
        frame(&mut state, UnitQuaternion::identity());
    }
    state
}

/// The result does not depend on the order.
fn stability(state: &State, terms: &Terms) -> Stability {
    let [given, own] = [true, false].map(|is_given| {
        let order = is_given.then(|| in_order(state));
        let layout = Layout::new(state, order.as_ref()).unwrap();
        let mut newton = Newton::new(layout, NewtonOptions::default()).unwrap();
        let mut state = state.clone();
        let found = newton.solve(&mut state, terms).unwrap();
        let certificate = found.certificate.unwrap();
        assert!(certificate.resolution.is_finite() && certificate.resolution > 0.0);
        certificate.stability()
    });
    assert_eq!(given, own);
    given
}

fn diagonal(values: [f64; 3]) -> Matrix3 {
    Matrix3::from_diagonal(&Vector3::from(values))
}

/// A zero pivot has no sign.
#[test]
fn exact_zeros_of_one_point_are_neutral() {
    let turn = |axis: [f64; 3]| UnitQuaternion::from_scaled_axis(Vector3::from(axis));
    let turns = [[0.0; 3], [0.3, -0.2, 0.9], [0.0, 0.785, 0.0]].map(turn);
    for (values, modes) in [
        ([1.0, 1.0, 0.0], 1),
        ([1.0, 0.0, 1.0], 1),
        ([0.0, 1.0, 1.0], 1),
        ([0.0, 0.0, 1e9], 2),
        ([1e-9, 0.0, 1e-9], 1),
        ([0.0, 0.0, 0.0], 3),
    ] {
        for turn in turns {
            let rotation = turn.to_rotation_matrix().into_inner();
            let block = rotation * diagonal(values) * rotation.transpose();
            let terms: Terms = vec![Box::new(Wells(vec![(0, block)]))];
            let found = stability(&bodies(1, 0), &terms);
            assert_eq!(found, Stability::Neutral { modes }, "{values:?} {turn:?}");
        }
    }
    let stable: Terms = vec![Box::new(Wells(vec![(0, diagonal([1.0, 1e-9, 2.0]))]))];
    assert_eq!(stability(&bodies(1, 0), &stable), Stability::Stable);
}

#[test]
fn a_saddle_with_zeros_is_a_saddle() {
    for values in [[-1.0, 1.0, 0.0], [0.0, 1.0, -1.0], [0.0, -1.0, 0.0]] {
        let terms: Terms = vec![Box::new(Wells(vec![(0, diagonal(values))]))];
        let found = stability(&bodies(1, 0), &terms);
        assert_eq!(found, Stability::Saddle { negative: 1 }, "{values:?}");
    }
    // Eigenvalues 1 and -1 with a zero diagonal require pivoting.
    let mut block = diagonal([0.0, 0.0, 1.0]);
    (block[(0, 1)], block[(1, 0)]) = (1.0, 1.0);
    let terms: Terms = vec![Box::new(Wells(vec![(0, block)]))];
    assert_ne!(stability(&bodies(1, 0), &terms), Stability::Stable);
}

#[test]
fn bodies_without_interactions_are_neutral() {
    let none: Terms = vec![];
    for (points, frames) in [(1, 0), (0, 1), (3, 2)] {
        let modes = 3 * (points + frames);
        let found = stability(&bodies(points, frames), &none);
        assert_eq!(found, Stability::Neutral { modes }, "{points} and {frames}");
    }
    for held in [vec![0, 2], vec![0], vec![2], vec![1]] {
        let wells = held.iter().map(|&i| (i, diagonal([3.0, 4.0, 5.0])));
        let terms: Terms = vec![Box::new(Wells(wells.collect()))];
        let modes = 3 * (3 - held.len() + 2);
        let found = stability(&bodies(3, 2), &terms);
        assert_eq!(found, Stability::Neutral { modes }, "{held:?}");
    }
}

/// Springs at rest have longitudinal stiffness only.
#[test]
fn neutral_modes_of_rods_and_springs_are_counted() {
    let mut rod = ACTIN.state();
    let clamped = ACTIN.interactions();
    for _ in 0..2 {
        point(&mut rod, Vector3::x());
        frame(&mut rod, UnitQuaternion::identity());
    }
    let found = stability(&rod, &clamped);
    assert_eq!(found, Stability::Neutral { modes: 12 });

    for segments in [4, 16, 160] {
        let free = common::Rod {
            segments,
            length: 10.0 * segments as f64,
            ..ACTIN
        };
        let mut state = State::default();
        for i in 0..=segments {
            point(&mut state, Vector3::z() * (10.0 * i as f64));
        }
        for _ in 0..=segments {
            frame(&mut state, UnitQuaternion::identity());
        }
        let found = stability(&state, &free.interactions());
        assert_eq!(found, Stability::Neutral { modes: 6 }, "{segments}");
    }

    let (mut state, terms) = chain();
    assert_eq!(stability(&state, &terms), Stability::Neutral { modes: 8 });
    frame(&mut state, UnitQuaternion::identity());
    frame(&mut state, UnitQuaternion::identity());
    state.frames.hold(1);
    assert_eq!(stability(&state, &terms), Stability::Neutral { modes: 11 });
    assert!(Layout::free(&state).unknowns_of(F(1)).is_none());
}

/// Four springs (10 pN/nm) with one end held, with 8 neutral modes: `4 k sin^2(pi / 18)`.
#[test]
fn the_lowest_eigenvalue_excludes_neutral_modes() {
    let lowest = |state: &State, terms: &Terms| {
        let mut newton = Newton::new(Layout::free(state), NewtonOptions::default()).unwrap();
        let certificate = newton.certify(state, terms).unwrap();
        newton
            .lowest_eigenvalue(state, terms, &certificate)
            .unwrap()
    };
    let (chain, terms) = chain();
    let exact = 40.0 * (std::f64::consts::PI / 18.0).sin().powi(2);
    let found = lowest(&chain, &terms).unwrap();
    assert!((found / exact - 1.0).abs() < 2e-9, "{found}");
    assert_eq!(lowest(&bodies(1, 1), &vec![]), None);
    let saddle: Terms = vec![Box::new(Wells(vec![(0, diagonal([0.0, -2.0, 5.0]))]))];
    assert!((lowest(&bodies(1, 0), &saddle).unwrap() + 2.0).abs() < 1e-12);
}

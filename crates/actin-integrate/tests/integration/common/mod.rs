#![allow(dead_code, reason = "each test file uses its own part")]

use actin_integrate::{Drag, POSITION_VERLET, advance};
use actin_mechanics::testing::{push_frame, push_point};
use actin_mechanics::{
    Interaction, Loads, Spring, Springs, State, System, UnitQuaternion, Vector3, rotation,
};
use actin_mechanics::{Xorshift, perturb, randomise_velocities};

pub(crate) fn springs(state: &State, stiffness: f64, rest_length: f64) -> Springs {
    Springs::new(state, equal_springs(state, stiffness, rest_length)).unwrap()
}

/// Springs between consecutive points.
pub(crate) fn equal_springs(state: &State, stiffness: f64, rest_length: f64) -> Vec<Spring> {
    let spring = |i| Spring {
        points: [i - 1, i],
        stiffness,
        rest_length,
    };
    (1..state.points.len()).map(spring).collect()
}

/// Bonds between anchors fixed in frames. Body `i` consists of point `i` and frame `i`.
#[derive(Clone, Debug)]
pub(crate) struct Bonds {
    /// First body and anchor, second body and anchor (body axes).
    pub(crate) pairs: Vec<(usize, Vector3, usize, Vector3)>,
    pub(crate) stiffness: f64,
    pub(crate) rest: f64,
}

impl Bonds {
    fn span(&self, state: &State, pair: usize) -> Vector3 {
        let (i, a, j, b) = self.pairs[pair];
        let anchor =
            |i: usize, a| state.points.position.get(i) + state.frames.orientation.get(i) * a;
        anchor(j, b) - anchor(i, a)
    }
}

impl Interaction for Bonds {
    fn term(&self) -> &'static str {
        "bonds"
    }

    fn add_loads(&self, state: &State, loads: &mut Loads) {
        for (pair, &(i, a, j, b)) in self.pairs.iter().enumerate() {
            let d = self.span(state, pair);
            let pull = self.stiffness * (1.0 - self.rest / d.norm()) * d;
            let q = &state.frames.orientation;
            loads.force.add(i, pull);
            loads.force.add(j, -pull);
            loads
                .torque
                .add(i, a.cross(&q.get(i).inverse_transform_vector(&pull)));
            loads
                .torque
                .add(j, -b.cross(&q.get(j).inverse_transform_vector(&pull)));
        }
    }

    fn elements(&self) -> usize {
        self.pairs.len()
    }

    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        for (pair, energy) in energies.iter_mut().enumerate() {
            let stretch = self.span(state, pair).norm() - self.rest;
            *energy = 0.5 * self.stiffness * stretch * stretch;
        }
    }
}

#[derive(Clone, Debug)]
pub(crate) struct Torsion {
    pub(crate) pairs: Vec<(usize, usize)>,
    pub(crate) stiffness: f64,
}

impl Torsion {
    fn angle(&self, state: &State, pair: usize) -> Vector3 {
        let (i, j) = self.pairs[pair];
        let q = &state.frames.orientation;
        rotation::log(q.get(i).inverse() * q.get(j))
    }
}

impl Interaction for Torsion {
    fn term(&self) -> &'static str {
        "torsion"
    }

    fn add_loads(&self, state: &State, loads: &mut Loads) {
        for (pair, &(i, j)) in self.pairs.iter().enumerate() {
            // The gradient is parallel to the angle, so that the inverse Jacobians are the
            // identity.
            let couple = self.stiffness * self.angle(state, pair);
            loads.torque.add(i, couple);
            loads.torque.add(j, -couple);
        }
    }

    fn elements(&self) -> usize {
        self.pairs.len()
    }

    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        for (pair, energy) in energies.iter_mut().enumerate() {
            *energy = 0.5 * self.stiffness * self.angle(state, pair).norm_squared();
        }
    }
}

/// Bonded bodies with anchors.
const BOND_ENDS: [(usize, [f64; 3], usize, [f64; 3]); 3] = [
    (0, [0.5, 0.3, -0.2], 1, [-0.4, 0.2, 0.3]),
    (1, [0.5, -0.3, 0.2], 2, [-0.5, 0.1, -0.3]),
    (0, [0.1, -0.6, 0.4], 2, [-0.2, -0.5, 0.1]),
];

pub(crate) fn three_tops() -> System {
    let mut state = State::default();
    for (i, moments) in [[2.0, 1.0, 1.0], [0.8, 1.5, 0.8], [1.0, 1.0, 1.7]]
        .into_iter()
        .enumerate()
    {
        push_point(
            &mut state,
            Vector3::new(2.0 * i as f64, 0.3 * i as f64, 0.0),
            1.0 + 0.5 * i as f64,
        );
        push_frame(&mut state, UnitQuaternion::identity(), moments);
    }
    let bonds = Bonds {
        pairs: BOND_ENDS
            .map(|(i, a, j, b)| (i, a.into(), j, b.into()))
            .into(),
        stiffness: 3.0,
        rest: 1.2,
    };
    let torsion = Torsion {
        pairs: vec![(0, 1), (1, 2)],
        stiffness: 1.0,
    };
    System::new(state, vec![Box::new(bonds), Box::new(torsion)])
}

pub(crate) fn spinning_tops() -> System {
    let mut system = three_tops();
    let mut noise = Xorshift::new(7);
    perturb(system.state_mut(), &mut noise, 0.1, 0.3);
    randomise_velocities(system.state_mut(), &mut noise, 0.5, 1.5);
    system
}

/// [`three_tops`] in equilibrium with small random vibrations: rms bond strain of 2.6 % for seed 7.
pub(crate) fn vibrating_tops(seed: u64) -> System {
    let mut system = three_tops();
    let drag = Drag::new(0.5, 0.5).unwrap();
    advance(&mut system, &POSITION_VERLET, 0.05, 4000, &drag);
    system.state_mut().stop();
    let mut noise = Xorshift::new(seed);
    perturb(system.state_mut(), &mut noise, 0.01, 0.03);
    randomise_velocities(system.state_mut(), &mut noise, 0.05, 0.15);
    system
}

pub(crate) fn chain(n: usize, stiffness: f64, mass: f64) -> System {
    let mut state = State::default();
    for i in 0..n {
        push_point(&mut state, Vector3::new(i as f64, 0.0, 0.0), mass);
    }
    state.points.hold(0);
    state.points.hold(n - 1);
    let springs = springs(&state, stiffness, 1.0);
    System::new(state, vec![Box::new(springs)])
}

pub(crate) fn flatten(state: &State) -> Vec<f64> {
    let q = &state.frames.orientation;
    let vectors = [
        &state.points.position,
        &state.points.velocity,
        &state.frames.angular_momentum,
    ];
    vectors
        .iter()
        .flat_map(|v| [&v.x, &v.y, &v.z])
        .chain([&q.w, &q.x, &q.y, &q.z])
        .flatten()
        .copied()
        .collect()
}

pub(crate) fn distance(a: &State, b: &State) -> f64 {
    let squares = flatten(a)
        .into_iter()
        .zip(flatten(b))
        .map(|(a, b)| (a - b) * (a - b));
    squares.sum::<f64>().sqrt()
}

//! Rods for tests.
#![allow(dead_code, reason = "each test file uses some of these")]

use actin_cosserat::{Rigidities, RodLayout, RodMaterial, StraightRod, Walls};
use actin_mechanics::{State, Vector3};
use actin_mechanics::{Xorshift, perturb};

#[rustfmt::skip]
pub(crate) const ALL_WALLS: [Walls; 4] = [
    Walls { start: false, end: false },
    Walls { start: true, end: false },
    Walls { start: false, end: true },
    Walls { start: true, end: true },
];

pub(crate) fn material() -> RodMaterial {
    RodMaterial::new(Rigidities {
        shear: Vector3::new(1.6e4, 2.1e4, 3.4e4),
        bend: Vector3::new(3.9e4, 2.7e4, 1.3e4),
    })
    .unwrap()
}

pub(crate) fn rod(segments: usize, walls: Walls, noise: &mut Xorshift) -> (State, RodLayout) {
    let mut state = State::default();
    let neighbour = StraightRod::uniform(1, 10.0);
    neighbour.push(&mut state).unwrap();
    let rod = StraightRod {
        start: Vector3::new(3.0, -2.0, 5.0),
        orientation: actin_mechanics::rotation::exp(noise.vector()),
        segment_lengths: (0..segments).map(|_| 10.0 + 4.0 * noise.sample()).collect(),
        walls,
        ..StraightRod::uniform(0, 0.0)
    };
    let layout = rod.push(&mut state).unwrap();
    neighbour.push(&mut state).unwrap();
    (state, layout)
}

pub(crate) fn strained_rod(
    segments: usize,
    walls: Walls,
    noise: &mut Xorshift,
) -> (State, RodLayout) {
    let (mut state, layout) = rod(segments, walls, noise);
    perturb(&mut state, noise, 2.5, 0.5);
    (state, layout)
}

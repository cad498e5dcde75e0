//! The fast path against the elements' own loads, with one lane and with as many as there are.

use super::*;
use crate::{BendingElement, Rigidities, ShearElement, StraightRod, Walls};
use actin_mechanics::testing::{Noise, perturb};
use actin_mechanics::wide::Arch;
use actin_mechanics::{UnitQuaternion, rotation};

/// Rigidities that all differ, so that no mix-up of axes goes unseen.
fn material() -> RodMaterial {
    RodMaterial::new(Rigidities {
        shear: Vector3::new(1.6e4, 2.1e4, 3.4e4),
        bend: Vector3::new(3.9e4, 2.7e4, 1.3e4),
    })
    .unwrap()
}

/// A rod of unequal segments with other bodies before and after it.
fn rod(segments: usize, walls: Walls, noise: &mut Noise) -> (State, RodLayout) {
    let mut state = State::default();
    let neighbour = StraightRod::uniform(1, 10.0);
    neighbour.push(&mut state).unwrap();
    let rod = StraightRod {
        start: noise.vector(),
        orientation: rotation::exp(noise.vector()),
        segment_lengths: (0..segments).map(|_| 10.0 + 4.0 * noise.sample()).collect(),
        walls,
        ..StraightRod::uniform(0, 0.0)
    };
    let layout = rod.push(&mut state).unwrap();
    neighbour.push(&mut state).unwrap();
    (state, layout)
}

/// Every combination of walls.
fn all_walls() -> [Walls; 4] {
    [(false, false), (true, false), (false, true), (true, true)]
        .map(|(start, end)| Walls { start, end })
}

/// The loads element by element, added to what `loads` already holds.
fn add_reference(layout: &RodLayout, state: &State, loads: &mut Loads) {
    let (x, q) = (&state.points.position, &state.frames.orientation);
    let bodies = layout.points().zip(layout.frames());
    for (&length, (i, frame)) in layout.segment_lengths().iter().zip(bodies) {
        let l = x.get(i + 1) - x.get(i);
        let shear = ShearElement::segment(length).loads(&material(), q.get(frame), l);
        loads.force.add(i, shear.force);
        loads.force.add(i + 1, -shear.force);
        loads.torque.add(frame, shear.torque);
    }
    for (&rest_distance, a) in layout.voronoi_lengths().iter().zip(layout.bending_chain()) {
        let element = BendingElement { rest_distance };
        let bending = element.loads(&material(), q.get(a), q.get(a + 1));
        loads.torque.add(a, bending.first);
        loads.torque.add(a + 1, bending.second);
    }
}

/// The fast loads, added to what `loads` already holds.
fn add_fast(arch: Arch, layout: &RodLayout, state: &State, loads: &mut Loads) {
    let rod = ConstantRod::new(layout, &material()).expect("the rigidities are constant");
    arch.dispatch(AddLoads {
        rod: &rod,
        layout,
        state,
        loads,
    });
}

/// Largest difference of the loads, and the largest load.
fn compare(a: &Loads, b: &Loads) -> (f64, f64) {
    let pairs = (a.force.iter().zip(b.force.iter())).chain(a.torque.iter().zip(b.torque.iter()));
    pairs.fold((0.0, 0.0), |(difference, largest), (a, b)| {
        (
            f64::max(difference, (a - b).norm()),
            f64::max(largest, b.norm()),
        )
    })
}

/// Rods from one segment up, every clamp, angles between neighbours from a hundredth to nearly
/// half a turn, both quaternions of some frames, and buffers that are not empty.
#[test]
fn loads_are_those_of_the_elements() {
    let mut noise = Noise::new(1);
    for segments in (1..=17).chain([64]) {
        for walls in all_walls() {
            for angle in [0.01, 0.3, 1.0, 1.8] {
                let (mut state, layout) = rod(segments, walls, &mut noise);
                perturb(&mut state, &mut noise, 0.5, angle);
                flip_some(&mut state);
                let mut expected = Loads::zeros(&state);
                for i in 0..expected.force.len() {
                    expected.force.set(i, noise.vector());
                }
                let start = expected.clone();
                add_reference(&layout, &state, &mut expected);
                for arch in [Arch::Scalar, Arch::new()] {
                    let mut loads = start.clone();
                    add_fast(arch, &layout, &state, &mut loads);
                    let (difference, largest) = compare(&loads, &expected);
                    let relative = difference / largest;
                    assert!(relative < 1e-13, "{segments}, {angle}: {relative:e}");
                }
            }
        }
    }
}

/// Replaces every third quaternion by its negative, which is the same rotation.
fn flip_some(state: &mut State) {
    for i in (0..state.frames.len()).step_by(3) {
        let q = state.frames.orientation.get(i);
        let negative = nalgebra::Unit::new_unchecked(-q.into_inner());
        state.frames.orientation.set(i, negative);
    }
}

/// A rod along z at rest has no load at all: the lanes beyond its end must not add the force of a
/// segment of no length.
#[test]
fn a_rod_at_rest_has_no_loads() {
    for segments in 1..10 {
        let mut state = State::default();
        let layout = StraightRod::uniform(segments, 8.0)
            .push(&mut state)
            .unwrap();
        let mut loads = Loads::zeros(&state);
        add_fast(Arch::new(), &layout, &state, &mut loads);
        assert!(compare(&loads, &Loads::zeros(&state)).0 == 0.0);
    }
}

/// Turns down to the smallest numbers give couples in proportion: 3900 pN nm per rad.
#[test]
fn the_smallest_turns_count() {
    for angle in [5e-324, 1e-310, 1e-200, 1e-20] {
        let mut state = State::default();
        let layout = StraightRod::uniform(2, 10.0).push(&mut state).unwrap();
        let half = nalgebra::Quaternion::new(1.0, angle, 0.0, 0.0);
        let turned = UnitQuaternion::new_unchecked(half);
        state.frames.orientation.set(1, turned);
        let mut loads = Loads::zeros(&state);
        add_fast(Arch::new(), &layout, &state, &mut loads);
        let expected = 3.9e4 * (0.1 * (2.0 * angle));
        // The smallest number is rounded when it is divided by the length.
        let couple = loads.torque.get(0).x;
        assert!(
            (couple - expected).abs() <= 1e-15 * expected + 2e-320,
            "{couple:e}"
        );
    }
}

/// A node that is not a number spoils its own segments and no others, so that whoever looks for
/// what broke finds it.
#[test]
fn a_broken_node_spoils_its_neighbours_only() {
    let (mut state, layout) = rod(14, Walls::default(), &mut Noise::new(9));
    let broken = layout.points().start + 6;
    state.points.position.x[broken] = f64::NAN;
    let mut loads = Loads::zeros(&state);
    add_fast(Arch::new(), &layout, &state, &mut loads);
    for (i, force) in loads.force.iter().enumerate() {
        let near = i.abs_diff(broken) <= 1;
        assert_eq!(force.iter().any(|f| f.is_nan()), near, "node {i}");
    }
}

/// Laws that are not constant, and segments that the curvature reaches, keep the scalar path.
#[test]
fn only_constant_rigidities_are_fast() {
    let (_, layout) = rod(3, Walls::default(), &mut Noise::new(9));
    let stretch = StretchLaw::Sided {
        tension: 3.4e4,
        compression: 1.7e4,
        width: 1e-3,
    };
    let other = material().with_stretch(stretch).unwrap();
    assert!(ConstantRod::new(&layout, &material()).is_some());
    assert!(ConstantRod::new(&layout, &other).is_none());
}

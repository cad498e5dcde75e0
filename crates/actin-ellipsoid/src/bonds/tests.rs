//! Bond loads and stiffness.

use super::*;
use crate::{Anchors, EllipsoidParameters, Placement};
use actin_mechanics::testing::{assert_same_with_any_lanes, loads_of};
use actin_mechanics::testing::{push_frame, push_point};
use actin_mechanics::{Coordinates, Stiffness, UnitQuaternion};
use actin_mechanics::{Xorshift, perturb};

fn run(count: usize, bonds: [usize; 2]) -> (State, Bonds) {
    run_of(Anchors::Independent, count, bonds)
}

fn run_of(anchors: Anchors, count: usize, bonds: [usize; 2]) -> (State, Bonds) {
    let mut parameters = EllipsoidParameters {
        anchors,
        ..EllipsoidParameters::default()
    };
    parameters.lateral.bonds = bonds[0];
    parameters.longitudinal.bonds = bonds[1];
    let model = EllipsoidModel::new(parameters).unwrap();
    let mut state = State::default();
    for _ in 0..3 {
        push_unrelated_body(&mut state);
    }
    push_point(&mut state, Vector3::zeros(), 1.0);
    let monomers = model
        .build(&mut state, &Placement::default(), -4, count)
        .unwrap();
    push_unrelated_body(&mut state);
    let bonds = model.bonds(&monomers).unwrap();
    perturb(&mut state, &mut Xorshift::new(8), 0.4, 0.3);
    (state, bonds)
}

fn push_unrelated_body(state: &mut State) {
    push_point(state, Vector3::zeros(), 1.0);
    push_frame(state, UnitQuaternion::identity(), [1.0, 1.0, 2.0]);
}

fn reference(bonds: &Bonds, state: &State) -> Loads {
    let mut loads = Loads::zeros(state);
    for pair in bonds.pairs() {
        for ([from, to], bond) in bonds.ends_of(pair, state).zip(bonds.bonds_of(pair)) {
            let d = to - from;
            let force =
                d.normalize() * (pair.rigidity * bond.weight * (d.norm() - bond.rest_length));
            for (k, end, force) in [(pair.lower, from, force), (pair.upper, to, -force)] {
                let body = bonds.body(state, k);
                let torque = (end - body.centre).cross(&force);
                loads.force.add(bonds.monomers.point(k), force);
                let torque = body.axes.tr_mul(&torque);
                loads.torque.add(bonds.monomers.frame(k), torque);
            }
        }
    }
    loads
}

fn difference(a: &Loads, b: &Loads) -> f64 {
    let pairs = |a: &Loads, b: &Loads| {
        let forces = a.force.iter().zip(b.force.iter());
        let torques = a.torque.iter().zip(b.torque.iter());
        forces.chain(torques).collect::<Vec<_>>()
    };
    let largest = |pairs: Vec<(Vector3, Vector3)>| {
        pairs
            .iter()
            .map(|(a, b)| (a - b).norm())
            .fold(0.0, f64::max)
    };
    let zero = Loads {
        force: (0..a.force.len()).map(|_| Vector3::zeros()).collect(),
        torque: (0..a.torque.len()).map(|_| Vector3::zeros()).collect(),
    };
    largest(pairs(a, b)) / largest(pairs(b, &zero))
}

/// Sums of a hundred terms have a rounding error of 1e-14.
#[test]
fn loads_match_the_reference_on_any_processor() {
    for anchors in [Anchors::Independent, Anchors::Identical, Anchors::Cubature] {
        for count in [2, 3, 4, 5, 8, 9, 10, 11, 27] {
            let (state, vector) = run_of(anchors, count, [7, 12]);
            let scalar = Bonds {
                arch: Arch::Scalar,
                ..vector.clone()
            };
            let expected = reference(&vector, &state);
            for bonds in [vector, scalar] {
                let loads = loads_of(&bonds, &state);
                assert!(difference(&loads, &expected) < 1e-13, "{count} monomers");
            }
        }
    }
}

#[test]
fn loads_are_the_same_with_any_number_of_lanes() {
    for anchors in [Anchors::Independent, Anchors::Cubature] {
        for count in [2, 7, 8, 9, 10, 27, 40] {
            let (state, bonds) = run_of(anchors, count, [7, 12]);
            assert_same_with_any_lanes(|arch| {
                let bonds = Bonds {
                    arch,
                    ..bonds.clone()
                };
                let loads = loads_of(&bonds, &state);
                let (f, t) = (loads.force, loads.torque);
                [f.x, f.y, f.z, t.x, t.y, t.z].concat()
            });
        }
    }
}

#[test]
fn shared_bonds_are_stored_once() {
    for anchors in [Anchors::Identical, Anchors::Cubature] {
        let (state, shared) = run_of(anchors, 27, [7, 12]);
        let of_pair = |pair: &Pair| -> f64 {
            let bonds = shared.bonds_of(pair).zip(shared.ends_of(pair, &state));
            bonds
                .map(|(bond, [from, to])| {
                    let stretch = (to - from).norm() - bond.rest_length;
                    0.5 * pair.rigidity * bond.weight * stretch * stretch
                })
                .sum()
        };
        let mut energies = vec![0.0; shared.elements()];
        shared.write_energies(&state, &mut energies);
        for (pair, energy) in shared.pairs().iter().zip(&energies) {
            let weights: f64 = shared.bonds_of(pair).map(|bond| bond.weight).sum();
            assert!((weights - 1.0).abs() < 1e-14);
            assert!((energy / of_pair(pair) - 1.0).abs() < 1e-12, "{pair:?}");
        }
    }
}

#[test]
fn loads_do_not_depend_on_the_order_of_quadrature_bonds() {
    let (state, bonds) = run_of(Anchors::Cubature, 11, [12, 12]);
    let mut other = bonds.clone();
    for (table, kind) in other.tables.iter_mut().zip(InterfaceKind::ALL) {
        let pair = bonds.pairs().iter().find(|pair| pair.kind == kind).unwrap();
        let mut reversed: Vec<Bond> = bonds.bonds_of(pair).collect();
        reversed.reverse();
        let empty = BondTable::new(table.step, table.bonds, pair.rigidity, true);
        *table = empty.shared_by(table.pairs, &reversed);
    }
    let (one, two) = (loads_of(&bonds, &state), loads_of(&other, &state));
    assert!(one != two && difference(&one, &two) < 1e-13);
    assert!((bonds.energy(&state) / other.energy(&state) - 1.0).abs() < 1e-13);
}

#[test]
fn a_single_monomer_has_no_bonds() {
    let (state, bonds) = run(1, [3, 3]);
    assert_eq!(bonds.elements(), 0);
    assert_eq!(loads_of(&bonds, &state), Loads::zeros(&state));
}

/// Two bodies 1 nm apart with one bond of length 1 and stiffness 3 whose anchors coincide.
fn coincident() -> (State, Bonds) {
    let mut state = State::default();
    push_unrelated_body(&mut state);
    push_unrelated_body(&mut state);
    state.points.position.set(1, Vector3::new(1.0, 0.0, 0.0));
    let (_, mut bonds) = run(2, [1, 1]);
    bonds.monomers.first_point = 0;
    bonds.monomers.first_frame = 0;
    bonds.tables[0] = BondTable::new(1, 1, 3.0, false);
    bonds.tables[0].push(&[Bond {
        lower: Vector3::new(0.5, 0.0, 0.0),
        upper: Vector3::new(-0.5, 0.0, 0.0),
        rest_length: 1.0,
        weight: 1.0,
    }]);
    (state, bonds)
}

#[test]
fn coincident_anchors_exert_no_force() {
    let (mut state, bonds) = coincident();
    assert_eq!(loads_of(&bonds, &state), Loads::zeros(&state));
    assert!((bonds.energy(&state) - 1.5).abs() < 1e-15);
    let apart = Vector3::new(1.0 + 1e-9, 0.0, 0.0);
    state.points.position.set(1, apart);
    let force = loads_of(&bonds, &state).force.get(1);
    assert!((force - Vector3::new(3.0, 0.0, 0.0)).norm() < 1e-8);
}

/// `k 1` at zero length; nearby `k` along and `k (1 - L / |d|)` across.
#[test]
fn coincident_anchors_have_a_finite_stiffness() {
    let (mut state, bonds) = coincident();
    let place = |state: &State| {
        let stiffness = stiffness_of(&bonds, state);
        let blocks = stiffness.blocks();
        assert!(blocks.iter().all(|b| b.2.iter().all(|k| k.is_finite())));
        assert_eq!(blocks[0].0, Coordinates::Point(0));
        blocks[0].2
    };
    assert_eq!(place(&state), Matrix3::from_diagonal_element(3.0));
    let distance = 2.0_f64.powi(-30);
    let apart = Vector3::new(1.0 + distance, 0.0, 0.0);
    state.points.position.set(1, apart);
    let across = 3.0 * (1.0 - 1.0 / distance);
    let expected = Matrix3::from_diagonal(&Vector3::new(3.0, across, across));
    assert!((place(&state) - expected).amax() < 1e-15 * across.abs());
}

fn stiffness_of(bonds: &Bonds, state: &State) -> Stiffness {
    let mut stiffness = Stiffness::default();
    bonds.add_stiffness(state, &mut stiffness);
    stiffness
}

/// Sums of a dozen terms and their rotations have a rounding error of 1e-14.
#[test]
fn stiffness_is_the_same_on_any_processor() {
    let counts = [1, 2, 3, 5, 8, 9, 10, 11, 27];
    let kinds = [Anchors::Independent, Anchors::Cubature];
    for (count, anchors) in counts.into_iter().zip(kinds.into_iter().cycle()) {
        let (state, vector) = run_of(anchors, count, [7, 12]);
        let scalar = Bonds {
            arch: Arch::Scalar,
            ..vector.clone()
        };
        let (vector, scalar) = (stiffness_of(&vector, &state), stiffness_of(&scalar, &state));
        assert_eq!(vector.blocks().len(), 10 * (2 * count).saturating_sub(3));
        let largest = vector
            .blocks()
            .iter()
            .map(|b| b.2.amax())
            .fold(0.0, f64::max);
        for (a, b) in vector.blocks().iter().zip(scalar.blocks()) {
            assert_eq!((a.0, a.1), (b.0, b.1));
            assert!((a.2 - b.2).amax() < 1e-13 * largest, "{count} monomers");
        }
    }
}

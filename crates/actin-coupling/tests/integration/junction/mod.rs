mod stress;

use actin_cosserat::{CrossSection, Rigidities, RodLayout, RodMaterial, StraightRod};
use actin_coupling::{
    AttachedMonomer, Junction, JunctionError, JunctionParts, JunctionSide, JunctionWeight,
    push_junction_frames,
};
use actin_mechanics::testing::{
    assert_is_balanced, assert_is_gradient, assert_is_invariant, assert_is_stiffness, loads_of,
    move_rigidly,
};
use actin_mechanics::testing::{push_frame, push_point};
use actin_mechanics::{Interaction, State, UnitQuaternion, Vector3, rotation};
use actin_mechanics::{Xorshift, perturb};
use proptest::prelude::*;
use std::ops::Range;

const RISE: f64 = 71.2 / 26.0;
const SIDES: [JunctionSide; 2] = [JunctionSide::MonomersFirst, JunctionSide::RodFirst];
const WEIGHTS: [JunctionWeight; 2] = [JunctionWeight::Shared, JunctionWeight::Full];

fn material() -> RodMaterial {
    RodMaterial::new(Rigidities {
        shear: Vector3::new(1.6e4, 2.1e4, 3.4e4),
        bend: Vector3::new(3.9e4, 2.7e4, 1.3e4),
    })
    .unwrap()
}

/// Filament at rest along z: one or two monomers on a helix and a rod of two segments of 10 nm with
/// its end at the origin.
struct Filament {
    state: State,
    monomers: Vec<AttachedMonomer>,
    frames: Range<usize>,
    rod: RodLayout,
}

/// Adds monomers at the given axial coordinates (nm) on a helix of radius 1.8 nm.
fn push_monomers(state: &mut State, heights: &[f64]) -> Vec<AttachedMonomer> {
    let monomer = |(k, &height): (usize, &f64)| {
        let turn = rotation::exp(Vector3::z() * (0.4 - 2.9 * k as f64));
        AttachedMonomer {
            point: push_point(
                state,
                turn * Vector3::x() * 1.8 + Vector3::z() * height,
                0.0697,
            ),
            frame: push_frame(state, turn, [0.2, 0.15, 0.15]),
        }
    };
    heights.iter().enumerate().map(monomer).collect()
}

fn filament(side: JunctionSide, attached: usize) -> Filament {
    let mut state = State::default();
    let section = CrossSection::actin();
    let along_z = UnitQuaternion::identity();
    let near = [0.5 * RISE, 1.5 * RISE];
    let mut rod = StraightRod::uniform(2, 10.0);
    let (monomers, frames, rod) = match side {
        JunctionSide::MonomersFirst => {
            let mut distances = near[..attached].to_vec();
            distances.reverse();
            let heights: Vec<f64> = distances.iter().map(|z| -z).collect();
            let monomers = push_monomers(&mut state, &heights);
            let frames = push_junction_frames(&mut state, along_z, &distances, &section).unwrap();
            (monomers, frames, rod.push(&mut state).unwrap())
        }
        JunctionSide::RodFirst => {
            rod.start.z = -20.0;
            let rod = rod.push(&mut state).unwrap();
            let distances = &near[..attached];
            let frames = push_junction_frames(&mut state, along_z, distances, &section).unwrap();
            (push_monomers(&mut state, distances), frames, rod)
        }
    };
    Filament {
        state,
        monomers,
        frames,
        rod,
    }
}

impl Filament {
    fn junction(&self, side: JunctionSide, weight: JunctionWeight) -> Junction {
        Junction::new(&self.state, self.parts(side, weight)).unwrap()
    }

    fn parts(&self, side: JunctionSide, weight: JunctionWeight) -> JunctionParts<'_> {
        JunctionParts {
            side,
            weight,
            monomers: &self.monomers,
            frames: self.frames.clone(),
            rod: &self.rod,
            material: material(),
        }
    }

    fn moved(mut self, noise: &mut Xorshift) -> Self {
        move_rigidly(&mut self.state, noise.vector(), noise.vector() * 10.0);
        self
    }

    fn move_monomers(&mut self, turn: f64, shift: f64) {
        let turn = rotation::exp(Vector3::z() * turn);
        for monomer in &self.monomers {
            let x = turn * self.state.points.position.get(monomer.point) + Vector3::z() * shift;
            self.state.points.position.set(monomer.point, x);
            let q = turn * self.state.frames.orientation.get(monomer.frame);
            self.state.frames.orientation.set(monomer.frame, q);
        }
    }

    fn turn_junction(&mut self, turn: f64) {
        for frame in self.frames.clone() {
            let q = rotation::exp(Vector3::z() * turn);
            self.state.frames.orientation.set(frame, q);
        }
    }
}

fn all() -> impl Iterator<Item = (JunctionSide, JunctionWeight, usize)> {
    SIDES.into_iter().flat_map(|side| {
        WEIGHTS
            .into_iter()
            .flat_map(move |weight| [1, 2].map(|attached| (side, weight, attached)))
    })
}

#[test]
fn loads_and_stiffness_are_derivatives_far_from_rest() {
    let mut noise = Xorshift::new(1);
    for (side, weight, attached) in all() {
        let mut filament = filament(side, attached).moved(&mut noise);
        let junction = filament.junction(side, weight);
        perturb(&mut filament.state, &mut noise, 0.7, 0.5);
        // h = 0.01 nm and rad: truncation and rounding errors are below 1e-12.
        assert_is_gradient(&junction, &filament.state, 0.01, 1e-10);
        assert_is_stiffness(&junction, &filament.state, 0.01, 1e-10);
    }
}

fn assert_joined(junction: &Junction, state: &State, side: usize, rod: usize) {
    let joined = junction.joined_elements();
    assert_eq!(joined.len(), 2);
    for (joined, curvatures) in joined.iter().zip(junction.curvatures(state)) {
        let q = joined.frames.map(|f| state.frames.orientation.get(f));
        let kappa = joined.element.curvature(q[0], q[1]);
        assert!((kappa - curvatures[side]).norm() < 1e-14);
        assert_eq!(joined.frames[side], rod);
    }
}

/// Right-handed twist is positive in all elements of both kinds of junctions; the energy is even in
/// the curvature.
#[test]
fn curvatures_follow_the_filament() {
    for side in SIDES {
        let mut filament = filament(side, 2);
        let junction = filament.junction(side, JunctionWeight::Shared);
        let rod = filament.rod.end_frame(side.rod_end());
        let near = filament.monomers.iter().zip(filament.frames.clone());
        let bonds: Vec<_> = near.map(|(&monomer, frame)| (monomer, frame)).collect();
        let mut turn = |frame: usize, angle: f64| {
            let q = &mut filament.state.frames.orientation;
            q.set(frame, rotation::exp(Vector3::z() * angle) * q.get(frame));
        };
        // In each bond the first frame is fixed, the junction frame rotates by 0.01 and the last
        // frame by 0.03.
        let monomers_first = side == JunctionSide::MonomersFirst;
        for &(monomer, frame) in &bonds {
            turn(frame, 0.01);
            if !monomers_first {
                turn(monomer.frame, 0.03);
            }
        }
        if monomers_first {
            turn(rod, 0.03);
        }
        let curvatures = junction.curvatures(&filament.state);
        assert_eq!(curvatures.len(), 2);
        for ((monomer, _), [before, after]) in bonds.iter().zip(curvatures) {
            let height = filament.state.points.position.get(monomer.point).z.abs();
            let (to_monomer, to_rod) = (0.5 * height, 5.0 + 0.5 * height);
            let expected = if monomers_first {
                [0.01 / to_monomer, 0.02 / to_rod]
            } else {
                [0.01 / to_rod, 0.02 / to_monomer]
            };
            assert!((before - Vector3::z() * expected[0]).norm() < 1e-14);
            assert!((after - Vector3::z() * expected[1]).norm() < 1e-14);
        }
        assert_joined(&junction, &filament.state, usize::from(monomers_first), rod);
    }
}

proptest! {
    #[test]
    fn linear_and_angular_momentum_balance(seed: u64, kind in 0_usize..8) {
        let (side, weight, attached) = all().nth(kind).unwrap();
        let mut noise = Xorshift::new(seed);
        let mut filament = filament(side, attached).moved(&mut noise);
        let junction = filament.junction(side, weight);
        perturb(&mut filament.state, &mut noise, 0.7, 0.5);
        // Sums of a dozen products are accurate to a few units of rounding.
        assert_is_balanced(&junction, &filament.state, 1e-14);
        assert_is_invariant(&junction, &filament.state, 1e-13);
    }
}

#[test]
fn rotation_of_monomers_and_junction_frames_twists_the_rod_element() {
    let turn = 0.02;
    for (side, weight, attached) in all() {
        let mut filament = filament(side, attached);
        let junction = filament.junction(side, weight);
        filament.move_monomers(turn, 0.0);
        filament.turn_junction(turn);
        let mut energies = vec![0.0; attached];
        junction.write_energies(&filament.state, &mut energies);
        for (monomer, energy) in filament.monomers.iter().zip(energies) {
            let height = filament.state.points.position.get(monomer.point).z.abs();
            let distance = 5.0 + 0.5 * height;
            let expected = weight.per_bond(attached) * 0.5 * 1.3e4 * turn * turn / distance;
            assert!((energy / expected - 1.0).abs() < 1e-12);
        }
        let loads = loads_of(&junction, &filament.state);
        let rod = filament.rod.end_frame(side.rod_end());
        assert!(loads.torque.get(rod).z > 0.0);
        for monomer in &filament.monomers {
            assert!(loads.torque.get(monomer.frame).norm() < 1e-9);
            assert!(loads.force.get(monomer.point).norm() < 1e-9);
        }
    }
}

#[test]
fn monomers_twist_against_their_junction_frames() {
    for side in SIDES {
        let mut filament = filament(side, 2);
        let junction = filament.junction(side, JunctionWeight::Full);
        for monomer in filament.monomers.clone() {
            let turn = rotation::exp(Vector3::z() * 0.01);
            let q = turn * filament.state.frames.orientation.get(monomer.frame);
            filament.state.frames.orientation.set(monomer.frame, q);
        }
        let loads = loads_of(&junction, &filament.state);
        for (monomer, frame) in filament.monomers.iter().zip(filament.frames.clone()) {
            let height = filament.state.points.position.get(monomer.point).z.abs();
            let couple = 1.3e4 * 0.01 / (0.5 * height);
            // Body axis z of the monomers is the axis of the filament at rest.
            assert!((loads.torque.get(monomer.frame).z + couple).abs() < 1e-9);
            assert!((loads.torque.get(frame).z - couple).abs() < 1e-9);
        }
    }
}

/// The axial force of each bond is S3 times the shift over its length.
#[test]
fn a_stretched_junction_pulls_together() {
    let shift = 1e-3;
    for (side, weight, attached) in all() {
        let mut filament = filament(side, attached);
        let junction = filament.junction(side, weight);
        let outward = match side {
            JunctionSide::MonomersFirst => -1.0,
            JunctionSide::RodFirst => 1.0,
        };
        let lengths: Vec<f64> = filament
            .monomers
            .iter()
            .map(|monomer| filament.state.points.position.get(monomer.point).norm())
            .collect();
        filament.move_monomers(0.0, outward * shift);
        let loads = loads_of(&junction, &filament.state);
        let mut total = 0.0;
        for (monomer, length) in filament.monomers.iter().zip(lengths) {
            let expected = weight.per_bond(attached) * 3.4e4 * shift / length;
            let force = loads.force.get(monomer.point);
            assert!((force + Vector3::z() * (outward * expected)).norm() < 1e-9);
            total += expected;
        }
        let end = filament.rod.end_point(side.rod_end());
        assert!((loads.force.get(end) - Vector3::z() * (outward * total)).norm() < 1e-9);
    }
}

fn bond_frames(f: &Filament, side: JunctionSide) -> [usize; 3] {
    let rod = f.rod.end_frame(side.rod_end());
    [f.monomers[0].frame, f.frames.start, rod]
}

#[test]
fn both_sides_are_mirror_images() {
    let half_turn = rotation::exp(Vector3::x() * std::f64::consts::PI);
    let material = RodMaterial::new(Rigidities::table4()).unwrap();
    let mut noise = Xorshift::new(5);
    let mut before = filament(JunctionSide::MonomersFirst, 1);
    let mut after = filament(JunctionSide::RodFirst, 1);
    let (from, to) = (before.monomers[0], after.monomers[0]);
    let x = half_turn * before.state.points.position.get(from.point);
    after.state.points.position.set(to.point, x);
    let make = |f: &Filament, side| {
        let parts = JunctionParts {
            material,
            ..f.parts(side, JunctionWeight::Full)
        };
        Junction::new(&f.state, parts).unwrap()
    };
    let junctions = [
        make(&before, JunctionSide::MonomersFirst),
        make(&after, JunctionSide::RodFirst),
    ];
    let pairs = bond_frames(&before, JunctionSide::MonomersFirst)
        .into_iter()
        .zip(bond_frames(&after, JunctionSide::RodFirst));
    for (i, j) in pairs {
        let turn = noise.vector() * 0.3;
        let q = rotation::exp(turn) * before.state.frames.orientation.get(i);
        before.state.frames.orientation.set(i, q);
        let q = rotation::exp(half_turn * turn) * after.state.frames.orientation.get(j);
        after.state.frames.orientation.set(j, q);
    }
    let shift = noise.vector() * 0.5;
    before.state.points.position.add(from.point, shift);
    after.state.points.position.add(to.point, half_turn * shift);
    let energies = [
        junctions[0].energy(&before.state),
        junctions[1].energy(&after.state),
    ];
    // Equal transverse rigidities make the rotation a symmetry of the material.
    assert!(
        (energies[0] / energies[1] - 1.0).abs() < 1e-12,
        "{energies:?}"
    );
}

#[test]
fn weights_scale_the_whole_junction() {
    let mut noise = Xorshift::new(6);
    for (attached, ratio) in [(1, 1.0), (2, 0.5)] {
        let mut filament = filament(JunctionSide::MonomersFirst, attached);
        let [shared, full] =
            WEIGHTS.map(|weight| filament.junction(JunctionSide::MonomersFirst, weight));
        perturb(&mut filament.state, &mut noise, 0.3, 0.3);
        let expected = ratio * full.energy(&filament.state);
        assert!((shared.energy(&filament.state) - expected).abs() < 1e-12 * expected);
    }
}

#[test]
fn invalid_junctions_are_refused() {
    let side = JunctionSide::MonomersFirst;
    let made = |f: &Filament, frames: Range<usize>| {
        let parts = JunctionParts {
            frames,
            ..f.parts(side, JunctionWeight::Shared)
        };
        Junction::new(&f.state, parts).map(|_| ())
    };

    let mut good = filament(side, 2);
    assert_eq!(made(&good, good.frames.clone()), Ok(()));
    let first = good.frames.start;
    let too_few = JunctionError::JunctionFrames {
        frames: 1,
        monomers: 2,
    };
    assert_eq!(made(&good, first..first + 1), Err(too_few));

    let turned = rotation::exp(Vector3::y() * 0.1);
    good.state.frames.orientation.set(first, turned);
    assert!(matches!(
        made(&good, good.frames.clone()),
        Err(JunctionError::NotParallel { frame, angle })
            if frame == first && (angle - 0.1).abs() < 1e-12
    ));

    let mut wrong_side = filament(side, 2);
    let point = wrong_side.monomers[1].point;
    let lift = Vector3::z() * RISE;
    wrong_side.state.points.position.add(point, lift);
    assert!(matches!(
        made(&wrong_side, wrong_side.frames.clone()),
        Err(JunctionError::AxialDistance { monomer: 1, distance })
            if (distance + 0.5 * RISE).abs() < 1e-12
    ));

    let mut none = filament(side, 1);
    none.monomers.clear();
    let expected = Err(JunctionError::AttachedMonomers(0));
    assert_eq!(made(&none, none.frames.clone()), expected);
}

//! Random stress of rods: forces that shift rest strains, and torques that shift rest curvatures.
//!
//! Without extension, a segment has the energy `-L n . sigma` and a bending element
//! `-Dhat m . kappa`, with three random numbers each, segments first.
//!
//! With extension, strain and curvature are correlated. Half of the bending energy on each side is
//! assigned to the segment:
//!
//! ```text
//! L/2 (U(kappa_1) + U(kappa_2)) = L U(kappa) + L/2 U''((kappa_2 - kappa_1)/2) + ...
//! E = -L (n . sigma + w_1 m_1 . kappa_1 + w_2 m_2 . kappa_2)
//! ```
//!
//! `kappa_1` and `kappa_2` are the mean curvatures of both sides, `kappa` is their mean, `w` is
//! 1/2, or 1 for a segment with a single side: nine numbers per segment.
//!
//! Stresses of axisymmetric rods follow the spins of their frames during a step
//! ([`RandomStress::turn_back`]), and the matrix of a step couples these spins to twist and stretch
//! alone.
//!
//! Axial torques on frames are due to twist alone. Only friction resists axial rotations, so that
//! other torques would rotate frames until the stress increases the existing bending.

use crate::extended::{ExtendedSegments, SegmentJet, SegmentSurroundings};
use crate::{BendingElement, EnergyGradient, RodLayout, RodMaterial, ShearElement};
use actin_mechanics::{
    InternalCouple, InternalForce, Loads, Matrix3, RandomStress, SecondOrder, State, StepStress,
    Stiffness, UnitQuaternion, Vector3, correlate,
};
use nalgebra::SMatrix;
use std::ops::Range;

const VECTOR: usize = 3;
const EXTENDED: usize = 9;

/// Transforms deviates to covariance `c`.
fn drawn(c: Matrix3, deviates: &[f64]) -> Vector3 {
    let mut values = [deviates[0], deviates[1], deviates[2]];
    correlate(c, &mut values);
    values.into()
}

fn drawn_together(jet: &SegmentJet, scale: f64, deviates: &[f64]) -> [Vector3; 2] {
    let mut c = SMatrix::<f64, 6, 6>::zeros();
    c.fixed_view_mut::<3, 3>(0, 0).copy_from(&jet.by_strain);
    c.fixed_view_mut::<3, 3>(3, 0)
        .copy_from(&jet.mixed.transpose());
    c.fixed_view_mut::<3, 3>(3, 3).copy_from(&jet.by_curvature);
    let mut values: [f64; 6] = std::array::from_fn(|k| deviates[k]);
    correlate(c * scale, &mut values);
    let [a, b, c, d, e, f] = values;
    [Vector3::new(a, b, c), Vector3::new(d, e, f)]
}

fn vector(values: &[f64]) -> Vector3 {
    Vector3::new(values[0], values[1], values[2])
}

struct Parts<'a> {
    rod: &'a EnergyGradient,
    stresses: &'a [f64],
}

impl Parts<'_> {
    fn split(&self) -> (&[f64], &[f64]) {
        self.stresses
            .split_at(stride(self.rod) * self.rod.layout().segments())
    }

    fn forces(&self) -> impl Iterator<Item = InternalForce> {
        let layout = self.rod.layout();
        let bodies = layout.points().zip(layout.frames());
        let stresses = self.split().0.chunks_exact(stride(self.rod)).zip(bodies);
        stresses.enumerate().map(|(k, (stress, (i, frame)))| {
            let extended = self.rod.extended();
            let factors = extended.map_or_else(|| Vector3::repeat(1.0), |e| e.factors(k));
            InternalForce {
                points: [i, i + 1],
                frame,
                force: vector(stress).component_mul(&factors),
            }
        })
    }

    fn couples(&self) -> impl Iterator<Item = InternalCouple> {
        let layout = self.rod.layout();
        let own = self.split().1.chunks_exact(VECTOR);
        let own = own.zip(layout.bending_chain()).map(|(stress, a)| {
            let couple = vector(stress);
            InternalCouple {
                frames: [a, a + 1],
                rest: UnitQuaternion::identity(),
                couple,
            }
        });
        let extended = self.rod.extended().into_iter();
        let sides = extended.flat_map(move |extended| {
            (0..layout.segments()).flat_map(move |k| {
                extended.side_elements(k, layout).map(move |around| {
                    let stress = &self.stresses[EXTENDED * k + VECTOR * (1 + around.side)..];
                    InternalCouple {
                        frames: around.frames,
                        rest: UnitQuaternion::identity(),
                        couple: vector(stress) * around.weight,
                    }
                })
            })
        });
        own.chain(sides)
    }
}

fn stride(rod: &EnergyGradient) -> usize {
    if rod.extended().is_some() {
        EXTENDED
    } else {
        VECTOR
    }
}

fn strains<'a>(
    layout: &'a RodLayout,
    state: &'a State,
) -> impl Iterator<Item = (Vector3, f64)> + 'a {
    let bodies = layout.points().zip(layout.frames());
    let lengths = layout.segment_lengths().iter();
    lengths.zip(bodies).map(|(&length, (i, frame))| {
        let l = state.points.position.get(i + 1) - state.points.position.get(i);
        let q = state.frames.orientation.get(frame);
        (ShearElement::segment(length).strain(q, l), length)
    })
}

fn curvatures<'a>(
    layout: &'a RodLayout,
    state: &'a State,
) -> impl Iterator<Item = (Vector3, f64)> + 'a {
    let q = &state.frames.orientation;
    let elements = layout.voronoi_lengths().iter().zip(layout.bending_chain());
    elements.map(|(&rest_distance, a)| {
        let element = BendingElement { rest_distance };
        (element.curvature(q.get(a), q.get(a + 1)), rest_distance)
    })
}

/// Writes stresses without extension. `force` and `couple` have the arguments material, strain or
/// curvature, length, and previous values.
fn write_separate(
    rod: &EnergyGradient,
    state: &State,
    stresses: &mut [f64],
    force: impl Fn(&RodMaterial, Vector3, f64, &[f64]) -> Vector3,
    couple: impl Fn(&RodMaterial, Vector3, f64, &[f64]) -> Vector3,
) {
    let (layout, material) = (rod.layout(), rod.material());
    let (forces, couples) = stresses.split_at_mut(VECTOR * layout.segments());
    for (stress, (sigma, length)) in forces.chunks_exact_mut(VECTOR).zip(strains(layout, state)) {
        let value = force(material, sigma, length, stress);
        stress.copy_from_slice(value.as_slice());
    }
    let elements = couples.chunks_exact_mut(VECTOR);
    for (stress, (kappa, length)) in elements.zip(curvatures(layout, state)) {
        let value = couple(material, kappa, length, stress);
        stress.copy_from_slice(value.as_slice());
    }
}

fn write_extended(
    (extended, rod): (&ExtendedSegments, &EnergyGradient),
    state: &State,
    stresses: &mut [f64],
    of: impl Fn(&SegmentSurroundings, &[f64]) -> [Vector3; 3],
) {
    for (k, stress) in stresses.chunks_exact_mut(EXTENDED).enumerate() {
        let values = of(&extended.surroundings(k, rod.layout(), state), stress);
        for (place, value) in stress.chunks_exact_mut(VECTOR).zip(values) {
            place.copy_from_slice(value.as_slice());
        }
    }
}

impl RandomStress for EnergyGradient {
    fn components(&self) -> usize {
        let bending = if self.extended().is_some() { 0 } else { VECTOR };
        let layout = self.layout();
        stride(self) * layout.segments() + bending * layout.voronoi_lengths().len()
    }

    fn draw(&self, state: &State, thermal_energy: f64, stresses: &mut [f64]) {
        let kt = thermal_energy;
        let Some(extended) = self.extended() else {
            return write_separate(
                self,
                state,
                stresses,
                |material, sigma, length, xi| {
                    drawn(material.shear_tangent(sigma) * (kt / length), xi)
                },
                |material, kappa, length, xi| {
                    drawn(material.bending_tangent(kappa) * (kt / length), xi)
                },
            );
        };
        let material = self.material();
        write_extended((extended, self), state, stresses, |around, xi| {
            let bending = around.bending_tangent(material);
            let mut jet = extended.law.jet(material, around.strain, around.curvature);
            jet.by_curvature += bending * around.curvature.covered;
            let scale = kt / around.length;
            let [force, couple] = drawn_together(&jet, scale, xi);
            let difference = if around.has_two_sides {
                drawn(bending * scale, &xi[2 * VECTOR..])
            } else {
                Vector3::zeros()
            };
            [force, couple - difference, couple + difference]
        });
    }

    fn balance(&self, state: &State, stresses: &mut [f64]) {
        let Some(extended) = self.extended() else {
            return write_separate(
                self,
                state,
                stresses,
                |material, sigma, _, _| material.shear_force(sigma),
                |material, kappa, _, _| material.bending_couple(kappa),
            );
        };
        let material = self.material();
        write_extended((extended, self), state, stresses, |around, _| {
            let (force, own) = extended
                .law
                .loads(material, around.strain, around.curvature);
            let couple = own + around.bending_couple(material) * around.curvature.covered;
            [force, couple, couple]
        });
    }

    fn axial_frames(&self) -> Range<usize> {
        // Other coupled laws take more iterations with decoupled spins.
        let is_coupled = self
            .extended()
            .is_some_and(|extended| self.material().laws().is_some() || !extended.is_straight());
        if self.material().is_axisymmetric() && !is_coupled {
            self.layout().free_frames()
        } else {
            0..0
        }
    }

    fn turn_back(&self, spins: &[f64], drawn: &[f64], turned: &mut [f64]) {
        let axial = self.axial_frames();
        if axial.is_empty() {
            return turned.copy_from_slice(drawn);
        }
        let layout = self.layout();
        let of_segments = layout.frames().map(|frame| spins[frame]);
        let of_joint = |frames: [usize; 2]| 0.5 * (spins[frames[0]] + spins[frames[1]]);
        let angles: Vec<f64> = if let Some(extended) = self.extended() {
            let of_segment = |(k, own): (usize, f64)| {
                let mut angles = [own; EXTENDED / VECTOR];
                for around in extended.side_elements(k, layout) {
                    angles[1 + around.side] = of_joint(around.frames);
                }
                angles
            };
            of_segments.enumerate().flat_map(of_segment).collect()
        } else {
            let joints = layout.voronoi_lengths().iter().zip(layout.bending_chain());
            let of_joints = joints.map(|(_, frame)| of_joint([frame, frame + 1]));
            of_segments.chain(of_joints).collect()
        };
        let vectors = drawn
            .chunks_exact(VECTOR)
            .zip(turned.chunks_exact_mut(VECTOR));
        for (spin, (drawn, turned)) in angles.into_iter().zip(vectors) {
            let (sin, cos) = spin.sin_cos();
            turned[0] = cos * drawn[0] + sin * drawn[1];
            turned[1] = cos * drawn[1] - sin * drawn[0];
            turned[2] = drawn[2];
        }
    }

    fn add_stress_loads(&self, state: &State, stresses: &[f64], loads: &mut Loads) {
        let parts = Parts {
            rod: self,
            stresses,
        };
        parts
            .forces()
            .for_each(|force| force.add_loads_without_spin(Vector3::z(), state, loads));
        parts
            .couples()
            .for_each(|couple| couple.add_loads_without_spin(state, loads));
    }

    fn add_stressed_stiffness(
        &self,
        state: &State,
        stress: &StepStress<'_>,
        stiffness: &mut Stiffness,
    ) {
        if self.extended().is_none() {
            let (forces, couples) = stress.values.split_at(VECTOR * self.layout().segments());
            self.add_stressed_segments(state, (forces, stress.is_turned), stiffness);
            return self.add_stressed_bending(state, (couples, stress.is_turned), stiffness);
        }
        let parts = Parts {
            rod: self,
            stresses: stress.values,
        };
        let of_stress = |stiffness: &mut Stiffness| {
            parts
                .forces()
                .for_each(|force| force.add_stiffness(state, stiffness));
            parts
                .couples()
                .for_each(|couple| couple.add_stiffness(state, stiffness));
        };
        if stress.is_turned {
            self.add_stiffness_without_spin(state, stiffness);
            stiffness.extend_without_spin(false, of_stress);
        } else {
            self.add_stiffness(state, stiffness);
            of_stress(stiffness);
        }
    }
}

impl EnergyGradient {
    /// Adds the stiffness of segments without extension. A stress acts as a force of opposite sign.
    fn add_stressed_segments(
        &self,
        state: &State,
        (forces, is_turned): (&[f64], bool),
        stiffness: &mut Stiffness,
    ) {
        let (layout, material) = (self.layout(), self.material());
        let forces = forces.chunks_exact(VECTOR).map(vector);
        let lengths = layout.segment_lengths().iter();
        let bodies = layout.points().zip(layout.frames());
        for ((force, &length), (i, frame)) in forces.zip(lengths).zip(bodies) {
            let l = state.points.position.get(i + 1) - state.points.position.get(i);
            let at = (state.frames.orientation.get(frame), l);
            let element = ShearElement::segment(length);
            let sigma = element.strain(at.0, at.1);
            let (own, tangent) = (material.shear_force(sigma), material.shear_tangent(sigma));
            let mut blocks = element.stiffness_of(own - force, tangent, at);
            if is_turned {
                let without = element.stiffness_of(own, tangent, at);
                blocks.mixed.fill_column(2, 0.0);
                decouple_axial(&mut blocks.frame, &without.frame);
            }
            blocks.push([i, i + 1], frame, stiffness);
        }
    }

    fn add_stressed_bending(
        &self,
        state: &State,
        (couples, is_turned): (&[f64], bool),
        stiffness: &mut Stiffness,
    ) {
        let (layout, material) = (self.layout(), self.material());
        let couples = couples.chunks_exact(VECTOR).map(vector);
        let distances = layout.voronoi_lengths().iter();
        for ((couple, &rest_distance), a) in couples.zip(distances).zip(layout.bending_chain()) {
            let orientation = &state.frames.orientation;
            let at = (orientation.get(a), orientation.get(a + 1));
            let element = BendingElement { rest_distance };
            let kappa = element.curvature(at.0, at.1);
            let (own, tangent) = (
                material.bending_couple(kappa),
                material.bending_tangent(kappa),
            );
            let mut blocks = element.stiffness_of(own - couple, tangent, at);
            if is_turned {
                let without = element.stiffness_of(own, tangent, at);
                decouple_axial(&mut blocks.first, &without.first);
                decouple_axial(&mut blocks.mixed, &without.mixed);
                decouple_axial(&mut blocks.second, &without.second);
            }
            blocks.push([a, a + 1], stiffness);
        }
    }
}

/// Decouples axial rotations and takes their stiffness from `without`.
fn decouple_axial(block: &mut Matrix3, without: &Matrix3) {
    block.fill_row(2, 0.0);
    block.fill_column(2, 0.0);
    block[(2, 2)] = without[(2, 2)];
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{End, Homogenised, Rigidities, RodClamp, StraightRod};
    use actin_mechanics::testing::assert_fluctuates;
    use actin_mechanics::{Coordinates, Xorshift, perturb};
    use std::collections::BTreeMap;

    fn clamped() -> (State, RodLayout) {
        let mut state = State::default();
        let rod = StraightRod::uniform(4, 10.0);
        let layout = rod.push_clamped(RodClamp::Wall, End::Start, &mut state);
        (state, layout.unwrap())
    }

    #[test]
    fn turned_stresses_exert_the_same_forces_after_a_spin() {
        let mut state = State::default();
        let layout = StraightRod::uniform(4, 10.0).push(&mut state).unwrap();
        perturb(&mut state, &mut Xorshift::new(3), 0.5, 0.1);
        for material in [
            RodMaterial::new(Rigidities::table4()).unwrap(),
            RodMaterial::homogenised(Homogenised::mean_filament_at_298_k()),
        ] {
            assert_spins(
                state.clone(),
                &EnergyGradient::new(layout.clone(), material),
            );
        }
    }

    fn assert_spins(mut state: State, rod: &EnergyGradient) {
        let layout = rod.layout();
        assert_eq!(rod.axial_frames(), layout.frames());
        let mut random = Xorshift::new(4);
        let drawn: Vec<f64> = (0..rod.components()).map(|_| random.sample()).collect();
        let loads_of = |state: &State, stresses: &[f64]| {
            let mut loads = Loads::zeros(state);
            rod.add_stress_loads(state, stresses, &mut loads);
            loads
        };
        let before = loads_of(&state, &drawn);
        let turn = actin_mechanics::rotation::exp(Vector3::z() * 0.7);
        for frame in layout.frames() {
            let q = state.frames.orientation.get(frame);
            state.frames.orientation.set(frame, q * turn);
        }
        let mut turned = vec![0.0; drawn.len()];
        rod.turn_back(&vec![0.7; state.frames.len()], &drawn, &mut turned);
        let after = loads_of(&state, &turned);
        for i in layout.points() {
            let difference = after.force.get(i) - before.force.get(i);
            assert!(difference.norm() < 1e-12, "{difference:?}");
        }
        for frame in layout.frames() {
            let difference = turn * after.torque.get(frame) - before.torque.get(frame);
            assert!(difference.norm() < 1e-11, "{difference:?}");
        }
    }

    /// In a straight rod, axial rotations are coupled to each other and to stretch alone.
    #[test]
    fn the_stiffness_without_spin_is_exact_for_straight_rods() {
        let mut state = State::default();
        let layout = StraightRod::uniform(4, 10.0).push(&mut state).unwrap();
        for (i, frame) in layout.points().zip(layout.frames()) {
            let x = state.points.position.get(i);
            state.points.position.set(i, 1.001 * x);
            let turn = actin_mechanics::rotation::exp(Vector3::z() * (0.1 * i as f64));
            state.frames.orientation.set(frame, turn);
        }
        let material = RodMaterial::homogenised(Homogenised::mean_filament_at_298_k());
        let rod = EnergyGradient::new(layout, material);
        let (mut whole, mut without) = (Stiffness::default(), Stiffness::default());
        rod.add_stiffness(&state, &mut whole);
        rod.add_stiffness_without_spin(&state, &mut without);
        let [whole, without] = [&whole, &without].map(sums);
        let largest = whole.values().map(Matrix3::amax).fold(0.0, f64::max);
        for (bodies, block) in &without {
            let difference = (block - whole[bodies]).amax();
            assert!(difference < 1e-12 * largest, "{bodies:?}: {difference}");
        }
        let twist_stretch = |(a, b): &&(Coordinates, Coordinates)| {
            a != b && without[&(*a, *b)].column(2).amax() > 1.0
        };
        assert!(without.keys().any(|bodies| twist_stretch(&bodies)));
    }

    /// Sums of the blocks of each pair of bodies.
    fn sums(stiffness: &Stiffness) -> BTreeMap<(Coordinates, Coordinates), Matrix3> {
        let mut all = BTreeMap::new();
        for (a, b, block) in stiffness.all() {
            let (bodies, block) = if a <= b {
                ((*a, *b), *block)
            } else {
                ((*b, *a), block.transpose())
            };
            *all.entry(bodies).or_insert_with(Matrix3::zeros) += block;
        }
        all
    }

    #[test]
    fn stress_of_separate_strains_has_the_covariance_of_the_stiffness() {
        let (mut state, layout) = clamped();
        for (i, frame) in layout.points().zip(layout.frames()) {
            let x = state.points.position.get(i);
            state.points.position.set(i, x * 1.01);
            let q = state.frames.orientation.get(frame);
            let turn = actin_mechanics::rotation::exp(Vector3::z() * (0.1 * i as f64));
            state.frames.orientation.set(frame, q * turn);
        }
        let law = EnergyGradient::new(layout, RodMaterial::new(Rigidities::table4()).unwrap());
        assert_fluctuates(&[&law], &state, 1e-12);
    }

    #[test]
    fn stress_of_bending_has_no_axial_torque() {
        let (mut state, layout) = clamped();
        let law = EnergyGradient::new(layout, RodMaterial::new(Rigidities::table4()).unwrap());
        perturb(&mut state, &mut Xorshift::new(8), 0.05, 0.05);
        let transverse = |k: usize| if k % VECTOR == 2 { 0.0 } else { 1.0 };
        let stresses: Vec<f64> = (0..law.components()).map(transverse).collect();
        let mut loads = Loads::zeros(&state);
        law.add_stress_loads(&state, &stresses, &mut loads);
        for torque in loads.torque.iter() {
            assert!(
                torque.z.abs() < 1e-15 && torque.xy().norm() > 0.1,
                "{torque}"
            );
        }
    }

    /// Tension makes the shear stiffness positive. Independent samples of curvature and strain
    /// would have 20 % too large fluctuations.
    #[test]
    fn stress_of_coupled_strains_has_the_covariance_of_the_stiffness() {
        for law in [
            Homogenised::mean_filament(),
            Homogenised::mean_filament_at_298_k(),
        ] {
            let (mut state, layout) = clamped();
            let law = EnergyGradient::new(layout.clone(), RodMaterial::homogenised(law));
            for i in layout.points() {
                let x = state.points.position.get(i);
                state.points.position.set(i, x * 1.001);
            }
            assert_fluctuates(&[&law], &state, 1e-12);
        }
    }
}

//! Rods of any topology and rest shape, as one interaction.

use crate::layout::is_length;
use crate::{BendingElement, RodError, RodLayout, RodMaterial, ShearElement};
use actin_mechanics::{
    Interaction, InternalCouple, InternalForce, Loads, RandomStress, SecondOrder, State,
    StepStress, Stiffness, UnitQuaternion, Vector3, correlate, rotation,
};

/// Stretch and shear between two points, in the axes of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RodSegment {
    /// Indices of the points.
    pub points: [usize; 2],
    /// Index of the frame. At rest its d3 points from the first to the second point.
    pub frame: usize,
    /// Rest length (nm).
    pub rest_length: f64,
}

/// Bending and twist between two frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RodJoint {
    /// Indices of the frames, in the order of the rod.
    pub frames: [usize; 2],
    /// Rest distance of the frames along the rod (nm).
    pub rest_distance: f64,
    /// Offsets `oa`, `ob` of the joint's frames in their bodies. The strain is
    /// `log((Qa oa)^T Qb ob)` divided by the rest distance.
    pub offsets: [UnitQuaternion; 2],
}

impl RodJoint {
    /// Joint with parallel frames at rest.
    pub fn straight(frames: [usize; 2], rest_distance: f64) -> Self {
        Self::curved(frames, rest_distance, Vector3::zeros())
    }

    /// Joint with a rest curvature (rad/nm, equal in the axes of both frames). The third component
    /// is a twist.
    ///
    /// The joint's frames are halfway between the frames of the bodies.
    pub fn curved(frames: [usize; 2], rest_distance: f64, curvature: Vector3) -> Self {
        let half = rotation::exp(curvature * (0.5 * rest_distance));
        Self {
            frames,
            rest_distance,
            offsets: [half, half.inverse()],
        }
    }

    fn element(&self) -> BendingElement {
        BendingElement {
            rest_distance: self.rest_distance,
        }
    }

    fn orientations(&self, state: &State) -> [UnitQuaternion; 2] {
        [0, 1].map(|k| state.frames.orientation.get(self.frames[k]) * self.offsets[k])
    }
}

/// Interaction `rod`: segments between points and joints between frames, of one material.
///
/// Elements are the segments, then the joints. For a straight rod the energy equals the energy of
/// [`EnergyGradient`](crate::EnergyGradient), which is faster.
///
/// ```
/// use actin_cosserat::{
///     Interaction, Rigidities, RodElements, RodMaterial, State, StraightRod, Vector3,
/// };
/// // A rod of 50 nm with a rest radius of 100 nm, held straight: B L / 2 R^2.
/// let mut state = State::default();
/// let rod = StraightRod::uniform(50, 1.0).push(&mut state)?;
/// let material = RodMaterial::new(Rigidities::table4())?;
/// rod.bend(&mut state, |_| Vector3::x() / 100.0)?;
/// let law = RodElements::at_rest(&state, &rod, material)?;
/// assert!(law.energy(&state) < 1e-12);
/// rod.bend(&mut state, |_| Vector3::zeros())?;
/// // The outer half segments have no joint, so that 49 of the 50 nm bend.
/// assert!((law.energy(&state) - 3.9e4 * 49.0 / 2e4).abs() < 1e-9);
/// # Ok::<(), actin_cosserat::RodError>(())
/// ```
///
/// Potentials are not supported, because segments have no access to the curvature around them.
#[derive(Clone, Debug, PartialEq)]
pub struct RodElements {
    material: RodMaterial,
    segments: Vec<RodSegment>,
    joints: Vec<RodJoint>,
}

impl RodElements {
    /// Creates a rod of segments and joints.
    ///
    /// # Errors
    /// If a rest length or distance, or its inverse, is not positive and finite; if an offset is
    /// not finite; if the material is a potential.
    pub fn new(
        material: RodMaterial,
        segments: Vec<RodSegment>,
        joints: Vec<RodJoint>,
    ) -> Result<Self, RodError> {
        check_laws(&material)?;
        for (segment, each) in segments.iter().enumerate() {
            let value = each.rest_length;
            if !is_length(value) {
                return Err(RodError::SegmentLength { segment, value });
            }
        }
        for (joint, each) in joints.iter().enumerate() {
            let value = each.rest_distance;
            if !is_length(value) {
                return Err(RodError::JointDistance { joint, value });
            }
            let mut offsets = each.offsets.iter().flat_map(|q| q.coords.iter());
            if !offsets.all(|component| component.is_finite()) {
                return Err(RodError::RestShape { joint });
            }
        }
        Ok(Self {
            material,
            segments,
            joints,
        })
    }

    /// Creates a rod with the rest lengths of `layout` and the curvature of `state` as its rest
    /// shape.
    ///
    /// # Errors
    /// If the material is a potential, or if orientations are not finite.
    ///
    /// # Panics
    /// If `state` does not have the rod's bodies.
    pub fn at_rest(
        state: &State,
        layout: &RodLayout,
        material: RodMaterial,
    ) -> Result<Self, RodError> {
        let bodies = layout.points().zip(layout.frames());
        let segments = bodies.zip(layout.segment_lengths());
        let segments = segments.map(|((i, frame), &rest_length)| RodSegment {
            points: [i, i + 1],
            frame,
            rest_length,
        });
        let q = &state.frames.orientation;
        let joints = layout.bending_chain().zip(layout.voronoi_lengths());
        let joints = joints.map(|(a, &rest_distance)| {
            let element = BendingElement { rest_distance };
            let curvature = element.curvature(q.get(a), q.get(a + 1));
            RodJoint::curved([a, a + 1], rest_distance, curvature)
        });
        Self::new(material, segments.collect(), joints.collect())
    }

    /// Curvature of each joint relative to the rest shape (rad/nm, axes of the joint's frames).
    pub(crate) fn curvatures<'a>(
        &'a self,
        state: &'a State,
    ) -> impl ExactSizeIterator<Item = Vector3> + 'a {
        self.joints.iter().map(|joint| {
            let [qa, qb] = joint.orientations(state);
            joint.element().curvature(qa, qb)
        })
    }
}

fn check_laws(material: &RodMaterial) -> Result<(), RodError> {
    let laws = material.laws().map(|_| ());
    laws.ok_or(RodError::Potential("RodElements"))
}

impl RodSegment {
    fn element(&self) -> ShearElement {
        ShearElement::segment(self.rest_length)
    }

    fn placed(&self, state: &State) -> (UnitQuaternion, Vector3) {
        let x = &state.points.position;
        let l = x.get(self.points[1]) - x.get(self.points[0]);
        (state.frames.orientation.get(self.frame), l)
    }
}

impl Interaction for RodElements {
    fn term(&self) -> &'static str {
        "rod"
    }

    fn elements(&self) -> usize {
        self.segments.len() + self.joints.len()
    }

    fn add_loads(&self, state: &State, loads: &mut Loads) {
        for segment in &self.segments {
            let (q, l) = segment.placed(state);
            let shear = segment.element().loads(&self.material, q, l);
            loads.force.add(segment.points[0], shear.force);
            loads.force.add(segment.points[1], -shear.force);
            loads.torque.add(segment.frame, shear.torque);
        }
        for joint in &self.joints {
            let [qa, qb] = joint.orientations(state);
            let couple = joint.element().loads(&self.material, qa, qb);
            let torques = [couple.first, couple.second];
            for ((frame, offset), torque) in joint.frames.iter().zip(&joint.offsets).zip(torques) {
                loads.torque.add(*frame, offset * torque);
            }
        }
    }

    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        assert_eq!(energies.len(), self.elements(), "one energy per element");
        let (shear, bending) = energies.split_at_mut(self.segments.len());
        for (energy, segment) in shear.iter_mut().zip(&self.segments) {
            let (q, l) = segment.placed(state);
            *energy = segment.element().energy(&self.material, q, l);
        }
        for (energy, joint) in bending.iter_mut().zip(&self.joints) {
            let [qa, qb] = joint.orientations(state);
            *energy = joint.element().energy(&self.material, qa, qb);
        }
    }

    fn second_order(&self) -> Option<&dyn SecondOrder> {
        Some(self)
    }

    fn random_stress(&self) -> Option<&dyn RandomStress> {
        Some(self)
    }
}

impl RodElements {
    fn internal(&self, stresses: &[f64]) -> (Vec<InternalForce>, Vec<InternalCouple>) {
        let (vectors, _) = stresses.as_chunks::<3>();
        let (forces, couples) = vectors.split_at(self.segments.len());
        let forces = self.segments.iter().zip(forces);
        let forces = forces.map(|(segment, force)| InternalForce {
            points: segment.points,
            frame: segment.frame,
            force: Vector3::from(*force),
        });
        let couples = self.joints.iter().zip(couples).map(|(joint, couple)| {
            let [a, b] = joint.offsets;
            InternalCouple {
                frames: joint.frames,
                // log(ob oa^T Qa^T Qb) = ob log((Qa oa)^T Qb ob).
                rest: a * b.inverse(),
                couple: b * Vector3::from(*couple),
            }
        });
        (forces.collect(), couples.collect())
    }
}

impl RandomStress for RodElements {
    fn components(&self) -> usize {
        3 * self.elements()
    }

    fn draw(&self, state: &State, thermal_energy: f64, stresses: &mut [f64]) {
        let (vectors, _) = stresses.as_chunks_mut::<3>();
        let (forces, couples) = vectors.split_at_mut(self.segments.len());
        for (segment, force) in self.segments.iter().zip(forces) {
            let (q, l) = segment.placed(state);
            let tangent = (self.material).shear_tangent(segment.element().strain(q, l));
            correlate(tangent * (thermal_energy / segment.rest_length), force);
        }
        let curvatures = self.curvatures(state).zip(&self.joints);
        for ((curvature, joint), couple) in curvatures.zip(couples) {
            let tangent = self.material.bending_tangent(curvature);
            correlate(tangent * (thermal_energy / joint.rest_distance), couple);
        }
    }

    fn balance(&self, state: &State, stresses: &mut [f64]) {
        let (vectors, _) = stresses.as_chunks_mut::<3>();
        let (forces, couples) = vectors.split_at_mut(self.segments.len());
        for (segment, force) in self.segments.iter().zip(forces) {
            let (q, l) = segment.placed(state);
            let strain = segment.element().strain(q, l);
            *force = self.material.shear_force(strain).into();
        }
        for (curvature, couple) in self.curvatures(state).zip(couples) {
            *couple = self.material.bending_couple(curvature).into();
        }
    }

    fn add_stress_loads(&self, state: &State, stresses: &[f64], loads: &mut Loads) {
        let (forces, couples) = self.internal(stresses);
        for force in &forces {
            force.add_loads(state, loads);
        }
        for couple in &couples {
            couple.add_loads(state, loads);
        }
    }

    fn add_stressed_stiffness(
        &self,
        state: &State,
        stress: &StepStress<'_>,
        stiffness: &mut Stiffness,
    ) {
        self.add_stiffness(state, stiffness);
        let (forces, couples) = self.internal(stress.values);
        for force in &forces {
            force.add_stiffness(state, stiffness);
        }
        for couple in &couples {
            couple.add_stiffness(state, stiffness);
        }
    }
}

impl SecondOrder for RodElements {
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        for segment in &self.segments {
            let (q, l) = segment.placed(state);
            let shear = segment.element().stiffness(&self.material, q, l);
            shear.push(segment.points, segment.frame, stiffness);
        }
        for joint in &self.joints {
            let [qa, qb] = joint.orientations(state);
            let blocks = joint.element().stiffness(&self.material, qa, qb);
            let blocks = blocks.in_bodies(joint.offsets);
            blocks.push(joint.frames, stiffness);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{End, EnergyGradient, Rigidities, RodClamp, StraightRod};
    use actin_mechanics::testing::{
        assert_fluctuates, assert_is_balanced, assert_is_gradient, assert_is_stiffness, loads_of,
    };
    use actin_mechanics::{Xorshift, perturb};

    fn curved() -> (State, RodElements) {
        let mut state = State::default();
        let rod = StraightRod::uniform(4, 2.0);
        let layout = rod.push_clamped(RodClamp::Wall, End::End, &mut state);
        let layout = layout.unwrap();
        let material = RodMaterial::new(Rigidities::table4()).unwrap();
        layout
            .bend(&mut state, |s| Vector3::new(0.02 * s, -0.1, 0.05))
            .unwrap();
        let law = RodElements::at_rest(&state, &layout, material).unwrap();
        (state, law)
    }

    #[test]
    fn curved_rods_are_the_gradient_of_their_energy() {
        let (mut state, law) = curved();
        let residual = loads_of(&law, &state).residual(&state);
        assert!(
            residual.force < 1e-9 && residual.torque < 1e-9,
            "{residual:?}"
        );
        perturb(&mut state, &mut Xorshift::new(4), 0.05, 0.1);
        assert_is_gradient(&law, &state, 1e-3, 1e-8);
        assert_is_stiffness(&law, &state, 1e-3, 1e-7);
        assert_is_balanced(&law, &state, 1e-13);
        assert_fluctuates(&[&law], &state, 1e-12);
    }

    #[test]
    fn straight_elements_are_a_straight_rod() {
        let mut state = State::default();
        let rod = StraightRod::uniform(4, 2.0);
        let layout = rod.push_clamped(RodClamp::Wall, End::Start, &mut state);
        let layout = layout.unwrap();
        let material = RodMaterial::new(Rigidities::table4()).unwrap();
        let elements = RodElements::at_rest(&state, &layout, material).unwrap();
        let gradient = EnergyGradient::new(layout, material);
        perturb(&mut state, &mut Xorshift::new(5), 0.05, 0.1);
        let (energy, expected) = (elements.energy(&state), gradient.energy(&state));
        assert!((energy / expected - 1.0).abs() < 1e-13);
        let [loads, expected] = [&elements as &dyn Interaction, &gradient]
            .map(|law| loads_of(law, &state).torque.iter().collect::<Vec<_>>());
        let largest = expected.iter().map(Vector3::norm).fold(0.0, f64::max);
        for (torque, expected) in loads.iter().zip(&expected) {
            assert!((torque - expected).norm() < 1e-12 * largest);
        }
    }

    #[test]
    fn elements_without_length_are_refused() {
        let (_, law) = curved();
        for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let (mut segments, mut joints) = (law.segments.clone(), law.joints.clone());
            joints[2].rest_distance = value;
            let error = RodElements::new(law.material, segments.clone(), joints).unwrap_err();
            assert!(matches!(error, RodError::JointDistance { joint: 2, .. }));
            segments[1].rest_length = value;
            let error = RodElements::new(law.material, segments, vec![]).unwrap_err();
            assert!(matches!(error, RodError::SegmentLength { segment: 1, .. }));
        }
    }
}

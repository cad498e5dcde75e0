use actin_cosserat::{BendingElement, JoinedElement, RodMaterial, ShearElement};
use actin_mechanics::{Loads, State, Stiffness, UnitQuaternion, Vector3, rotation};

/// Bond with its junction frame, in filament order.
///
/// A shear element joins the centre of the monomer and the end of the rod. Two bending elements
/// join the frames of monomer, junction and end segment.
#[derive(Clone, Debug)]
pub(crate) struct Bond {
    pub(crate) points: [usize; 2],
    /// Frames; the second one is the junction frame.
    pub(crate) frames: [usize; 3],
    /// Index of the monomer frame in `frames`: 0 or 2.
    pub(crate) monomer: usize,
    /// Rotation from the junction frame at rest to the monomer frame: `Q_m(0)^T Q_MR(0)`.
    pub(crate) offset: UnitQuaternion,
    /// Shear element between the points, in the junction frame.
    pub(crate) shear: ShearElement,
    /// Bending elements between the first two and the last two frames.
    pub(crate) bending: [BendingElement; 2],
    /// Materials of the bending elements. The element at the rod has the rest curvature of the rod
    /// times the fraction of its length inside the rod. The other fraction has the rest twist of the
    /// monomers.
    pub(crate) materials: [RodMaterial; 2],
    /// Difference between the rest curvatures of the rod and of the element at the rod (rad/nm).
    pub(crate) curvature_difference: Vector3,
}

type Bend<'a> = (
    BendingElement,
    &'a RodMaterial,
    UnitQuaternion,
    UnitQuaternion,
);

impl Bond {
    pub(crate) fn junction(&self) -> usize {
        self.frames[1]
    }

    pub(crate) fn joined(&self) -> JoinedElement {
        let k = usize::from(self.monomer == 0);
        JoinedElement {
            frames: [self.frames[k], self.frames[k + 1]],
            element: self.bending[k],
            curvature_difference: self.curvature_difference,
        }
    }

    pub(crate) fn towards_monomer(&self) -> (BendingElement, &RodMaterial) {
        let k = usize::from(self.monomer != 0);
        (self.bending[k], &self.materials[k])
    }

    pub(crate) fn towards_rod(&self) -> (BendingElement, &RodMaterial) {
        let k = usize::from(self.monomer == 0);
        (self.bending[k], &self.materials[k])
    }

    /// Curvature of the element at the monomer (rad/nm).
    pub(crate) fn curvature_towards_monomer(&self, state: &State) -> Vector3 {
        self.curvatures(state)[usize::from(self.monomer != 0)]
    }

    /// Curvature of the element at the rod (rad/nm).
    pub(crate) fn curvature_towards_rod(&self, state: &State) -> Vector3 {
        self.curvatures(state)[usize::from(self.monomer == 0)]
    }

    /// Adds a rest twist (rad/nm) of the monomers, on their side of the junction.
    pub(crate) fn twist_at_rest(&mut self, twist: f64) {
        let towards_monomer = usize::from(self.monomer != 0);
        let half = self.bending[towards_monomer].rest_distance;
        for (element, material) in self.bending.iter().zip(&mut self.materials) {
            let rest = Vector3::z() * (twist * half / element.rest_distance);
            let twisted = material.with_rest_curvature(material.rest_curvature() + rest);
            *material = twisted.expect("a twist of monomers is finite");
        }
        let towards_rod = self.bending[1 - towards_monomer].rest_distance;
        self.curvature_difference.z -= twist * half / towards_rod;
        let sense = if self.monomer == 0 { -1.0 } else { 1.0 };
        let turn = rotation::exp(Vector3::z() * (sense * twist * half));
        self.shear.rest_direction = turn * self.shear.rest_direction;
    }

    pub(crate) fn strain(&self, state: &State) -> Vector3 {
        let q = state.frames.orientation.get(self.junction());
        self.shear.strain(q, self.vector(state))
    }

    #[inline]
    pub(crate) fn offsets(&self) -> [UnitQuaternion; 3] {
        let mut offsets = [UnitQuaternion::identity(); 3];
        offsets[self.monomer] = self.offset;
        offsets
    }

    #[inline]
    fn orientations(&self, state: &State) -> [UnitQuaternion; 3] {
        let mut q = self.frames.map(|frame| state.frames.orientation.get(frame));
        q[self.monomer] *= self.offset;
        q
    }

    #[inline]
    fn bends(&self, q: &[UnitQuaternion; 3]) -> [Bend<'_>; 2] {
        [0, 1].map(|k| (self.bending[k], &self.materials[k], q[k], q[k + 1]))
    }

    #[inline]
    fn vector(&self, state: &State) -> Vector3 {
        let x = &state.points.position;
        x.get(self.points[1]) - x.get(self.points[0])
    }

    pub(crate) fn curvatures(&self, state: &State) -> [Vector3; 2] {
        let bends = self.bends(&self.orientations(state));
        bends.map(|(element, _, a, b)| element.curvature(a, b))
    }

    pub(crate) fn energy(&self, material: &RodMaterial, state: &State) -> f64 {
        let q = self.orientations(state);
        let bends = self
            .bends(&q)
            .map(|(element, material, a, b)| element.energy(material, a, b));
        self.shear.energy(material, q[1], self.vector(state)) + bends[0] + bends[1]
    }

    #[inline]
    pub(crate) fn add_loads(
        &self,
        weight: f64,
        material: &RodMaterial,
        state: &State,
        loads: &mut Loads,
    ) {
        let q = self.orientations(state);
        let shear = self.shear.loads(material, q[1], self.vector(state));
        loads.force.add(self.points[0], weight * shear.force);
        loads.force.add(self.points[1], -weight * shear.force);
        let [before, after] = self
            .bends(&q)
            .map(|(element, material, a, b)| element.loads(material, a, b));
        let on_junction = shear.torque + before.second + after.first;
        let mut torques = [before.first, on_junction, after.second];
        torques[self.monomer] = self.offset * torques[self.monomer];
        for (frame, torque) in self.frames.into_iter().zip(torques) {
            loads.torque.add(frame, weight * torque);
        }
    }

    pub(crate) fn add_stiffness(
        &self,
        weight: f64,
        material: &RodMaterial,
        state: &State,
        stiffness: &mut Stiffness,
    ) {
        let q = self.orientations(state);
        let shear = self.shear.stiffness(material, q[1], self.vector(state));
        (shear * weight).push(self.points, self.junction(), stiffness);
        let offsets = self.offsets();
        for (k, (element, material, a, b)) in self.bends(&q).into_iter().enumerate() {
            let bending = element.stiffness(material, a, b);
            let bending = bending.in_bodies([offsets[k], offsets[k + 1]]);
            (bending * weight).push([self.frames[k], self.frames[k + 1]], stiffness);
        }
    }
}

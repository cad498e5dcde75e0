//! One bond between a monomer and a rod's end: its rest quantities, energy, loads and stiffness.

use actin_cosserat::{BendingElement, JoinedElement, RodMaterial, ShearElement};
use actin_mechanics::{Loads, State, Stiffness, UnitQuaternion, Vector3};

/// A bond with its junction frame. The rod's own elements make it up: a shear element between the
/// monomer's centre and the rod's end, and two bending elements along the chain of the monomer's
/// frame, the junction frame and that of the rod's end segment.
///
/// All stand in filament order, so that nothing here asks which section comes first.
#[derive(Clone, Debug)]
pub(crate) struct Bond {
    /// The two points.
    pub(crate) points: [usize; 2],
    /// The three frames; the junction frame is the middle one.
    pub(crate) frames: [usize; 3],
    /// Which of the frames, the first or the last, is the monomer's.
    pub(crate) monomer: usize,
    /// From the junction basis at rest to the monomer's body frame: `Q_m(0)^T Q_MR(0)`.
    pub(crate) offset: UnitQuaternion,
    /// From point to point, in the junction frame.
    pub(crate) shear: ShearElement,
    /// Between the first two frames and between the last two.
    pub(crate) bending: [BendingElement; 2],
    /// Their materials: the rod's, straight at rest towards the monomer, towards the rod bent by what half
    /// of its end segment is.
    pub(crate) materials: [RodMaterial; 2],
    /// Curvature at rest (rad/nm) that the element beside the rod lacks of the rod's.
    pub(crate) lacking: Vector3,
}

/// A bending element with its material and the two orientations that it joins.
type Bend<'a> = (
    BendingElement,
    &'a RodMaterial,
    UnitQuaternion,
    UnitQuaternion,
);

impl Bond {
    /// The junction frame.
    pub(crate) fn junction(&self) -> usize {
        self.frames[1]
    }

    /// The bending element that the junction frame forms with the rod's end.
    pub(crate) fn joined(&self) -> JoinedElement {
        // The monomer is at one end of the chain, the rod at the other.
        let k = usize::from(self.monomer == 0);
        JoinedElement {
            frames: [self.frames[k], self.frames[k + 1]],
            element: self.bending[k],
            lacking: self.lacking,
        }
    }

    /// The bending element towards the monomer, with its material.
    pub(crate) fn towards_monomer(&self) -> (BendingElement, &RodMaterial) {
        let k = usize::from(self.monomer != 0);
        (self.bending[k], &self.materials[k])
    }

    /// That towards the rod.
    pub(crate) fn towards_rod(&self) -> (BendingElement, &RodMaterial) {
        let k = usize::from(self.monomer == 0);
        (self.bending[k], &self.materials[k])
    }

    /// Curvature (rad/nm) of the element towards the monomer.
    pub(crate) fn curvature_towards_monomer(&self, state: &State) -> Vector3 {
        self.curvatures(state)[usize::from(self.monomer != 0)]
    }

    /// Curvature (rad/nm) of that towards the rod.
    pub(crate) fn curvature_towards_rod(&self, state: &State) -> Vector3 {
        self.curvatures(state)[usize::from(self.monomer == 0)]
    }

    /// Strain of the shear element.
    pub(crate) fn strain(&self, state: &State) -> Vector3 {
        let q = state.frames.orientation.get(self.junction());
        self.shear.strain(q, self.vector(state))
    }

    /// What turns the junction basis at rest into each body's own frame.
    #[inline]
    pub(crate) fn offsets(&self) -> [UnitQuaternion; 3] {
        let mut offsets = [UnitQuaternion::identity(); 3];
        offsets[self.monomer] = self.offset;
        offsets
    }

    /// The three frames as they are now, the monomer's turned into the junction basis.
    #[inline]
    fn orientations(&self, state: &State) -> [UnitQuaternion; 3] {
        let mut q = self.frames.map(|frame| state.frames.orientation.get(frame));
        q[self.monomer] *= self.offset;
        q
    }

    /// Each bending element with the two orientations that it joins, of those of the chain.
    ///
    /// Nothing else says in which order they are joined, and constant rigidities would not show
    /// it: [`curvatures`](Self::curvatures), which do, are tested.
    #[inline]
    fn bends(&self, q: &[UnitQuaternion; 3]) -> [Bend<'_>; 2] {
        [0, 1].map(|k| (self.bending[k], &self.materials[k], q[k], q[k + 1]))
    }

    /// From the first point to the second (lab frame).
    #[inline]
    fn vector(&self, state: &State) -> Vector3 {
        let x = &state.points.position;
        x.get(self.points[1]) - x.get(self.points[0])
    }

    /// Curvatures of the two bending elements (rad/nm).
    pub(crate) fn curvatures(&self, state: &State) -> [Vector3; 2] {
        let bends = self.bends(&self.orientations(state));
        bends.map(|(element, _, a, b)| element.curvature(a, b))
    }

    /// Energy at weight 1 (pN nm).
    pub(crate) fn energy(&self, material: &RodMaterial, state: &State) -> f64 {
        let q = self.orientations(state);
        let bends = self
            .bends(&q)
            .map(|(element, material, a, b)| element.energy(material, a, b));
        self.shear.energy(material, q[1], self.vector(state)) + bends[0] + bends[1]
    }

    /// Adds `weight` times the loads.
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

    /// Adds `weight` times the second derivatives of the energy.
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

//! Force law that is the gradient of an energy.

use crate::extended::{EndTwist, ExtendedSegments};
use crate::fast::FastRod;
use crate::{BendingElement, RodLayout, RodMaterial, SegmentCurvature, SegmentLaw, ShearElement};
use actin_mechanics::{Interaction, Loads, RandomStress, SecondOrder, State, Stiffness};

/// Interaction `rod`, with the negative gradient of an energy as loads.
///
/// ```text
/// E = sum_i W(sigma_i) |lhat_i| + sum_j U(kappa_j) Dhat_j
/// ```
///
/// `W` and `U` are the material's energies per length. Elements are the `n` [`ShearElement`]s, then
/// the [`BendingElement`]s along the chain of frames, including walls.
///
/// # Source
/// Energy: arXiv 2203.01284, Section 2.2, discretised with rest lengths. The loads are its exact
/// gradient, unlike the printed balance.
#[derive(Clone, Debug)]
pub struct EnergyGradient {
    layout: RodLayout,
    material: RodMaterial,
    extended: Option<ExtendedSegments>,
    fast: Option<FastRod>,
}

impl EnergyGradient {
    /// Creates a rod with free ends. For a potential, [`with_extension`](Self::with_extension) sets
    /// the elements joined to the ends.
    pub fn new(layout: RodLayout, material: RodMaterial) -> Self {
        let extended = material.potential().map(|_| ExtendedSegments {
            law: SegmentLaw::default(),
            curvature: SegmentCurvature::new(&layout, &[], &[]),
        });
        Self {
            fast: FastRod::new(&layout, &material, extended.as_ref()),
            layout,
            material,
            extended,
        }
    }

    /// Makes the segment energy depend on the mean curvature around the segment.
    ///
    /// The conjugate torque acts on the frames of the surrounding bending elements. Tension then
    /// twists the rod, and twist causes tension.
    #[must_use]
    pub fn with_extension(self, law: SegmentLaw, curvature: SegmentCurvature) -> Self {
        let extended = ExtendedSegments { law, curvature };
        Self {
            fast: FastRod::new(&self.layout, &self.material, Some(&extended)),
            extended: Some(extended),
            ..self
        }
    }

    /// Layout of the rod.
    pub fn layout(&self) -> &RodLayout {
        &self.layout
    }

    /// Material of the rod.
    pub fn material(&self) -> &RodMaterial {
        &self.material
    }
}

impl EnergyGradient {
    fn end_twists(&self) -> &[EndTwist] {
        let extended = self.extended.as_ref();
        extended.map_or(&[], |segments| segments.curvature.end_twists())
    }

    pub(crate) fn extended(&self) -> Option<&ExtendedSegments> {
        self.extended.as_ref()
    }
}

pub(crate) fn write_shear_energies(
    layout: &RodLayout,
    material: &RodMaterial,
    state: &State,
    energies: &mut [f64],
) {
    let lengths = layout.segment_lengths().iter();
    let bodies = layout.points().zip(layout.frames());
    for ((energy, &length), (i, frame)) in energies.iter_mut().zip(lengths).zip(bodies) {
        let l = state.points.position.get(i + 1) - state.points.position.get(i);
        let q = state.frames.orientation.get(frame);
        *energy = ShearElement::segment(length).energy(material, q, l);
    }
}

pub(crate) fn write_bending_energies(
    layout: &RodLayout,
    material: &RodMaterial,
    state: &State,
    energies: &mut [f64],
) {
    let distances = layout.voronoi_lengths().iter();
    let chain = layout.bending_chain();
    for ((energy, &rest_distance), a) in energies.iter_mut().zip(distances).zip(chain) {
        let q = &state.frames.orientation;
        *energy = BendingElement { rest_distance }.energy(material, q.get(a), q.get(a + 1));
    }
}

impl EnergyGradient {
    /// Scalar loads without end twists, as a reference for tests of the vector kernel.
    pub(crate) fn add_scalar_loads(&self, state: &State, loads: &mut Loads) {
        match &self.extended {
            None => self.add_shear_loads(state, loads),
            Some(segments) => segments.add_loads(self.rod(), state, loads),
        }
        self.add_bending_loads(state, loads);
    }

    fn add_shear_loads(&self, state: &State, loads: &mut Loads) {
        let lengths = self.layout.segment_lengths().iter();
        let bodies = self.layout.points().zip(self.layout.frames());
        for (&length, (i, frame)) in lengths.zip(bodies) {
            let l = state.points.position.get(i + 1) - state.points.position.get(i);
            let q = state.frames.orientation.get(frame);
            let shear = ShearElement::segment(length).loads(&self.material, q, l);
            loads.force.add(i, shear.force);
            loads.force.add(i + 1, -shear.force);
            loads.torque.add(frame, shear.torque);
        }
    }

    fn add_bending_loads(&self, state: &State, loads: &mut Loads) {
        let distances = self.layout.voronoi_lengths().iter();
        for (&rest_distance, a) in distances.zip(self.layout.bending_chain()) {
            let q = &state.frames.orientation;
            let element = BendingElement { rest_distance };
            let bending = element.loads(&self.material, q.get(a), q.get(a + 1));
            loads.torque.add(a, bending.first);
            loads.torque.add(a + 1, bending.second);
        }
    }

    fn add_shear_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        let lengths = self.layout.segment_lengths().iter();
        let bodies = self.layout.points().zip(self.layout.frames());
        for (&length, (i, frame)) in lengths.zip(bodies) {
            let l = state.points.position.get(i + 1) - state.points.position.get(i);
            let q = state.frames.orientation.get(frame);
            let shear = ShearElement::segment(length).stiffness(&self.material, q, l);
            shear.push([i, i + 1], frame, stiffness);
        }
    }

    fn add_bending_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        let distances = self.layout.voronoi_lengths().iter();
        for (&rest_distance, a) in distances.zip(self.layout.bending_chain()) {
            let q = &state.frames.orientation;
            let element = BendingElement { rest_distance };
            let bending = element.stiffness(&self.material, q.get(a), q.get(a + 1));
            bending.push([a, a + 1], stiffness);
        }
    }

    fn rod(&self) -> (&RodLayout, &RodMaterial) {
        (&self.layout, &self.material)
    }
}

impl Interaction for EnergyGradient {
    fn term(&self) -> &'static str {
        "rod"
    }

    fn add_loads(&self, state: &State, loads: &mut Loads) {
        match &self.fast {
            Some(rod) => rod.add_loads(&self.layout, state, loads),
            None => self.add_scalar_loads(state, loads),
        }
        for end in self.end_twists() {
            end.add_loads(&self.material, state, loads);
        }
    }

    fn elements(&self) -> usize {
        self.layout.elements()
    }

    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        let (layout, material) = self.rod();
        assert_eq!(energies.len(), layout.elements(), "one energy per element");
        let (shear, bending) = energies.split_at_mut(layout.segments());
        match &self.extended {
            None => write_shear_energies(layout, material, state, shear),
            Some(segments) => segments.write_energies(self.rod(), state, shear),
        }
        write_bending_energies(layout, material, state, bending);
        for end in self.end_twists() {
            bending[end.element] += end.energy(material, state);
        }
    }

    fn random_stress(&self) -> Option<&dyn RandomStress> {
        Some(self)
    }

    fn second_order(&self) -> Option<&dyn SecondOrder> {
        Some(self)
    }
}

impl EnergyGradient {
    /// As `add_stiffness`, with axial rotations coupled to each other and to stretch alone.
    pub(crate) fn add_stiffness_without_spin(&self, state: &State, stiffness: &mut Stiffness) {
        match &self.extended {
            None => {
                stiffness.extend_without_spin(true, |own| self.add_shear_stiffness(state, own));
            }
            Some(segments) => segments.add_stiffness_without_spin(self.rod(), state, stiffness),
        }
        stiffness.extend_without_spin(true, |own| self.add_joint_stiffness(state, own));
    }

    fn add_joint_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        self.add_bending_stiffness(state, stiffness);
        for end in self.end_twists() {
            end.add_stiffness(&self.material, state, stiffness);
        }
    }
}

impl SecondOrder for EnergyGradient {
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        match &self.extended {
            None => self.add_shear_stiffness(state, stiffness),
            Some(segments) => segments.add_stiffness(self.rod(), state, stiffness),
        }
        self.add_joint_stiffness(state, stiffness);
    }
}

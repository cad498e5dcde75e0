//! Spring of a hinged end.

use super::Assembly;
use crate::scene::{Clamp, End};
use actin_cosserat::{Rigidities, RodElements, RodError, RodJoint, RodMaterial};
use actin_mechanics::{Interaction, Loads, SecondOrder, State, Stiffness, Vector3};

/// Rotational spring between two frames, reported as `hinge`. A rod joint of unit length models it,
/// so that its rigidities equal the spring's stiffnesses.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Hinge(RodElements);

impl Hinge {
    /// Creates the hinge of a clamp between its held frame and the frame of the cross-section. A
    /// clamp without a hinge gives zero stiffness, which is refused.
    pub(super) fn new(clamp: &Clamp, frames: [usize; 2]) -> Result<Self, RodError> {
        let hinge = clamp.hinge;
        let bend = hinge.map_or(0.0, |h| h.bend_pn_nm_per_rad);
        let twist = hinge.map_or(0.0, |h| h.twist_pn_nm_per_rad);
        let material = RodMaterial::new(Rigidities {
            shear: Vector3::repeat(1.0),
            bend: Vector3::new(bend, bend, twist),
        })?;
        let joint = RodJoint::straight(frames, 1.0);
        RodElements::new(material, Vec::new(), vec![joint]).map(Self)
    }
}

impl Interaction for Hinge {
    fn term(&self) -> &'static str {
        "hinge"
    }

    fn add_loads(&self, state: &State, loads: &mut Loads) {
        self.0.add_loads(state, loads);
    }

    fn elements(&self) -> usize {
        self.0.elements()
    }

    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        self.0.write_energies(state, energies);
    }

    fn second_order(&self) -> Option<&dyn SecondOrder> {
        Some(self)
    }
}

impl SecondOrder for Hinge {
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        self.0.add_stiffness(state, stiffness);
    }
}

impl Assembly {
    /// Returns the frame of the cross-section at the end of a rod: held by a wall, or free under a hinge, an end couple or in
    /// heat. `None` for other ends.
    ///
    /// # Panics
    /// If the index is out of range.
    pub fn end_frame(&self, filament: usize, end: End) -> Option<usize> {
        let first = self.filaments[filament].sections.start;
        let rod = self.rod_of(first + self.written(filament).end_index(end))?;
        rod.layout.wall(end)
    }

    /// Returns the held frame of a hinged end and the frame of its cross-section; `None` for other
    /// ends.
    pub fn hinge_frames(&self, filament: usize, end: End) -> Option<[usize; 2]> {
        let clamp = self.held.turned_at(filament, end)?;
        if self.held.fixed_at(filament, end) == Some(clamp) {
            return None;
        }
        let behind = *self.clamps[clamp].frames.first()?;
        Some([behind, self.end_frame(filament, end)?])
    }
}

//! Rods that a scene cannot say: curved at rest, closed to a ring, or held in other ways. They
//! consist of the rod's own elements.

use actin_cosserat::{BendingElement, Rigidities, RodMaterial, ShearElement};
use actin_mechanics::{
    Frame, Inertia, Interaction, Loads, Point, SecondOrder, State, Stiffness, UnitQuaternion,
    Vector3,
};

/// Shear elements between points and bending elements between frames, in any topology.
#[derive(Debug)]
pub(crate) struct Chain {
    material: RodMaterial,
    /// Points, frame and rest length of each segment.
    segments: Vec<([usize; 2], usize, f64)>,
    bends: Vec<Bend>,
}

/// A bending element between frames that at rest are turned against each other.
#[derive(Clone, Copy, Debug)]
struct Bend {
    frames: [usize; 2],
    element: BendingElement,
    /// Places of the element's frames in those of the bodies; the element is at rest where
    /// `Qa oa = Qb ob`.
    offsets: [UnitQuaternion; 2],
}

impl Bend {
    fn orientations(&self, state: &State) -> [UnitQuaternion; 2] {
        [0, 1].map(|k| state.frames.orientation.get(self.frames[k]) * self.offsets[k])
    }
}

impl Chain {
    /// No elements yet; shear and stretch are equally stiff.
    pub(crate) fn new(shear: f64, bend: [f64; 3]) -> Self {
        Self::with_shear([shear; 3], bend)
    }

    /// No elements yet; rigidities in the order of a rod's.
    pub(crate) fn with_shear(shear: [f64; 3], bend: [f64; 3]) -> Self {
        let rigidities = Rigidities {
            shear: shear.into(),
            bend: bend.into(),
        };
        Self {
            material: RodMaterial::new(rigidities).unwrap(),
            segments: Vec::new(),
            bends: Vec::new(),
        }
    }

    /// A segment of rest length `length` between two points.
    pub(crate) fn segment(&mut self, points: [usize; 2], frame: usize, length: f64) {
        self.segments.push((points, frame, length));
    }

    /// A bending element over `distance` between frames that are joined where `Qa oa = Qb ob`.
    pub(crate) fn bend(&mut self, frames: [usize; 2], distance: f64, offsets: [UnitQuaternion; 2]) {
        self.bends.push(Bend {
            frames,
            element: BendingElement {
                rest_distance: distance,
            },
            offsets,
        });
    }
}

/// A point of unit mass.
pub(crate) fn point(state: &mut State, position: Vector3) -> usize {
    state.points.push(Point {
        position,
        mass: 1.0,
    })
}

/// A frame of unit inertia.
pub(crate) fn frame(state: &mut State, orientation: UnitQuaternion) -> usize {
    let inertia = Inertia::from_moments([1.0, 1.0, 2.0]).unwrap();
    state.frames.push(Frame {
        orientation,
        inertia,
    })
}

impl Interaction for Chain {
    fn term(&self) -> &'static str {
        "chain"
    }

    fn elements(&self) -> usize {
        self.segments.len() + self.bends.len()
    }

    fn add_loads(&self, state: &State, loads: &mut Loads) {
        for &([i, j], frame, length) in &self.segments {
            let l = state.points.position.get(j) - state.points.position.get(i);
            let q = state.frames.orientation.get(frame);
            let shear = ShearElement::segment(length).loads(&self.material, q, l);
            loads.force.add(i, shear.force);
            loads.force.add(j, -shear.force);
            loads.torque.add(frame, shear.torque);
        }
        for bend in &self.bends {
            let [qa, qb] = bend.orientations(state);
            let couple = bend.element.loads(&self.material, qa, qb);
            loads
                .torque
                .add(bend.frames[0], bend.offsets[0] * couple.first);
            loads
                .torque
                .add(bend.frames[1], bend.offsets[1] * couple.second);
        }
    }

    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        let (shear, bending) = energies.split_at_mut(self.segments.len());
        for (energy, &([i, j], frame, length)) in shear.iter_mut().zip(&self.segments) {
            let l = state.points.position.get(j) - state.points.position.get(i);
            let q = state.frames.orientation.get(frame);
            *energy = ShearElement::segment(length).energy(&self.material, q, l);
        }
        for (energy, bend) in bending.iter_mut().zip(&self.bends) {
            let [qa, qb] = bend.orientations(state);
            *energy = bend.element.energy(&self.material, qa, qb);
        }
    }

    fn second_order(&self) -> Option<&dyn SecondOrder> {
        Some(self)
    }
}

impl SecondOrder for Chain {
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        for &([i, j], frame, length) in &self.segments {
            let l = state.points.position.get(j) - state.points.position.get(i);
            let q = state.frames.orientation.get(frame);
            let shear = ShearElement::segment(length).stiffness(&self.material, q, l);
            shear.push([i, j], frame, stiffness);
        }
        for bend in &self.bends {
            let [qa, qb] = bend.orientations(state);
            let blocks = bend.element.stiffness(&self.material, qa, qb);
            blocks.in_bodies(bend.offsets).push(bend.frames, stiffness);
        }
    }
}

//! Clamped rod.

use actin_cosserat::{
    End, EnergyGradient, Rigidities, RodClamp, RodLayout, RodMaterial, StraightRod,
};
use actin_equilibrium::{BodyOrder, Layout, Newton, NewtonOptions};
use actin_mechanics::{Interaction, PointLoad, State, Vector3};

/// Rod along z from the origin, clamped by a held wall frame (frame 0) and point 0.
#[derive(Debug)]
pub(crate) struct Rod {
    pub(crate) segments: usize,
    pub(crate) length: f64,
    pub(crate) shear: Vector3,
    pub(crate) bending: Vector3,
}

/// Rigidities of actin (pN, pN nm^2).
pub(crate) const ACTIN: Rod = Rod {
    segments: 16,
    length: 160.0,
    shear: Vector3::new(1.6e4, 1.6e4, 3.4e4),
    bending: Vector3::new(3.9e4, 3.9e4, 1.3e4),
};

/// Column, softest about its y axis.
pub(crate) const COLUMN: Rod = Rod {
    segments: 16,
    bending: Vector3::new(3.9e4, 3.0e4, 1.3e4),
    ..ACTIN
};

impl Rod {
    fn built(&self) -> (State, RodLayout) {
        let mut state = State::default();
        let rod = StraightRod::uniform(self.segments, self.length / self.segments as f64);
        let layout = rod.push_clamped(RodClamp::Wall, End::Start, &mut state);
        (state, layout.unwrap())
    }

    pub(crate) fn state(&self) -> State {
        self.built().0
    }

    pub(crate) fn interactions(&self) -> Vec<Box<dyn Interaction>> {
        let rigidities = Rigidities {
            shear: self.shear,
            bend: self.bending,
        };
        let material = RodMaterial::new(rigidities).unwrap();
        vec![Box::new(EnergyGradient::new(self.built().1, material))]
    }

    /// Rod under a tip force (pN) times a control.
    pub(crate) fn loaded(
        &self,
        force: Vector3,
        control: f64,
    ) -> (State, Vec<Box<dyn Interaction>>) {
        let mut state = self.state();
        let control = state.add_control(control);
        let tip = vec![(self.segments, 1.0)];
        let mut terms = self.interactions();
        terms.push(Box::new(
            PointLoad::new(&state, tip, force, control).unwrap(),
        ));
        (state, terms)
    }

    pub(crate) fn order(&self) -> BodyOrder {
        BodyOrder {
            points: (0..=self.segments).map(|i| i as f64).collect(),
            frames: (0..=self.segments).map(|i| i as f64 - 0.5).collect(),
        }
    }

    pub(crate) fn layout(&self, state: &State) -> Layout {
        Layout::new(state, Some(&self.order())).unwrap()
    }

    pub(crate) fn newton(&self, state: &State) -> Newton {
        Newton::new(self.layout(state), NewtonOptions::default()).unwrap()
    }

    pub(crate) fn tip(&self, state: &State) -> Vector3 {
        state.points.position.get(self.segments)
    }
}

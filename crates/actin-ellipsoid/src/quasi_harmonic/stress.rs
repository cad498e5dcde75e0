//! The random stress of links: six numbers each, conjugate to the strain.
//!
//! A link turns its frames about their own axes by as much as at its pose. What beyond that the sum of its own stress and the
//! random one would turn them by, where they are displaced, is left out. Nothing resists a turn of the whole chain about its axis: in
//! steps in which bending relaxes it would turn, and with it the bend that the stress of this step asks for, until random forces
//! bend it further; free filaments of 110 nm were too soft by 2 to 4 % for that, at any such step. The sum is small where the step
//! ends, so that steps without end stay exact.

use super::QuasiHarmonic;
use crate::SixVector;
use actin_mechanics::{Loads, RandomStress, State, Stiffness, correlate};

/// Numbers of a strain.
const SIX: usize = 6;

/// The stress of each link.
fn written(stresses: &[f64]) -> impl Iterator<Item = SixVector> {
    let (links, _) = stresses.as_chunks::<SIX>();
    links.iter().map(|s| SixVector::from(*s))
}

impl RandomStress for QuasiHarmonic {
    fn components(&self) -> usize {
        SIX * self.elements.len()
    }

    fn draw(&self, _: &State, thermal_energy: f64, stresses: &mut [f64]) {
        let links = &self.links[self.elements.clone()];
        for (stress, link) in stresses.as_chunks_mut::<SIX>().0.iter_mut().zip(links) {
            correlate(link.stiffness * thermal_energy, stress);
        }
    }

    fn balance(&self, state: &State, stresses: &mut [f64]) {
        let written = stresses.as_chunks_mut::<SIX>().0.iter_mut();
        for (stress, own) in written.zip(self.stresses(state)) {
            *stress = own.into();
        }
    }

    fn add_stress_loads(&self, state: &State, stresses: &[f64], loads: &mut Loads) {
        let own: Vec<SixVector> = self.stresses(state).collect();
        let left = written(stresses).zip(&own).map(|(s, own)| s - own);
        self.pulls(left)
            .for_each(|pull| pull.add_loads_without_spin(state, loads));
        self.pulls(own.into_iter())
            .for_each(|pull| pull.add_loads(state, loads));
    }

    fn add_stress_stiffness(&self, state: &State, stresses: &[f64], stiffness: &mut Stiffness) {
        let pulls = self.pulls(written(stresses));
        pulls.for_each(|pull| pull.add_stiffness(state, stiffness));
    }
}

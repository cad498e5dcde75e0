//! Random stress of links.
//!
//! The rotation of frames about their own axes by the sum of elastic and random stress is omitted.
//! A chain has no stiffness against rotation about its axis, so a time step in which bending
//! relaxes would rotate the bend. Free filaments of 110 nm were 2 to 4 % too soft with it. Long
//! time steps remain exact, since the sum is small at their end.

use super::QuasiHarmonic;
use crate::SixVector;
use actin_mechanics::{Loads, RandomStress, SecondOrder, State, StepStress, Stiffness, correlate};

const SIX: usize = 6;

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

    fn add_stressed_stiffness(
        &self,
        state: &State,
        stress: &StepStress<'_>,
        stiffness: &mut Stiffness,
    ) {
        self.add_stiffness(state, stiffness);
        let pulls = self.pulls(written(stress.values));
        pulls.for_each(|pull| pull.add_stiffness(state, stiffness));
    }
}

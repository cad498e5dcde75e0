//! The random stresses of all interactions, and the blocks that a step adds to the stiffness.

use crate::friction::Scaled;
use actin_integrate::Noise;
use actin_mechanics::{Interaction, Loads, RandomStress, SecondOrder, State, Stiffness};
use std::ops::Range;

/// Parts the key of this noise from other uses of the same seed.
const PURPOSE: [u8; 8] = *b"stresses";

/// Numbers that one index of the noise has.
const VECTOR: usize = 3;

/// Random stresses of one system.
#[derive(Debug)]
pub(crate) struct Stresses {
    noise: Noise,
    /// The interactions that have any, and where theirs stand.
    parts: Vec<(usize, Range<usize>)>,
    /// As drawn.
    drawn: Vec<f64>,
    /// Those that balance the elements' own.
    balancing: Vec<f64>,
}

/// Which stresses second derivatives belong to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Those that act.
    Drawn,
    /// Those that leave of the elements nothing but their stiffness, which is positive.
    Balancing,
}

type Interactions = [Box<dyn Interaction>];

impl Stresses {
    pub(crate) fn new(interactions: &Interactions, seed: u64) -> Self {
        let mut parts = Vec::new();
        let mut end = 0;
        for (k, interaction) in interactions.iter().enumerate() {
            if let Some(stress) = interaction.random_stress() {
                let start = end;
                end += stress.components();
                parts.push((k, start..end));
            }
        }
        Self {
            noise: Noise::of_purpose(PURPOSE, seed, (end.div_ceil(VECTOR), 0)),
            parts,
            drawn: vec![0.0; end],
            balancing: vec![0.0; end],
        }
    }

    /// Those of a step, with the stiffness at `state`.
    pub(crate) fn draw(
        &mut self,
        interactions: &Interactions,
        state: &State,
        (thermal_energy, step): (f64, u64),
    ) {
        self.noise.draw_stream(step, (1.0, 1.0));
        let deviates = self.noise.points.iter().flat_map(|v| [v.x, v.y, v.z]);
        for (value, deviate) in self.drawn.iter_mut().zip(deviates) {
            *value = deviate;
        }
        for (k, range) in &self.parts {
            let stresses = &mut self.drawn[range.clone()];
            of(interactions, *k).draw(state, thermal_energy, stresses);
        }
    }

    pub(crate) fn balance(&mut self, interactions: &Interactions, state: &State) {
        for (k, range) in &self.parts {
            let stresses = &mut self.balancing[range.clone()];
            of(interactions, *k).balance(state, stresses);
        }
    }

    /// Adds the loads of those drawn.
    pub(crate) fn add_loads(&self, interactions: &Interactions, state: &State, loads: &mut Loads) {
        for (k, range) in &self.parts {
            let stresses = &self.drawn[range.clone()];
            of(interactions, *k).add_stress_loads(state, stresses, loads);
        }
    }
}

fn of(interactions: &Interactions, k: usize) -> &dyn RandomStress {
    let stress = interactions[k].random_stress();
    stress.expect("an interaction keeps its kind")
}

/// Friction over a time step, and the second derivatives of stresses.
pub(crate) struct Added<'a> {
    pub(crate) friction: Scaled<'a>,
    pub(crate) interactions: &'a Interactions,
    pub(crate) stresses: &'a Stresses,
    pub(crate) kind: Kind,
}

impl SecondOrder for Added<'_> {
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        self.friction.add_stiffness(state, stiffness);
        let stresses = self.stresses;
        let values = match self.kind {
            Kind::Drawn => &stresses.drawn,
            Kind::Balancing => &stresses.balancing,
        };
        for (k, range) in &stresses.parts {
            let values = &values[range.clone()];
            of(self.interactions, *k).add_stress_stiffness(state, values, stiffness);
        }
    }
}

use crate::friction::Scaled;
use actin_integrate::Noise;
use actin_mechanics::{Interaction, Loads, RandomStress, SecondOrder, State, Stiffness};
use std::ops::Range;

/// Separates this noise from other uses of the same seed.
const PURPOSE: [u8; 8] = *b"stresses";

/// Numbers per index of the noise.
const VECTOR: usize = 3;

#[derive(Debug)]
pub(crate) struct Stresses {
    noise: Noise,
    /// Interactions with random stress, and the ranges of their components.
    parts: Vec<(usize, Range<usize>)>,
    /// Stresses at the start of the step.
    drawn: Vec<f64>,
    /// Stresses in the axes of frames that have spun since.
    turned: Vec<f64>,
    /// Stresses equal to the elastic stresses of the elements.
    balancing: Vec<f64>,
    /// Whether the second derivatives of an interaction use balancing stresses. Only the positive
    /// elastic stiffness then remains.
    is_balanced: Vec<bool>,
    /// Whether the axial frames of an interaction spin freely.
    spins: Vec<bool>,
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
            is_balanced: vec![false; parts.len()],
            spins: vec![false; parts.len()],
            parts,
            drawn: vec![0.0; end],
            turned: vec![0.0; end],
            balancing: vec![0.0; end],
        }
    }

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

    pub(crate) fn let_spin(
        &mut self,
        interactions: &Interactions,
        is_bare: impl Fn(usize) -> bool,
    ) -> Vec<usize> {
        let mut frames = Vec::new();
        for ((k, _), spins) in self.parts.iter().zip(&mut self.spins) {
            let axial = of(interactions, *k).axial_frames();
            *spins = !axial.is_empty() && axial.clone().all(&is_bare);
            frames.extend(axial.filter(|_| *spins));
        }
        frames
    }

    /// Transforms the stresses to the axes of frames that have spun by `spins` (rad) since the
    /// start.
    pub(crate) fn turn_back(&mut self, interactions: &Interactions, spins: &[f64]) {
        for ((k, range), has_spin) in self.parts.iter().zip(&self.spins) {
            let (drawn, turned) = (&self.drawn[range.clone()], &mut self.turned[range.clone()]);
            if *has_spin {
                of(interactions, *k).turn_back(spins, drawn, turned);
            } else {
                turned.copy_from_slice(drawn);
            }
        }
    }

    pub(crate) fn balance_all(&mut self, is_balanced: bool) {
        self.is_balanced.fill(is_balanced);
    }

    /// Balances further interactions: first those without axial frames, such as compressed springs,
    /// then chains with one of the given frames, then all. Returns `false` if all were balanced
    /// before.
    pub(crate) fn balance_more(&mut self, interactions: &Interactions, frames: &[usize]) -> bool {
        let axial = |k: usize| of(interactions, k).axial_frames();
        let has_one = |k: usize| frames.iter().any(|frame| axial(k).contains(frame));
        self.balance_if(|k| axial(k).is_empty())
            || self.balance_if(has_one)
            || self.balance_if(|_| true)
    }

    fn balance_if(&mut self, choice: impl Fn(usize) -> bool) -> bool {
        let mut has_changed = false;
        for ((k, _), is_balanced) in self.parts.iter().zip(&mut self.is_balanced) {
            if !*is_balanced && choice(*k) {
                (*is_balanced, has_changed) = (true, true);
            }
        }
        has_changed
    }

    pub(crate) fn find_balance(&mut self, interactions: &Interactions, state: &State) {
        for ((k, range), is_balanced) in self.parts.iter().zip(&self.is_balanced) {
            if *is_balanced {
                let stresses = &mut self.balancing[range.clone()];
                of(interactions, *k).balance(state, stresses);
            }
        }
    }

    pub(crate) fn add_loads(&self, interactions: &Interactions, state: &State, loads: &mut Loads) {
        for (k, range) in &self.parts {
            let stresses = &self.turned[range.clone()];
            of(interactions, *k).add_stress_loads(state, stresses, loads);
        }
    }
}

fn of(interactions: &Interactions, k: usize) -> &dyn RandomStress {
    let stress = interactions[k].random_stress();
    stress.expect("interactions do not lose their random stress")
}

pub(crate) struct Added<'a> {
    pub(crate) friction: Scaled<'a>,
    pub(crate) interactions: &'a Interactions,
    pub(crate) stresses: &'a Stresses,
}

impl SecondOrder for Added<'_> {
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        self.friction.add_stiffness(state, stiffness);
        let stresses = self.stresses;
        let choices = stresses.is_balanced.iter().zip(&stresses.spins);
        for ((k, range), (is_balanced, spins)) in stresses.parts.iter().zip(choices) {
            let values = match is_balanced {
                true => &stresses.balancing,
                false => &stresses.turned,
            };
            let values = &values[range.clone()];
            let stress = of(self.interactions, *k);
            if *spins {
                stress.add_turned_stiffness(state, values, stiffness);
            } else {
                stress.add_stress_stiffness(state, values, stiffness);
            }
            stress.add_convexity(state, *is_balanced, stiffness);
        }
    }
}

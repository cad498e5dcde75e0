use crate::components::Components;
use crate::friction::ScaledFriction;
use crate::progress::Progress;
use actin_equilibrium::MatrixParts;
use actin_integrate::Noise;
use actin_mechanics::{Interaction, Loads, RandomStress, State, StepStress, Stiffness};
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
    /// Part of each interaction, if it has random stress.
    of_interactions: Vec<Option<usize>>,
    /// Stresses at the start of the step.
    drawn: Vec<f64>,
    /// Stresses at the start, in the current axes of spinning frames.
    turned: Vec<f64>,
    /// Stresses equal to the elastic stresses of the elements.
    balancing: Vec<f64>,
    /// `true` if balancing stresses replace the random stress in the stiffness of an interaction.
    /// They cancel its geometric stiffness, and only the positive elastic stiffness remains.
    is_balanced: Vec<bool>,
    /// `true` if the axial frames of an interaction spin freely.
    spins: Vec<bool>,
}

type Interactions = [Box<dyn Interaction>];

impl Stresses {
    pub(crate) fn new(interactions: &Interactions, seed: u64) -> Self {
        let mut parts = Vec::new();
        let mut of_interactions = vec![None; interactions.len()];
        let mut end = 0;
        for (k, interaction) in interactions.iter().enumerate() {
            if let Some(stress) = interaction.random_stress() {
                let start = end;
                end += stress.components();
                of_interactions[k] = Some(parts.len());
                parts.push((k, start..end));
            }
        }
        Self {
            noise: Noise::with_purpose(PURPOSE, seed, (end.div_ceil(VECTOR), 0)),
            is_balanced: vec![false; parts.len()],
            spins: vec![false; parts.len()],
            parts,
            of_interactions,
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

    pub(crate) fn decouple_spins(
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
    pub(crate) fn turn_back(
        &mut self,
        interactions: &Interactions,
        components: &Components,
        spins: &[f64],
    ) {
        let parts = self.parts.iter().zip(&self.spins);
        for ((k, range), has_spin) in parts.filter(|((k, _), _)| components.has_interaction(*k)) {
            let (drawn, turned) = (&self.drawn[range.clone()], &mut self.turned[range.clone()]);
            if *has_spin {
                of(interactions, *k).turn_back(spins, drawn, turned);
            } else {
                turned.copy_from_slice(drawn);
            }
        }
    }

    /// Balances the interactions of an early iteration, in which compressed springs would often make the matrix
    /// indefinite: all in the first one, those without axial frames in the second one.
    pub(crate) fn balance_early(&mut self, interactions: &Interactions, iteration: usize) {
        for ((k, _), is_balanced) in self.parts.iter().zip(&mut self.is_balanced) {
            *is_balanced = match iteration {
                0 => true,
                1 => is_spring(interactions, *k),
                _ => false,
            };
        }
    }

    /// Balances more interactions: the first of the following groups that is not balanced yet.
    /// Returns the interactions of this group.
    ///
    /// - interactions of the components `worst` (ascending) without axial frames, such as
    ///   compressed springs
    /// - all interactions of these components
    /// - interactions of all components without axial frames
    /// - all interactions
    pub(crate) fn balance_more(
        &mut self,
        interactions: &Interactions,
        components: &Components,
        worst: &[usize],
    ) -> Vec<usize> {
        let is_spring = |k: usize| is_spring(interactions, k);
        let is_worst = |k: usize| components.couples(k, worst);
        let choices: [&dyn Fn(usize) -> bool; 4] = [
            &|k| is_spring(k) && is_worst(k),
            &is_worst,
            &is_spring,
            &|_| true,
        ];
        let mut changed = Vec::new();
        for choice in choices {
            for ((k, _), is_balanced) in self.parts.iter().zip(&mut self.is_balanced) {
                if !*is_balanced && components.has_interaction(*k) && choice(*k) {
                    *is_balanced = true;
                    changed.push(*k);
                }
            }
            if !changed.is_empty() {
                break;
            }
        }
        changed
    }

    pub(crate) fn find_balance(
        &mut self,
        interactions: &Interactions,
        components: &Components,
        state: &State,
    ) {
        for ((k, range), is_balanced) in self.parts.iter().zip(&self.is_balanced) {
            if *is_balanced && components.has_interaction(*k) {
                let stresses = &mut self.balancing[range.clone()];
                stresses.copy_from_slice(&self.turned[range.clone()]);
                of(interactions, *k).balance(state, stresses);
            }
        }
    }

    fn of_step(&self, part: usize) -> StepStress<'_> {
        let (_, range) = &self.parts[part];
        let is_balanced = self.is_balanced[part];
        let all = if is_balanced {
            &self.balancing
        } else {
            &self.turned
        };
        StepStress {
            values: &all[range.clone()],
            is_turned: self.spins[part],
            is_balanced,
        }
    }

    /// Records the stresses of a completed step in the controls.
    pub(crate) fn record(&self, interactions: &Interactions, state: &mut State) {
        for (k, range) in &self.parts {
            of(interactions, *k).record(&self.turned[range.clone()], state);
        }
    }

    pub(crate) fn add_loads(
        &self,
        interactions: &Interactions,
        components: &Components,
        (state, loads): (&State, &mut Loads),
    ) {
        let parts = self.parts.iter();
        for (k, range) in parts.filter(|(k, _)| components.has_interaction(*k)) {
            let stresses = &self.turned[range.clone()];
            of(interactions, *k).add_stress_loads(state, stresses, loads);
        }
    }
}

fn of(interactions: &Interactions, k: usize) -> &dyn RandomStress {
    let stress = interactions[k].random_stress();
    stress.expect("interactions do not lose their random stress")
}

fn is_spring(interactions: &Interactions, k: usize) -> bool {
    of(interactions, k).axial_frames().is_empty()
}

/// Matrix of an iteration: interactions with their stresses, then the friction of each component.
pub(crate) struct StepMatrix<'a> {
    pub(crate) interactions: &'a Interactions,
    pub(crate) stresses: &'a Stresses,
    pub(crate) components: &'a Components,
    pub(crate) friction: ScaledFriction<'a>,
    pub(crate) progress: &'a Progress,
}

impl MatrixParts for StepMatrix<'_> {
    fn count(&self) -> usize {
        self.interactions.len() + self.components.count()
    }

    fn add(&self, k: usize, state: &State, stiffness: &mut Stiffness) {
        let Some(interaction) = self.interactions.get(k) else {
            return self.add_friction(k - self.interactions.len(), state, stiffness);
        };
        if let Some(part) = self.stresses.of_interactions[k] {
            let stress = self.stresses.of_step(part);
            of(self.interactions, k).add_stressed_stiffness(state, &stress, stiffness);
        } else if let Some(second_order) = interaction.second_order() {
            second_order.add_stiffness(state, stiffness);
        }
    }
}

impl StepMatrix<'_> {
    fn add_friction(&self, component: usize, state: &State, stiffness: &mut Stiffness) {
        let friction = self.friction.scaled(self.progress.friction(component));
        for &k in &self.components.dashpots[component] {
            friction.add_dashpot(k, state, stiffness);
        }
        for &k in &self.components.turns[component] {
            friction.add_turn(k, stiffness);
        }
    }
}

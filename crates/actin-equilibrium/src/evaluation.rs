//! Energy and loads of a state.

use actin_mechanics::{Interaction, Loads, State};

#[derive(Clone, Debug, Default)]
pub(crate) struct Evaluation {
    pub(crate) loads: Loads,
    energies: Vec<f64>,
    pub(crate) energy: f64,
    /// Scale of the rounding error of the energy.
    pub(crate) magnitude: f64,
    /// Bodies passed through each other; the energy counts as infinite.
    passed: bool,
}

impl Evaluation {
    pub(crate) fn new(interactions: &[Box<dyn Interaction>], state: &State) -> Self {
        let elements = interactions.iter().map(|i| i.elements()).sum();
        let mut evaluation = Self {
            loads: Loads::zeros(state),
            energies: vec![0.0; elements],
            ..Self::default()
        };
        evaluation.update(interactions, state);
        evaluation
    }

    pub(crate) fn update(&mut self, interactions: &[Box<dyn Interaction>], state: &State) {
        self.passed = false;
        self.loads.clear();
        let mut rest = self.energies.as_mut_slice();
        for interaction in interactions {
            interaction.add_loads(state, &mut self.loads);
            let (own, others) = rest.split_at_mut(interaction.elements());
            interaction.write_energies(state, own);
            rest = others;
        }
        self.energy = self.energies.iter().sum();
        self.magnitude = self.energies.iter().map(|e| e.abs()).sum();
    }

    pub(crate) fn follow(
        &mut self,
        interactions: &[Box<dyn Interaction>],
        (from, state): (&State, &State),
    ) {
        self.update(interactions, state);
        self.passed = passes_through(interactions, from, state);
    }

    pub(crate) fn has_passed(&self) -> bool {
        self.passed
    }

    /// Sum of the differences of elements, more accurate than the difference of sums.
    pub(crate) fn energy_above(&self, other: &Self) -> f64 {
        if self.passed {
            return f64::INFINITY;
        }
        self.energies
            .iter()
            .zip(&other.energies)
            .map(|(here, there)| here - there)
            .sum()
    }

    pub(crate) fn is_finite(&self) -> bool {
        !self.passed
            && self.energy.is_finite()
            && [&self.loads.force, &self.loads.torque]
                .iter()
                .flat_map(|v| [&v.x, &v.y, &v.z])
                .flatten()
                .all(|c| c.is_finite())
    }
}

/// Returns `true` if a straight motion moves bodies through each other that an interaction
/// separates.
pub(crate) fn passes_through(
    interactions: &[Box<dyn Interaction>],
    from: &State,
    to: &State,
) -> bool {
    let mut all = interactions.iter();
    all.any(|interaction| interaction.passes_through(from, to).is_some())
}

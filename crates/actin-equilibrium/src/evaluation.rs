//! Energy and loads of a state, with the precision that acceptance of a step needs.

use actin_mechanics::{Interaction, Loads, State};

/// Loads and energy of each element at one state.
#[derive(Clone, Debug, Default)]
pub(crate) struct Evaluation {
    pub(crate) loads: Loads,
    energies: Vec<f64>,
    pub(crate) energy: f64,
    /// Sum of the absolute energies of all elements: `eps` times this is the least round-off.
    pub(crate) magnitude: f64,
    /// Whether the way here led bodies through each other: then the energy counts as infinite.
    passed: bool,
}

impl Evaluation {
    /// Evaluates all interactions.
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

    /// Evaluates all interactions into the same memory.
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

    /// Evaluates all interactions in `state`, to which the straight way leads from another.
    pub(crate) fn follow(
        &mut self,
        interactions: &[Box<dyn Interaction>],
        (from, state): (&State, &State),
    ) {
        self.update(interactions, state);
        self.passed = passes_through(interactions, from, state);
    }

    /// Whether the way here led bodies through each other.
    pub(crate) fn has_passed(&self) -> bool {
        self.passed
    }

    /// The energy here less that of `other`, added up from the differences of elements: the
    /// round-off of a sum over a long filament would hide what one element does.
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

    /// Whether energy and loads are finite.
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

/// Whether bodies that some interaction keeps apart pass through each other on the straight way between
/// two states.
pub(crate) fn passes_through(
    interactions: &[Box<dyn Interaction>],
    from: &State,
    to: &State,
) -> bool {
    let mut all = interactions.iter();
    all.any(|interaction| interaction.passes_through(from, to).is_some())
}

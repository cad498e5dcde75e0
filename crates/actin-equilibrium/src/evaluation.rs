//! Energy and loads of a state.

use actin_mechanics::{Interaction, Loads, State};

/// Loads and element energies of a state.
#[derive(Clone, Debug, Default)]
pub(crate) struct Evaluation {
    pub(crate) loads: Loads,
    energies: Vec<f64>,
    pub(crate) energy: f64,
    /// Sum of the absolute energies of all elements, scale of the rounding error.
    pub(crate) magnitude: f64,
    /// The last motion moved bodies through each other; the energy counts as infinite.
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

    /// Evaluates all interactions in place.
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

    /// Evaluates all interactions at `state`, reached by a straight motion from `from`.
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

    /// Energy difference to `other`, summed over the differences of elements. The rounding error of
    /// the total energy of a long filament could exceed the change of one element.
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

/// Returns `true` if a straight motion between two states moves bodies through each other that an
/// interaction separates.
pub(crate) fn passes_through(
    interactions: &[Box<dyn Interaction>],
    from: &State,
    to: &State,
) -> bool {
    let mut all = interactions.iter();
    all.any(|interaction| interaction.passes_through(from, to).is_some())
}

//! Magnitude of loads.

use actin_mechanics::{Interaction, Loads, Residual, State, Stiffness, Vectors};

/// Relative residual below which further steps are useless.
const SMALL: f64 = 1e-8;
/// Relative resultant of unbalanced loads.
const UNBALANCED: f64 = 1e-3;

/// Largest load of any single interaction, since the loads cancel in equilibrium.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LoadScale(Residual);

impl LoadScale {
    /// Includes held bodies. Arms between two lengths (nm) relate forces and torques.
    pub(crate) fn new(
        interactions: &[Box<dyn Interaction>],
        state: &State,
        [shortest, longest]: [f64; 2],
    ) -> Self {
        let mut loads = Loads::zeros(state);
        let (mut force, mut torque) = (0.0_f64, 0.0_f64);
        for interaction in interactions {
            loads.clear();
            interaction.add_loads(state, &mut loads);
            force = force.max(largest_norm(&loads.force));
            torque = torque.max(largest_norm(&loads.torque));
        }
        Self(Residual {
            force: force.max(torque / longest),
            torque: torque.max(force * shortest),
        })
    }

    pub(crate) fn dwarfs(&self, residual: &Residual) -> bool {
        residual.is_within(&self.0.scaled(SMALL))
    }

    /// The loads along zero-stiffness motions are within their error.
    pub(crate) fn outweighs(&self, unresisted: &Residual) -> bool {
        unresisted.is_within(&self.0.scaled(UNBALANCED))
    }
}

/// Returns `true` if an interaction without stiffness exerts a load.
pub(crate) fn is_loaded(interactions: &[Box<dyn Interaction>], state: &State) -> bool {
    let mut loads = Loads::zeros(state);
    let mut stiffness = Stiffness::default();
    interactions.iter().any(|interaction| {
        stiffness.clear();
        if let Some(second_order) = interaction.second_order() {
            second_order.add_stiffness(state, &mut stiffness);
        }
        if stiffness.all().next().is_some() {
            return false;
        }
        loads.clear();
        interaction.add_loads(state, &mut loads);
        largest_norm(&loads.force) > 0.0 || largest_norm(&loads.torque) > 0.0
    })
}

fn largest_norm(vectors: &Vectors) -> f64 {
    vectors.iter().map(|v| v.norm()).fold(0.0, f64::max)
}

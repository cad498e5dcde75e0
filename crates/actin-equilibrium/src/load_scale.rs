//! Magnitude of the loads of a state, for relative residuals.

use actin_mechanics::{Interaction, Loads, Residual, State, Stiffness, Vectors};

/// Residual relative to the loads below which further steps are useless.
const SMALL: f64 = 1e-8;
/// Resultant relative to the loads above which they are unbalanced: more than rounding to six
/// digits.
const UNBALANCED: f64 = 1e-3;

/// Largest load of any single interaction, since the loads cancel in equilibrium.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LoadScale(Residual);

impl LoadScale {
    /// Largest force on a point and torque on a frame, including held ones. Arms between two
    /// lengths (nm) convert forces to torques and torques to forces.
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

    /// Returns `true` if a residual is small compared with the loads.
    pub(crate) fn dwarfs(&self, residual: &Residual) -> bool {
        residual.is_within(&self.0.scaled(SMALL))
    }

    /// Returns `true` if loads along zero-stiffness motions are within the error of the loads.
    pub(crate) fn outweighs(&self, unresisted: &Residual) -> bool {
        unresisted.is_within(&self.0.scaled(UNBALANCED))
    }
}

/// Returns `true` if an interaction without stiffness, such as a dead load, exerts a load. Torques
/// and forces at an arm have a stiffness.
pub(crate) fn is_loaded(interactions: &[Box<dyn Interaction>], state: &State) -> bool {
    let mut loads = Loads::zeros(state);
    let mut stiffness = Stiffness::default();
    interactions.iter().any(|interaction| {
        stiffness.clear();
        if let Some(second_order) = interaction.second_order() {
            second_order.add_stiffness(state, &mut stiffness);
        }
        if !stiffness.blocks().is_empty() {
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

//! Size of the loads of a state, against which a residual is small or not.

use actin_mechanics::{Interaction, Loads, Residual, State, Stiffness, Vectors};

/// Residual, as a share of the loads, below which further steps gain nothing.
const SMALL: f64 = 1e-8;
/// Resultant, as a share of the loads, above which they are unbalanced: more than six written digits leave.
const UNBALANCED: f64 = 1e-3;

/// Largest load of a single interaction: the loads of all together cancel in equilibrium.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LoadScale(Residual);

impl LoadScale {
    /// Largest force on a point and torque on a frame, held ones included. Forces act at arms between two lengths
    /// (nm), which turn forces into couples and couples into forces.
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

    /// Whether a residual is small against the loads.
    pub(crate) fn dwarfs(&self, residual: &Residual) -> bool {
        residual.is_within(&self.0.scaled(SMALL))
    }

    /// Whether loads along motions without stiffness are too small to be more than an error.
    pub(crate) fn outweighs(&self, unresisted: &Residual) -> bool {
        unresisted.is_within(&self.0.scaled(UNBALANCED))
    }
}

/// Whether an interaction without stiffness, such as a dead load, exerts a load. Couples and forces at an arm have a
/// stiffness.
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

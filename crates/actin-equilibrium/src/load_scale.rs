//! Size of the loads of a state, against which a residual is small or not.

use actin_mechanics::{Interaction, Loads, Residual, State, Stiffness, Vectors};

/// Residual, as a share of the loads, below which further steps gain nothing.
const SMALL: f64 = 1e-8;
/// Resultant, as a share of the loads, above which they are unbalanced: more than six written digits leave.
const UNBALANCED: f64 = 1e-3;

/// Loads of single interactions: those of all together cancel in equilibrium.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LoadScale {
    /// Largest force on a point and largest torque on a frame, held ones included.
    largest: Residual,
    /// Whether an interaction without stiffness, such as a dead load, exerts any.
    pub(crate) is_loaded: bool,
}

impl LoadScale {
    pub(crate) fn new(interactions: &[Box<dyn Interaction>], state: &State) -> Self {
        let mut scale = Self {
            largest: Residual::default(),
            is_loaded: false,
        };
        let mut loads = Loads::zeros(state);
        let mut stiffness = Stiffness::default();
        for interaction in interactions {
            loads.clear();
            interaction.add_loads(state, &mut loads);
            let own = Residual {
                force: largest_norm(&loads.force),
                torque: largest_norm(&loads.torque),
            };
            scale.largest = scale.largest.max(&own);
            if !scale.is_loaded && own != Residual::default() {
                stiffness.clear();
                if let Some(second_order) = interaction.second_order() {
                    second_order.add_stiffness(state, &mut stiffness);
                }
                scale.is_loaded = stiffness.blocks().is_empty();
            }
        }
        scale
    }

    /// Whether a residual is small against the loads, which act at arms between two lengths (nm).
    pub(crate) fn dwarfs(&self, residual: &Residual, arms: [f64; 2]) -> bool {
        residual.is_within(&self.acting_at(arms).scaled(SMALL))
    }

    /// Whether loads along motions without stiffness are too small to be more than an error.
    pub(crate) fn outweighs(&self, unresisted: &Residual, arms: [f64; 2]) -> bool {
        unresisted.is_within(&self.acting_at(arms).scaled(UNBALANCED))
    }

    /// The loads, with the couples of forces and the forces of couples.
    fn acting_at(&self, [shortest, longest]: [f64; 2]) -> Residual {
        let Residual { force, torque } = self.largest;
        Residual {
            force: force.max(torque / longest),
            torque: torque.max(force * shortest),
        }
    }
}

fn largest_norm(vectors: &Vectors) -> f64 {
    vectors.iter().map(|v| v.norm()).fold(0.0, f64::max)
}

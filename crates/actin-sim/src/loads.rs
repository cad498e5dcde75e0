//! Loads of interactions in a state.

use actin_mechanics::{Interaction, Loads, State};

/// Returns the sum of the loads of interactions in a state.
pub(crate) fn loads_of<'a>(
    interactions: impl IntoIterator<Item = &'a Box<dyn Interaction>>,
    state: &State,
) -> Loads {
    let mut loads = Loads::zeros(state);
    for interaction in interactions {
        interaction.add_loads(state, &mut loads);
    }
    loads
}

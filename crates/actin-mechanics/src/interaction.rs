//! What acts on bodies.

use crate::{Coordinates, Loads, RandomStress, SecondOrder, State};
use std::fmt::Debug;

/// A term of the model: some elements of one kind (springs, joints, loads).
///
/// An interaction holds parameters and index ranges only; whatever changes is in the state.
/// Unless [`is_conservative`](Interaction::is_conservative) says otherwise, its loads are minus
/// the gradient of its energy: force `-dE/dx` in the lab frame; torque `-dE/dphi`, where the
/// orientation changes as `Q exp(phi)`, in the body frame.
pub trait Interaction: Debug + Send + Sync {
    /// Name of the term, the same for all interactions of one kind.
    fn term(&self) -> &'static str;

    /// Adds the loads of all elements to the caller's buffers. Allocates nothing.
    fn add_loads(&self, state: &State, loads: &mut Loads);

    /// Number of elements.
    fn elements(&self) -> usize;

    /// Writes the energy of each element.
    ///
    /// # Panics
    /// If `energies` is not as long as [`elements`](Interaction::elements) says.
    fn write_energies(&self, state: &State, energies: &mut [f64]);

    /// Whether the loads are minus the gradient of the energy.
    fn is_conservative(&self) -> bool {
        true
    }

    /// Counts in the controls of `state` the turns of bodies on which the energy depends. Between two counts
    /// a body turns by less than a full turn; [`System`](crate::System) and solvers count whenever bodies
    /// have moved.
    fn count_turns(&self, _state: &mut State) {}

    /// The second derivatives of the energy, where the interaction knows them.
    fn second_order(&self) -> Option<&dyn SecondOrder> {
        None
    }

    /// Random stress of its elements, where the interaction has strains.
    fn random_stress(&self) -> Option<&dyn RandomStress> {
        None
    }

    /// A body that passes through another on the straight way from one state to another, if this
    /// interaction is there to prevent that: energies before and behind do not tell. Solvers refuse
    /// such steps, runs end.
    fn passes_through(&self, _from: &State, _to: &State) -> Option<Coordinates> {
        None
    }

    /// Energy of all elements.
    fn energy(&self, state: &State) -> f64 {
        let mut energies = vec![0.0; self.elements()];
        self.write_energies(state, &mut energies);
        energies.iter().sum()
    }
}

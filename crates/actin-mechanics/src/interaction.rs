//! Interface of force terms.

use crate::{Coordinates, Loads, RandomStress, SecondOrder, State};
use std::fmt::Debug;

/// Two bodies on collision course; equal for a body and a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Approach {
    /// The bodies.
    pub bodies: [Coordinates; 2],
    /// Fraction of the path up to the accepted distance, from 0 to 1.
    pub fraction: f64,
}

/// A term of the model: elements of one kind, such as springs, joints or loads.
///
/// All variables are in the state. If [`is_conservative`](Interaction::is_conservative) is `true`,
/// loads are minus the gradient of the energy:
///
/// ```text
/// force  = -dE/dx      (lab frame)
/// torque = -dE/dphi    (body frame, with the orientation Q exp(phi))
/// ```
pub trait Interaction: Debug + Send + Sync {
    /// Name of the term, equal for all interactions of one kind.
    fn term(&self) -> &'static str;

    /// Adds the loads of all elements to the caller's buffers, without allocation.
    fn add_loads(&self, state: &State, loads: &mut Loads);

    /// Number of elements.
    fn elements(&self) -> usize;

    /// Writes the energy of each element.
    ///
    /// # Panics
    /// If the length of `energies` differs from [`elements`](Interaction::elements).
    fn write_energies(&self, state: &State, energies: &mut [f64]);

    /// Returns `true` if the loads are minus the gradient of the energy.
    fn is_conservative(&self) -> bool {
        true
    }

    /// Counts turns of bodies in the controls of `state`, if the energy depends on them.
    ///
    /// A body must rotate by less than one turn between two calls, which systems and solvers make
    /// after each motion.
    fn count_turns(&self, _state: &mut State) {}

    /// Second derivatives of the energy, or `None` if not implemented.
    fn second_order(&self) -> Option<&dyn SecondOrder> {
        None
    }

    /// Random stress of the elements, or `None` if the interaction has no strains.
    fn random_stress(&self) -> Option<&dyn RandomStress> {
        None
    }

    /// Returns a body that passes through another one on the straight path between two states.
    ///
    /// For interactions that prevent crossings, which energies do not show. Solvers reject such
    /// steps, and runs stop.
    fn passes_through(&self, _from: &State, _to: &State) -> Option<Coordinates> {
        None
    }

    /// Pairs of bodies that approach too much on the straight path between two states.
    ///
    /// Methods with long steps shorten the motion of these bodies to the accepted fraction, so that
    /// they meet instead of passing through each other. The default is no pair.
    fn approaches(&self, _from: &State, _to: &State) -> Vec<Approach> {
        Vec::new()
    }

    /// Sum of the energies of all elements.
    fn energy(&self, state: &State) -> f64 {
        let mut energies = vec![0.0; self.elements()];
        self.write_energies(state, &mut energies);
        energies.iter().sum()
    }
}

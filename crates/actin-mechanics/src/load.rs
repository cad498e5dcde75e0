//! A dead load: a constant force on some points.

use crate::{Interaction, Loads, SecondOrder, State, Stiffness, Vector3};

/// A force that keeps its direction, shared among points and scaled by a control.
#[derive(Clone, Debug, PartialEq)]
pub struct PointLoad {
    /// Points and the share of the force that each takes.
    pub shares: Vec<(usize, f64)>,
    /// Where each of these points has zero potential, lab frame.
    pub origin: Vec<Vector3>,
    /// Force at control value 1, lab frame.
    pub force: Vector3,
    /// Index of the load factor in [`State::controls`].
    pub control: usize,
}

impl PointLoad {
    /// The load with its zero of potential at the present positions.
    pub fn new(state: &State, shares: Vec<(usize, f64)>, force: Vector3, control: usize) -> Self {
        let origin = shares
            .iter()
            .map(|&(i, _)| state.points.position.get(i))
            .collect();
        Self {
            shares,
            origin,
            force,
            control,
        }
    }
}

impl Interaction for PointLoad {
    fn term(&self) -> &'static str {
        "load"
    }

    fn add_loads(&self, state: &State, loads: &mut Loads) {
        let factor = state.controls[self.control];
        for &(i, share) in &self.shares {
            loads.force.add(i, self.force * (factor * share));
        }
    }

    fn second_order(&self) -> Option<&dyn SecondOrder> {
        Some(self)
    }

    fn elements(&self) -> usize {
        self.shares.len()
    }

    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        let factor = state.controls[self.control];
        for ((energy, &(i, share)), origin) in
            energies.iter_mut().zip(&self.shares).zip(&self.origin)
        {
            let displacement = state.points.position.get(i) - origin;
            *energy = -factor * share * self.force.dot(&displacement);
        }
    }
}

impl SecondOrder for PointLoad {
    /// A dead load has no stiffness.
    fn add_stiffness(&self, _state: &State, _stiffness: &mut Stiffness) {}
}

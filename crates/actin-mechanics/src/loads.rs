//! Forces on points and torques on frames.

use crate::{State, Vectors};

/// The loads on a [`State`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Loads {
    /// Force on each point, lab frame.
    pub force: Vectors,
    /// Torque on each frame, body frame.
    pub torque: Vectors,
}

impl Loads {
    /// Zero loads for every body of `state`.
    pub fn zeros(state: &State) -> Self {
        Self {
            force: Vectors::zeros(state.points.len()),
            torque: Vectors::zeros(state.frames.len()),
        }
    }

    /// Sets every load to zero.
    pub fn clear(&mut self) {
        self.force.clear_to_zero();
        self.torque.clear_to_zero();
    }

    /// Largest norm of a force on a free point and of a torque on a free frame.
    pub fn residual(&self, state: &State) -> (f64, f64) {
        let force = (0..self.force.len())
            .filter(|&i| state.points.is_free(i))
            .map(|i| self.force.get(i).norm())
            .fold(0.0, f64::max);
        let torque = (0..self.torque.len())
            .filter(|&i| state.frames.is_free(i))
            .map(|i| self.torque.get(i).norm())
            .fold(0.0, f64::max);
        (force, torque)
    }
}

//! Forces on points and torques on frames.

use crate::sums::add_product;
use crate::{Residual, State, Vectors};

/// Loads on a [`State`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Loads {
    /// Force on each point (lab frame).
    pub force: Vectors,
    /// Torque on each frame (body frame).
    pub torque: Vectors,
}

impl Loads {
    /// Zero loads for all bodies of `state`.
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

    /// Adds `other`, which must have equal length.
    pub fn add(&mut self, other: &Self) {
        add_product(&mut self.force, &other.force, 1.0);
        add_product(&mut self.torque, &other.torque, 1.0);
    }

    /// Largest norm of the forces on free points and of the torques on free frames. For sliding
    /// bodies, the total force along their directions is used.
    pub fn residual(&self, state: &State) -> Residual {
        let force = (0..self.force.len())
            .filter(|&i| state.points.is_free(i))
            .map(|i| self.force.get(i).norm())
            .chain(self.sliding_forces(state))
            .fold(0.0, f64::max);
        let torque = (0..self.torque.len())
            .filter(|&i| state.frames.is_free(i))
            .map(|i| self.torque.get(i).norm())
            .fold(0.0, f64::max);
        Residual { force, torque }
    }

    /// Magnitude of the total force on each sliding body along its directions.
    fn sliding_forces<'a>(&'a self, state: &'a State) -> impl Iterator<Item = f64> + 'a {
        state.sliders.iter().map(|slider| {
            let squares = slider.forces(&self.force).map(|f| f * f);
            squares.sum::<f64>().sqrt()
        })
    }
}

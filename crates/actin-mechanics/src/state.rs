//! The state of everything that moves.

use crate::{Frames, Points, Slider};

/// Points, frames and controls.
///
/// Points and frames stand in the order of the structure, each kind in arrays of its own.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct State {
    /// Positions with masses.
    pub points: Points,
    /// Orientations with inertias.
    pub frames: Frames,
    /// What is set from outside: load factors, by the index that a load was built with.
    pub controls: Vec<f64>,
    /// Held bodies that slide together.
    pub sliders: Vec<Slider>,
    /// Time, by which a drive places what it moves.
    pub time: f64,
}

impl State {
    /// Kinetic energy of the free bodies, sliding ones included.
    pub fn kinetic_energy(&self) -> f64 {
        let sliding: f64 = self.sliders.iter().map(|s| s.kinetic_energy(self)).sum();
        self.points.kinetic_energy() + self.frames.kinetic_energy() + sliding
    }

    /// Whether every position, velocity, orientation and angular momentum is finite.
    pub fn is_finite(&self) -> bool {
        let q = &self.frames.orientation;
        let vectors = [
            &self.points.position,
            &self.points.velocity,
            &self.frames.angular_momentum,
        ];
        vectors
            .iter()
            .flat_map(|v| [&v.x, &v.y, &v.z])
            .chain([&q.w, &q.x, &q.y, &q.z])
            .flatten()
            .all(|c| c.is_finite())
    }

    /// Stops every free body; held bodies keep their prescribed motion.
    pub fn stop(&mut self) {
        for i in 0..self.points.len() {
            if self.points.is_free(i) {
                self.points.velocity.set(i, crate::Vector3::zeros());
            }
        }
        for slider in &self.sliders {
            slider.damp(&mut self.points.velocity, 0.0);
        }
        for i in 0..self.frames.len() {
            if self.frames.is_free(i) {
                self.frames.angular_momentum.set(i, crate::Vector3::zeros());
            }
        }
    }
}

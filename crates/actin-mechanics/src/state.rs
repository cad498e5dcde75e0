//! State of all bodies.

use crate::{ControlId, Controls, Frames, Points, Shared, Slider, Vector3};

/// Points, frames and controls.
///
/// Copies share masses, inertias, holds and sliders until one of them changes these.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct State {
    /// Positions with masses.
    pub points: Points,
    /// Orientations with inertias.
    pub frames: Frames,
    /// Values set from outside: load factors and displacements of anchors.
    pub controls: Controls,
    /// Held points that slide together.
    pub sliders: Shared<Vec<Slider>>,
    /// Time, which determines the positions of driven bodies.
    pub time: f64,
}

impl State {
    /// Adds a control with the given value and returns its identifier.
    ///
    /// ```
    /// use actin_mechanics::State;
    /// let mut state = State::default();
    /// let factor = state.add_control(1.0);
    /// state.controls[factor] = 0.5;
    /// assert_eq!(state.controls.values(), [0.5]);
    /// ```
    pub fn add_control(&mut self, value: f64) -> ControlId {
        self.controls.add(value)
    }

    /// Kinetic energy of free and sliding bodies.
    pub fn kinetic_energy(&self) -> f64 {
        let (points, frames) = self.kinetic_energies();
        points + frames
    }

    /// Kinetic energies of free and sliding points, and of free frames.
    pub(crate) fn kinetic_energies(&self) -> (f64, f64) {
        let sliding: f64 = self
            .sliders
            .iter()
            .map(|s| s.kinetic_energy(&self.points))
            .sum();
        let points = self.points.kinetic_energy() + sliding;
        (points, self.frames.kinetic_energy())
    }

    /// Total momentum of free points.
    pub fn momentum(&self) -> Vector3 {
        let free = (0..self.points.len()).filter(|&i| self.points.is_free(i));
        free.map(|i| self.points.momentum(i)).sum()
    }

    /// Total angular momentum of free bodies about the origin (lab frame).
    pub fn angular_momentum(&self) -> Vector3 {
        let points = (0..self.points.len()).filter(|&i| self.points.is_free(i));
        let orbital = points.map(|i| self.points.position.get(i).cross(&self.points.momentum(i)));
        let frames = (0..self.frames.len()).filter(|&i| self.frames.is_free(i));
        let spin =
            frames.map(|i| self.frames.orientation.get(i) * self.frames.angular_momentum.get(i));
        orbital.chain(spin).sum()
    }

    /// Returns `true` if all positions, velocities, orientations and angular momenta are finite.
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

    pub(crate) fn assert_shape(&self) {
        self.points.assert_shape();
        self.frames.assert_shape();
        for slider in self.sliders.iter() {
            slider.assert_sound(self.points.len());
        }
    }

    /// Copies the time-dependent part of `other`, a state of the same bodies, without allocation.
    ///
    /// # Panics
    /// If `other` has other numbers of bodies or controls.
    pub fn copy_motion_from(&mut self, other: &Self) {
        // Exhaustive, so that a new field of the state causes a compiler error here.
        let Self {
            points,
            frames,
            controls,
            sliders: _,
            time,
        } = self;
        points.position.copy_from(&other.points.position);
        points.velocity.copy_from(&other.points.velocity);
        frames.orientation.copy_from(&other.frames.orientation);
        let momentum = &other.frames.angular_momentum;
        frames.angular_momentum.copy_from(momentum);
        controls.copy_from(&other.controls);
        *time = other.time;
    }

    /// Sets the velocities of free bodies to zero. Held bodies keep their prescribed velocities.
    pub fn stop(&mut self) {
        for i in 0..self.points.len() {
            if self.points.is_free(i) {
                self.points.velocity.set(i, crate::Vector3::zeros());
            }
        }
        for slider in self.sliders.iter() {
            slider.damp(&mut self.points.velocity, 0.0);
        }
        for i in 0..self.frames.len() {
            if self.frames.is_free(i) {
                self.frames.angular_momentum.set(i, crate::Vector3::zeros());
            }
        }
    }
}

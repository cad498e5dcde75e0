//! Time-dependent part of a state.

use crate::{Controls, Quaternions, State, Vectors};

/// Positions, velocities, controls and time: the part of a [`State`] that checkpoints store.
/// Masses, inertias and holds are not included.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Motion {
    /// Positions of the points (lab frame).
    pub position: Vectors,
    /// Velocities of the points (lab frame).
    pub velocity: Vectors,
    /// Orientations of the frames, body to lab.
    pub orientation: Quaternions,
    /// Angular momenta of the frames (body frame).
    pub angular_momentum: Vectors,
    /// Values that are set from outside.
    pub controls: Controls,
    /// Time, which determines the positions of driven bodies.
    pub time: f64,
}

impl Motion {
    /// Returns `true` if the numbers of bodies and controls equal those of `state`.
    pub fn fits(&self, state: &State) -> bool {
        let (points, frames) = (state.points.len(), state.frames.len());
        let vectors = [
            (&self.position, points),
            (&self.velocity, points),
            (&self.angular_momentum, frames),
        ];
        let q = &self.orientation;
        let turns = [&q.w, &q.x, &q.y, &q.z];
        vectors.iter().all(|(v, n)| v.has_len(*n))
            && turns.iter().all(|q| q.len() == frames)
            && self.controls.len() == state.controls.len()
    }
}

impl State {
    /// Returns a copy of the time-dependent part.
    pub fn motion(&self) -> Motion {
        self.clone().into_motion()
    }

    /// Returns the time-dependent part.
    pub fn into_motion(self) -> Motion {
        // A new field of the state is a compiler error here.
        let Self {
            points,
            frames,
            controls,
            sliders: _,
            time,
        } = self;
        Motion {
            position: points.position,
            velocity: points.velocity,
            orientation: frames.orientation,
            angular_momentum: frames.angular_momentum,
            controls,
            time,
        }
    }

    /// Replaces the time-dependent part, without allocation.
    ///
    /// # Panics
    /// If `motion` has other numbers of bodies or controls.
    pub fn set_motion(&mut self, motion: &Motion) {
        let Motion {
            position,
            velocity,
            orientation,
            angular_momentum,
            controls,
            time,
        } = motion;
        self.points.position.copy_from(position);
        self.points.velocity.copy_from(velocity);
        self.frames.orientation.copy_from(orientation);
        self.frames.angular_momentum.copy_from(angular_momentum);
        self.controls.copy_from(controls);
        self.time = *time;
    }

    /// Returns a state with the given motion that shares masses, inertias, holds and sliders with
    /// `self`.
    ///
    /// # Panics
    /// If `motion` has other numbers of bodies or controls.
    #[must_use]
    pub fn in_motion(&self, motion: Motion) -> Self {
        assert!(
            motion.fits(self),
            "a motion must have as many bodies and controls as the state"
        );
        let (mut points, mut frames) = (self.points.bodies(), self.frames.bodies());
        points.position = motion.position;
        points.velocity = motion.velocity;
        frames.orientation = motion.orientation;
        frames.angular_momentum = motion.angular_momentum;
        Self {
            points,
            frames,
            controls: motion.controls,
            sliders: self.sliders.clone(),
            time: motion.time,
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::testing::{push_frame, push_point};
    use crate::{State, UnitQuaternion, Vector3, Xorshift, perturb, randomise_velocities};

    fn states() -> [State; 2] {
        let mut state = State::default();
        for _ in 0..3 {
            push_point(&mut state, Vector3::zeros(), 1.0);
            push_frame(&mut state, UnitQuaternion::identity(), [1.0, 1.0, 2.0]);
        }
        let controls = [0.0; 2].map(|value| state.add_control(value));
        let mut moved = state.clone();
        let mut noise = Xorshift::new(3);
        perturb(&mut moved, &mut noise, 1.0, 1.0);
        randomise_velocities(&mut moved, &mut noise, 1.0, 1.0);
        moved.controls[controls[0]] = 0.25;
        moved.controls[controls[1]] = -1.0;
        moved.time = 7.0;
        [state, moved]
    }

    #[test]
    fn motion_is_copied_completely() {
        let [state, moved] = states();
        let mut copies = [state.clone(), state.clone()];
        copies[0].copy_motion_from(&moved);
        copies[1].set_motion(&moved.motion());
        assert_eq!(copies, [moved.clone(), moved.clone()]);
        assert_eq!(state.in_motion(moved.motion()), moved);
    }

    #[test]
    fn a_copy_has_its_own_masses() {
        let [state, mut moved] = states();
        moved.points.hold(1);
        assert!(state.points.is_free(1) && !moved.points.is_free(1));
    }
}

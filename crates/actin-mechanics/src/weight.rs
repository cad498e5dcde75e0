//! Weight: a force per mass that is the same everywhere.

use crate::{ControlId, Interaction, LoadError, Loads, SecondOrder, State, Stiffness, Vector3};

/// The weight of all points under a uniform acceleration, scaled by a control: term `weight`, one
/// element.
///
/// With `m` the masses, `a` the acceleration and `c` the control, each point meets the force
/// `c m a`, and `E = -c sum m a . x`, which is zero where all points lie at the lab origin. Points
/// that are held have their weight too, so that it shows in what holds them; frames have none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weight {
    acceleration: Vector3,
    control: ControlId,
}

impl Weight {
    /// The weight of all points of `state`, those included that are still to come, under an
    /// acceleration (lab frame), with a control of its own that begins at 1.
    ///
    /// ```
    /// use actin_mechanics::{Interaction, Loads, Point, State, Vector3, Weight};
    /// let mut state = State::default();
    /// let weight = Weight::new(&mut state, Vector3::z() * -9.81)?;
    /// let stone = state.points.push(Point { position: Vector3::z() * 2.0, mass: 3.0 });
    /// let mut loads = Loads::zeros(&state);
    /// weight.add_loads(&state, &mut loads);
    /// assert!((loads.force.get(stone).z + 3.0 * 9.81).abs() < 1e-14);
    /// // m g h
    /// assert!((weight.energy(&state) - 3.0 * 9.81 * 2.0).abs() < 1e-14);
    /// # Ok::<(), actin_mechanics::LoadError>(())
    /// ```
    ///
    /// # Errors
    /// An acceleration that is not finite; the state is then unchanged.
    pub fn new(state: &mut State, acceleration: Vector3) -> Result<Self, LoadError> {
        LoadError::unless_finite("acceleration", acceleration)?;
        Ok(Self {
            acceleration,
            control: state.add_control(1.0),
        })
    }

    /// Its factor.
    pub fn control(&self) -> ControlId {
        self.control
    }
}

impl Interaction for Weight {
    fn term(&self) -> &'static str {
        "weight"
    }

    fn add_loads(&self, state: &State, loads: &mut Loads) {
        let acceleration = self.acceleration * state.controls[self.control];
        for i in 0..state.points.len() {
            loads.force.add(i, acceleration * state.points.mass(i));
        }
    }

    fn elements(&self) -> usize {
        1
    }

    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        assert_eq!(energies.len(), 1, "weight is one element");
        let points = &state.points;
        let moment: Vector3 = (0..points.len())
            .map(|i| points.position.get(i) * points.mass(i))
            .sum();
        energies[0] = -state.controls[self.control] * self.acceleration.dot(&moment);
    }

    fn second_order(&self) -> Option<&dyn SecondOrder> {
        Some(self)
    }
}

impl SecondOrder for Weight {
    /// A uniform force has no stiffness.
    fn add_stiffness(&self, _state: &State, _stiffness: &mut Stiffness) {}
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::push_point;
    use crate::testing::{assert_is_gradient, loads_of};
    use crate::{Split, System};

    fn stones() -> (State, Weight) {
        let mut state = State::default();
        let weight = Weight::new(&mut state, Vector3::new(0.5, 0.0, -2.0)).unwrap();
        for mass in [1.0, 3.0] {
            push_point(&mut state, Vector3::repeat(mass), mass);
        }
        (state, weight)
    }

    #[test]
    fn accelerations_that_are_not_finite_are_refused() {
        let mut state = State::default();
        for bad in [f64::NAN, f64::INFINITY] {
            assert!(Weight::new(&mut state, Vector3::x() * bad).is_err());
        }
        assert_eq!(state, State::default());
    }

    /// All stones fall alike; one that is held keeps its weight, and falls like the others as soon
    /// as it is released.
    #[test]
    fn stones_fall_alike_and_held_ones_keep_their_weight() {
        let (mut state, weight) = stones();
        assert_is_gradient(&weight, &state, 1e-2, 1e-11);
        let before = loads_of(&weight, &state);
        state.points.hold(1);
        assert_eq!(loads_of(&weight, &state), before);
        state.points.release(1);
        state.controls[weight.control()] = 0.5;
        let mut system = System::new(state, vec![Box::new(weight)]);
        system.kick(4.0, 4.0);
        for i in 0..2 {
            let v = system.state().points.velocity.get(i);
            assert!((v - Vector3::new(1.0, 0.0, -4.0)).norm() < 1e-15);
        }
    }
}

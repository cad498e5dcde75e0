//! Weight: a uniform acceleration of all points.

use crate::{ControlId, Interaction, LoadError, Loads, SecondOrder, State, Stiffness, Vector3};

/// Weight of all points under a uniform acceleration, scaled by a control: term `weight`, one
/// element.
///
/// ```text
/// F_i = c m_i a              (lab frame)
/// E   = -c sum m_i a . x_i
/// ```
///
/// `m` are the masses, `a` is the acceleration and `c` the control. Held points have weight too;
/// frames have none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weight {
    acceleration: Vector3,
    control: ControlId,
}

impl Weight {
    /// Creates the weight of all points of `state`, including points added later, with a new
    /// control of value 1.
    ///
    /// `acceleration` is in the lab frame.
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
    /// If the acceleration is not finite. The state is unchanged on error.
    pub fn new(state: &mut State, acceleration: Vector3) -> Result<Self, LoadError> {
        LoadError::check_finite("acceleration", acceleration)?;
        Ok(Self {
            acceleration,
            control: state.add_control(1.0),
        })
    }

    /// Control that is the load factor.
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

    #[test]
    fn points_fall_equally_and_held_ones_keep_their_weight() {
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

use actin_mechanics::{ControlId, Matrix3, State, UnitQuaternion, Vector3};

/// Linear flow `u(x) = velocity + gradient x` (lab frame).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Flow {
    /// Velocity at the origin (nm/ns).
    pub velocity: Vector3,
    /// Velocity gradient, `du_i/dx_j` (1/ns).
    pub gradient: Matrix3,
    /// Control with prescribed values, and velocity gradient per rate of change of this control.
    pub driven: Option<(ControlId, Matrix3)>,
}

impl Flow {
    /// Creates a uniform flow with a velocity (nm/ns).
    pub fn stream(velocity: Vector3) -> Self {
        Self {
            velocity,
            ..Self::default()
        }
    }

    /// Creates a shear flow in direction `along` with the shear rate `rate` (1/ns) in direction
    /// `across`.
    ///
    /// ```
    /// use actin_brownian::{Flow, Vector3};
    /// let flow = Flow::shear(0.5, Vector3::x(), Vector3::y());
    /// assert_eq!(flow.velocity_at(Vector3::new(7.0, 4.0, 0.0)), Vector3::x() * 2.0);
    /// ```
    pub fn shear(rate: f64, along: Vector3, across: Vector3) -> Self {
        Self {
            velocity: Vector3::zeros(),
            gradient: along * across.transpose() * rate,
            driven: None,
        }
    }

    /// Flow during the motion between two states, with the mean rate of change of the control.
    pub(crate) fn between(&self, from: &State, to: &State) -> Self {
        let passed = to.time - from.time;
        match self.driven {
            Some((control, gradient)) if passed > 0.0 => {
                let change = to.controls[control] - from.controls[control];
                Self {
                    gradient: self.gradient + gradient * (change / passed),
                    ..*self
                }
            }
            _ => *self,
        }
    }

    /// Velocity at a position (nm/ns).
    pub fn velocity_at(&self, place: Vector3) -> Vector3 {
        self.velocity + self.gradient * place
    }

    /// Angular velocity (rad/ns, body axes) of a slender body with the direction `t` of its third
    /// axis. Its component across the axis is `t x G t`, with the velocity gradient `G`. Its
    /// component along the axis is half of the vorticity.
    pub(crate) fn turning(&self, q: UnitQuaternion) -> Vector3 {
        let g = &self.gradient;
        if *g == Matrix3::zeros() {
            return Vector3::zeros();
        }
        let axis = q * Vector3::z();
        let turning = axis.cross(&(g * axis)) + axis * self.rotation().dot(&axis);
        q.inverse_transform_vector(&turning)
    }

    /// Angular velocity of the fluid and of a sphere in it (rad/ns, lab frame), half of the vorticity.
    fn rotation(&self) -> Vector3 {
        let g = &self.gradient;
        let curl = Vector3::new(
            g[(2, 1)] - g[(1, 2)],
            g[(0, 2)] - g[(2, 0)],
            g[(1, 0)] - g[(0, 1)],
        );
        curl * 0.5
    }

    /// Difference of the angular velocities of a sphere and a slender body (rad/ns, body axes).
    pub(crate) fn turning_of_sphere(&self, q: UnitQuaternion) -> Vector3 {
        q.inverse_transform_vector(&self.rotation()) - self.turning(q)
    }

    /// Velocity at the end of an arm (body axes) relative to its start, less the velocity of an arm that turns with a slender
    /// body (nm/ns, body axes).
    pub(crate) fn along_arm(&self, q: UnitQuaternion, arm: &Vector3) -> Vector3 {
        let velocity = self.gradient * (q * arm);
        q.inverse_transform_vector(&velocity) - self.turning(q).cross(arm)
    }
}

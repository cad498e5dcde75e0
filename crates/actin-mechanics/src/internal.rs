//! Internal forces and torques of constant components in the axes of their frames.

use crate::{Coordinates, Loads, Matrix3, State, Stiffness, UnitQuaternion, Vector3, rotation};

/// Force between two points with constant components in the axes of a frame:
/// `E = -n . Q^T (x_b - x_a)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InternalForce {
    /// Points `a` and `b`.
    pub points: [usize; 2],
    /// Index of the frame `Q`.
    pub frame: usize,
    /// Force `n` on `b` (axes of the frame).
    pub force: Vector3,
}

/// Torque between two frames, constant and conjugate to their relative rotation vector:
/// `E = -m . log(O^T Qa^T Qb)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InternalCouple {
    /// Frames `a` and `b`.
    pub frames: [usize; 2],
    /// Relative orientation `O` of `b` in `a` at rest.
    pub rest: UnitQuaternion,
    /// Torque `m`, conjugate to the rotation vector.
    pub couple: Vector3,
}

impl InternalForce {
    fn seen(&self, state: &State) -> (Matrix3, Vector3) {
        let axes = axes(state, self.frame);
        let [a, b] = self.points.map(|i| state.points.position.get(i));
        (axes, axes.tr_mul(&(b - a)))
    }

    /// Adds the loads: `-Q n` and `Q n` on the points, `n x y` on the frame, with
    /// `y = Q^T (x_b - x_a)`.
    pub fn add_loads(&self, state: &State, loads: &mut Loads) {
        let (axes, y) = self.seen(state);
        let force = axes * self.force;
        loads.force.add(self.points[0], -force);
        loads.force.add(self.points[1], force);
        loads.torque.add(self.frame, self.force.cross(&y));
    }

    /// Adds the loads with the axial torque of the rest state, so that displacements do not spin
    /// the frame. `rest` is `Q^T (x_b - x_a)` at rest (axes of the frame).
    pub fn add_loads_without_spin(&self, rest: Vector3, state: &State, loads: &mut Loads) {
        let before = loads.torque.get(self.frame).z;
        self.add_loads(state, loads);
        let mut torque = loads.torque.get(self.frame);
        torque.z = before + self.force.cross(&rest).z;
        loads.torque.set(self.frame, torque);
    }

    /// Adds the second derivatives of the energy.
    pub fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        let [mixed, turn] = self.blocks(state);
        let [a, b] = self.points.map(Coordinates::Point);
        let frame = Coordinates::Frame(self.frame);
        stiffness.push(a, frame, -mixed);
        stiffness.push(b, frame, mixed);
        stiffness.push(frame, frame, turn);
    }

    /// Block of the second point and the frame, and block of the frame.
    fn blocks(&self, state: &State) -> [Matrix3; 2] {
        let (axes, y) = self.seen(state);
        let n = self.force;
        let half = 0.5 * n * y.transpose();
        let turn = Matrix3::from_diagonal_element(n.dot(&y)) - half - half.transpose();
        [axes * n.cross_matrix(), turn]
    }
}

impl InternalCouple {
    /// Relative rotation vector `log(O^T Qa^T Qb)` (rad).
    pub(crate) fn strain(&self, state: &State) -> Vector3 {
        let [a, b] = self.frames.map(|i| state.frames.orientation.get(i));
        rotation::log((a * self.rest).inverse() * b)
    }

    /// Adds the loads: `J_r(theta)^-T m` on `b`, and the opposite torque on `a`, each in its body
    /// axes.
    pub fn add_loads(&self, state: &State, loads: &mut Loads) {
        let theta = self.strain(state);
        let inverse = rotation::right_jacobian_inverse(theta);
        let [a, b] = self.frames;
        loads.torque.add(b, inverse.tr_mul(&self.couple));
        // J_l(theta) = J_r(theta)^T.
        loads.torque.add(a, -(self.rest * (inverse * self.couple)));
    }

    /// Adds the loads with the axial torques of the rest state, so that bending does not spin the
    /// frames.
    pub fn add_loads_without_spin(&self, state: &State, loads: &mut Loads) {
        let before = self.frames.map(|i| loads.torque.get(i).z);
        self.add_loads(state, loads);
        let at_rest = [-(self.rest * self.couple).z, self.couple.z];
        for (k, i) in self.frames.into_iter().enumerate() {
            let z = before[k] + at_rest[k];
            let mut torque = loads.torque.get(i);
            torque.z = z;
            loads.torque.set(i, torque);
        }
    }

    /// Adds the second derivatives of the energy, which depends on `R = O^T Qa^T Qb` alone.
    ///
    /// ```text
    /// K_bb = K = -sym(D J_r^-1),  D = d(J_r(theta)^-T m) / d theta
    /// K_aa = R K R^T              (axes of a)
    /// K_ab = R (-[J_r^-T m]x / 2 - K)
    /// ```
    pub fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        let [first, both, second] = self.blocks(state);
        let [a, b] = self.frames.map(Coordinates::Frame);
        stiffness.push(a, a, first);
        stiffness.push(a, b, both);
        stiffness.push(b, b, second);
    }

    /// Blocks `aa`, `ab` and `bb`.
    fn blocks(&self, state: &State) -> [Matrix3; 3] {
        let theta = self.strain(state);
        let inverse = rotation::right_jacobian_inverse(theta);
        let slope = rotation::right_jacobian_inverse_transpose_slope(theta, self.couple) * inverse;
        let second = -0.5 * (slope + slope.transpose());
        let r = (self.rest * rotation::exp(theta)).to_rotation_matrix();
        let r = r.into_inner();
        let first = r * second * r.transpose();
        let turned = inverse.tr_mul(&self.couple).cross_matrix();
        let both = r * (-0.5 * turned - second);
        [0.5 * (first + first.transpose()), both, second]
    }
}

fn axes(state: &State, frame: usize) -> Matrix3 {
    let q = state.frames.orientation.get(frame);
    q.to_rotation_matrix().into_inner()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{assert_is_balanced, assert_is_gradient, assert_is_stiffness};
    use crate::testing::{push_frame, push_point};
    use crate::{Interaction, SecondOrder, Xorshift, perturb};

    #[derive(Debug)]
    struct Both(InternalForce, InternalCouple);

    impl Interaction for Both {
        fn term(&self) -> &'static str {
            "internal"
        }
        fn elements(&self) -> usize {
            2
        }
        fn add_loads(&self, state: &State, loads: &mut Loads) {
            self.0.add_loads(state, loads);
            self.1.add_loads(state, loads);
        }
        fn write_energies(&self, state: &State, energies: &mut [f64]) {
            let (_, y) = self.0.seen(state);
            energies[0] = -self.0.force.dot(&y);
            energies[1] = -self.1.couple.dot(&self.1.strain(state));
        }
        fn second_order(&self) -> Option<&dyn SecondOrder> {
            Some(self)
        }
    }

    impl SecondOrder for Both {
        fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
            self.0.add_stiffness(state, stiffness);
            self.1.add_stiffness(state, stiffness);
        }
    }

    #[test]
    fn internal_loads_are_the_gradient_of_their_energy() {
        let mut state = State::default();
        for k in 0..2 {
            let position = Vector3::z() * f64::from(k);
            push_point(&mut state, position, 1.0);
            push_frame(
                &mut state,
                rotation::exp(Vector3::new(0.3, 0.1, 2.8) * f64::from(k)),
                [1.0; 3],
            );
        }
        let rest = rotation::exp(Vector3::new(0.25, 0.1, 2.7));
        perturb(&mut state, &mut Xorshift::new(3), 0.1, 0.2);
        let both = Both(
            InternalForce {
                points: [0, 1],
                frame: 0,
                force: Vector3::new(1.0, -2.0, 0.5),
            },
            InternalCouple {
                frames: [0, 1],
                rest,
                couple: Vector3::new(0.4, 1.5, -2.0),
            },
        );
        assert_is_gradient(&both, &state, 1e-4, 1e-8);
        assert_is_stiffness(&both, &state, 1e-4, 1e-7);
        assert_is_balanced(&both, &state, 1e-13);
    }
}

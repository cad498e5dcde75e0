//! Segments and bending elements of a rod.

use super::cross;
use Coordinates::{Frame as F, Point as P};
use actin_mechanics::{
    Coordinates, Interaction, Loads, Matrix3, SecondOrder, State, Stiffness, Vector3, rotation,
};

/// Timoshenko segments: point `i`, point `j`, frame, rest length;
/// `E = l0 (Q^T l / l0 - e3) . S (Q^T l / l0 - e3) / 2`.
#[derive(Debug)]
pub(crate) struct Segments {
    pub(crate) elements: Vec<(usize, usize, usize, f64)>,
    pub(crate) rigidity: Vector3,
}

impl Segments {
    /// `Q^T l` and `S sigma`.
    fn strain(&self, state: &State, e: (usize, usize, usize, f64)) -> (Vector3, Vector3) {
        let (i, j, frame, length) = e;
        let l = state.points.position.get(j) - state.points.position.get(i);
        let u = state.frames.orientation.get(frame).inverse() * l;
        let sigma = u / length - Vector3::z();
        (u, self.rigidity.component_mul(&sigma))
    }
}

impl Interaction for Segments {
    fn term(&self) -> &'static str {
        "segments"
    }
    fn add_loads(&self, state: &State, loads: &mut Loads) {
        for &e in &self.elements {
            let (u, n) = self.strain(state, e);
            let force = state.frames.orientation.get(e.2) * n;
            loads.force.add(e.0, force);
            loads.force.add(e.1, -force);
            loads.torque.add(e.2, u.cross(&n));
        }
    }
    fn elements(&self) -> usize {
        self.elements.len()
    }
    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        for (out, &e) in energies.iter_mut().zip(&self.elements) {
            let (u, n) = self.strain(state, e);
            *out = 0.5 * e.3 * (u / e.3 - Vector3::z()).dot(&n);
        }
    }
    fn second_order(&self) -> Option<&dyn SecondOrder> {
        Some(self)
    }
}

impl SecondOrder for Segments {
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        for &e in &self.elements {
            let (u, n) = self.strain(state, e);
            let s = Matrix3::from_diagonal(&self.rigidity) / e.3;
            let q = state
                .frames
                .orientation
                .get(e.2)
                .to_rotation_matrix()
                .into_inner();
            // l0 d sigma = Q^T dl + u x phi - phi x Q^T dl + phi x (phi x u) / 2.
            let ll = q * s * q.transpose();
            let lf = q * (s * cross(u) - cross(n));
            let ff = cross(u).transpose() * s * cross(u)
                + 0.5 * (n * u.transpose() + u * n.transpose())
                - Matrix3::identity() * n.dot(&u);
            stiffness.push(P(e.0), P(e.0), ll);
            stiffness.push(P(e.1), P(e.1), ll);
            stiffness.push(P(e.0), P(e.1), -ll);
            stiffness.push(P(e.1), F(e.2), lf);
            stiffness.push(P(e.0), F(e.2), -lf);
            stiffness.push(F(e.2), F(e.2), ff);
        }
    }
}

/// Bending and torsion between frames, `E = theta . B theta / (2 D)`, `theta = log(Qa^T Qb)`.
#[derive(Debug)]
pub(crate) struct Bending {
    pub(crate) elements: Vec<(usize, usize, f64)>,
    pub(crate) rigidity: Vector3,
}

impl Bending {
    fn strain(&self, state: &State, e: (usize, usize, f64)) -> (Vector3, Vector3) {
        let q = &state.frames.orientation;
        let theta = rotation::log(q.get(e.0).inverse() * q.get(e.1));
        (theta, self.rigidity.component_mul(&theta) / e.2)
    }
}

impl Interaction for Bending {
    fn term(&self) -> &'static str {
        "bending"
    }
    fn add_loads(&self, state: &State, loads: &mut Loads) {
        for &e in &self.elements {
            let (theta, m) = self.strain(state, e);
            let on_a = rotation::left_jacobian_inverse_transpose(theta, m);
            let on_b = rotation::right_jacobian_inverse_transpose(theta, m);
            loads.torque.add(e.0, on_a);
            loads.torque.add(e.1, -on_b);
        }
    }
    fn elements(&self) -> usize {
        self.elements.len()
    }
    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        for (out, &e) in energies.iter_mut().zip(&self.elements) {
            let (theta, m) = self.strain(state, e);
            *out = 0.5 * theta.dot(&m);
        }
    }
    fn second_order(&self) -> Option<&dyn SecondOrder> {
        Some(self)
    }
}

/// Derivative of the coefficient `c(s)` of the inverse Jacobians by `s = theta^2`.
fn coefficient_slope(s: f64) -> f64 {
    if s < 0.04 {
        1.0 / 720.0 + s * (2.0 / 30_240.0 + s * (3.0 / 1_209_600.0 + s * 4.0 / 47_900_160.0))
    } else {
        let h = 0.5 * s.sqrt();
        let slope = (1.0 / h.tan() - h / h.sin().powi(2)) / (8.0 * h);
        (-slope * s - (1.0 - h / h.tan())) / (s * s)
    }
}

impl SecondOrder for Bending {
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        for &e in &self.elements {
            let (t, m) = self.strain(state, e);
            let s = t.norm_squared();
            let c = rotation::inverse_jacobian_coefficient(s);
            let right_t = Matrix3::identity() - 0.5 * cross(t) + c * cross(t) * cross(t);
            let left_t = right_t.transpose();
            let b = Matrix3::from_diagonal(&self.rigidity) / e.2;
            // d(J^-T m)/d theta at constant m, with the sign of the first order term apart.
            let common = c
                * (Matrix3::identity() * t.dot(&m) + t * m.transpose() - 2.0 * m * t.transpose())
                + 2.0 * coefficient_slope(s) * (t * t.dot(&m) - m * s) * t.transpose();
            let d_right = common + 0.5 * cross(m);
            let d_left = common - 0.5 * cross(m);
            let bb = (right_t * b + d_right) * right_t.transpose();
            let aa = (left_t * b + d_left) * left_t.transpose();
            let ba = -(right_t * b + d_right) * left_t.transpose();
            stiffness.push(F(e.0), F(e.0), 0.5 * (aa + aa.transpose()));
            stiffness.push(F(e.1), F(e.1), 0.5 * (bb + bb.transpose()));
            stiffness.push(F(e.1), F(e.0), ba);
        }
    }
}

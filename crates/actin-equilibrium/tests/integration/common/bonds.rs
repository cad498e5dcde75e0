//! Springs between points and bonds between bodies.

use super::{cross, frame, point};
use Coordinates::{Frame as F, Point as P};
use actin_mechanics::{
    Coordinates, Interaction, Loads, Matrix3, SecondOrder, State, Stiffness, UnitQuaternion,
    Vector3,
};

/// Bars between points, `E = k (l - l0)^2 / 2`.
#[derive(Debug)]
pub(crate) struct Springs(pub(crate) Vec<(usize, usize, f64, f64)>);

impl Interaction for Springs {
    fn term(&self) -> &'static str {
        "springs"
    }
    fn add_loads(&self, state: &State, loads: &mut Loads) {
        for &(i, j, k, rest) in &self.0 {
            let d = state.points.position.get(j) - state.points.position.get(i);
            let f = d * (k * (1.0 - rest / d.norm()));
            loads.force.add(i, f);
            loads.force.add(j, -f);
        }
    }
    fn elements(&self) -> usize {
        self.0.len()
    }
    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        for (e, &(i, j, k, rest)) in energies.iter_mut().zip(&self.0) {
            let d = state.points.position.get(j) - state.points.position.get(i);
            *e = 0.5 * k * (d.norm() - rest).powi(2);
        }
    }
    fn second_order(&self) -> Option<&dyn SecondOrder> {
        Some(self)
    }
}

impl SecondOrder for Springs {
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        for &(i, j, k, rest) in &self.0 {
            let d = state.points.position.get(j) - state.points.position.get(i);
            let block = bar(d, k, rest);
            stiffness.push(P(i), P(i), block);
            stiffness.push(P(j), P(j), block);
            stiffness.push(P(i), P(j), -block);
        }
    }
}

/// Second derivative of `k (|d| - rest)^2 / 2` by `d`.
fn bar(d: Vector3, k: f64, rest: f64) -> Matrix3 {
    let l = d.norm();
    let n = d / l;
    let nn = n * n.transpose();
    nn * k + (Matrix3::identity() - nn) * (k * (1.0 - rest / l))
}

/// A bond between two bodies (point and frame of equal index), fixed off their centres.
#[derive(Clone, Debug)]
pub(crate) struct Bond {
    pub(crate) i: usize,
    pub(crate) j: usize,
    pub(crate) a: Vector3,
    pub(crate) b: Vector3,
    pub(crate) stiffness: f64,
    pub(crate) rest: f64,
}

#[derive(Debug)]
pub(crate) struct Bonds(pub(crate) Vec<Bond>);

impl Bond {
    /// Lab arms and the vector between the ends.
    fn geometry(&self, state: &State) -> (Vector3, Vector3, Vector3) {
        let arm = |i, r| state.frames.orientation.get(i) * r;
        let (a, b) = (arm(self.i, self.a), arm(self.j, self.b));
        let d = state.points.position.get(self.j) + b - state.points.position.get(self.i) - a;
        (a, b, d)
    }
    fn matrix(state: &State, i: usize) -> Matrix3 {
        state
            .frames
            .orientation
            .get(i)
            .to_rotation_matrix()
            .into_inner()
    }
}

impl Interaction for Bonds {
    fn term(&self) -> &'static str {
        "bonds"
    }
    fn add_loads(&self, state: &State, loads: &mut Loads) {
        for bond in &self.0 {
            let (a, b, d) = bond.geometry(state);
            let f = d * (bond.stiffness * (1.0 - bond.rest / d.norm()));
            let q = &state.frames.orientation;
            loads.force.add(bond.i, f);
            loads.force.add(bond.j, -f);
            loads
                .torque
                .add(bond.i, q.get(bond.i).inverse() * a.cross(&f));
            loads
                .torque
                .add(bond.j, q.get(bond.j).inverse() * -b.cross(&f));
        }
    }
    fn elements(&self) -> usize {
        self.0.len()
    }
    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        for (e, bond) in energies.iter_mut().zip(&self.0) {
            let d = bond.geometry(state).2;
            *e = 0.5 * bond.stiffness * (d.norm() - bond.rest).powi(2);
        }
    }
    fn second_order(&self) -> Option<&dyn SecondOrder> {
        Some(self)
    }
}

impl SecondOrder for Bonds {
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        for bond in &self.0 {
            let d = bond.geometry(state).2;
            let k = bar(d, bond.stiffness, bond.rest);
            let f = d * (bond.stiffness * (1.0 - bond.rest / d.norm()));
            let (qi, qj) = (Bond::matrix(state, bond.i), Bond::matrix(state, bond.j));
            // d(Q r)/d phi = -Q [r]x; the second order is phi x (phi x r) / 2.
            let (ji, jj) = (qi * cross(bond.a), -qj * cross(bond.b));
            let turn = |g: Vector3, r: Vector3| {
                0.5 * (g * r.transpose() + r * g.transpose()) - Matrix3::identity() * g.dot(&r)
            };
            let (i, j) = (bond.i, bond.j);
            stiffness.push(P(i), P(i), k);
            stiffness.push(P(j), P(j), k);
            stiffness.push(P(i), P(j), -k);
            stiffness.push(P(j), F(i), k * ji);
            stiffness.push(P(i), F(i), -k * ji);
            stiffness.push(P(j), F(j), k * jj);
            stiffness.push(P(i), F(j), -k * jj);
            stiffness.push(F(i), F(j), ji.transpose() * k * jj);
            let own = |jacobian: Matrix3, q: Matrix3, r: Vector3, sign: f64| {
                jacobian.transpose() * k * jacobian + turn(q.transpose() * f * sign, r)
            };
            stiffness.push(F(i), F(i), own(ji, qi, bond.a, -1.0));
            stiffness.push(F(j), F(j), own(jj, qj, bond.b, 1.0));
        }
    }
}

/// A single-stranded filament of `n` bodies along z, `bonds` parallel bonds per interface: at
/// rest each interface resists stretch and two bends but neither shear nor twist.
pub(crate) fn bonded_filament(n: usize, bonds: usize) -> (State, Bonds) {
    use actin_mechanics::Xorshift;
    let mut noise = Xorshift::new(7);
    let (rise, gap, stiffness) = (5.0, 1.6, 5000.0);
    let mut state = State::default();
    let mut all = Vec::new();
    for i in 0..n {
        point(&mut state, Vector3::z() * (rise * i as f64));
        frame(&mut state, UnitQuaternion::identity());
    }
    for i in 0..n - 1 {
        for _ in 0..bonds {
            let (x, y) = (1.8 * noise.sample(), 1.8 * noise.sample());
            all.push(Bond {
                i,
                j: i + 1,
                a: Vector3::new(x, y, 0.5 * (rise - gap)),
                b: Vector3::new(x, y, -0.5 * (rise - gap)),
                stiffness: stiffness / bonds as f64,
                rest: gap,
            });
        }
    }
    for i in 0..2.min(n) {
        state.points.hold(i);
        state.frames.hold(i);
    }
    (state, Bonds(all))
}

//! Vibration modes of a filament at rest.

use super::filaments::{KBT, degrees_of_freedom, normal};
use actin_mechanics::Xorshift;
use actin_mechanics::{Loads, State, System, Vector3, rotation};
use nalgebra::{DMatrix, DVector};

/// Frequencies (rad/ns) and mass-weighted shapes of vibrations about a state at rest.
pub(crate) struct Modes {
    pub(crate) frequencies: Vec<f64>,
    shapes: DMatrix<f64>,
    /// Inverse square roots of masses and moments, three per body, points first.
    weights: DVector<f64>,
    /// The six rigid motions, mass-weighted and orthonormal.
    rigid: Vec<DVector<f64>>,
}

impl Modes {
    pub(crate) fn new(system: &System) -> Self {
        let weights = weights(system.state());
        let n = weights.len();
        let mut dynamical = DMatrix::zeros(n, n);
        for c in 0..n {
            let column = -slope(system, c).component_mul(&weights) * weights[c];
            dynamical.set_column(c, &column);
        }
        let eigen = (0.5 * (&dynamical + dynamical.transpose())).symmetric_eigen();
        let squares = eigen.eigenvalues.map(f64::abs);
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|a, b| squares[*a].total_cmp(&squares[*b]));
        Self {
            frequencies: order.iter().map(|i| squares[*i].sqrt()).collect(),
            shapes: eigen.eigenvectors.select_columns(&order),
            rigid: rigid_motions(system.state(), &weights),
            weights,
        }
    }

    /// Twice the potential energy of each nonrigid mode in a state near `rest`: squared frequency
    /// times squared amplitude.
    pub(crate) fn energies(&self, rest: &State, state: &State) -> Vec<f64> {
        let (x, q) = (&state.points.position, &state.frames.orientation);
        let moved = (0..x.len()).map(|i| x.get(i) - rest.points.position.get(i));
        let turn = |i| rest.frames.orientation.get(i).inverse() * q.get(i);
        let turned = (0..state.frames.len()).map(|i| rotation::log(turn(i)));
        let flat: Vec<f64> = moved
            .chain(turned)
            .flat_map(|v| [v.x, v.y, v.z])
            .zip(self.weights.iter())
            .map(|(c, weight)| if *weight > 0.0 { c / weight } else { 0.0 })
            .collect();
        let amplitudes = self.shapes.tr_mul(&DVector::from_vec(flat));
        let all = self.frequencies.iter().zip(amplitudes.iter());
        all.filter(|(frequency, _)| **frequency > 1e-3)
            .map(|(frequency, amplitude)| (frequency * amplitude).powi(2))
            .collect()
    }

    pub(crate) fn largest(&self) -> f64 {
        self.frequencies[self.frequencies.len() - 1]
    }

    pub(crate) fn slow(&self) -> usize {
        self.below(0.01 * self.largest()) - 6
    }

    pub(crate) fn below(&self, frequency: f64) -> usize {
        self.frequencies.partition_point(|f| *f < frequency)
    }

    /// Displacement of coordinate `c` under a small constant load on coordinate `by`, where
    /// `answer(omega)` is the response of a mode to a unit load. Coordinates are three per body,
    /// points first. Held bodies do not move.
    pub(crate) fn response(&self, c: usize, by: (usize, f64), answer: impl Fn(f64) -> f64) -> f64 {
        let (place, load) = by;
        let load = self.weights[place] * load;
        let moves = |k: &usize| self.frequencies[*k] > 1e-6 * self.largest();
        let each = (0..self.frequencies.len()).filter(moves).map(|k| {
            let shape = self.shapes.column(k);
            shape[c] * shape[place] * answer(self.frequencies[k])
        });
        self.weights[c] * load * each.sum::<f64>()
    }

    /// Excites a random combination of slow modes with a mean of `level` kBT each, without rigid
    /// motion.
    pub(crate) fn set_slow_motion(&self, state: &mut State, level: f64, seed: u64) {
        let mut noise = Xorshift::new(seed);
        let mut motion = DVector::zeros(self.weights.len());
        for c in 0..self.slow() + 6 {
            motion += self.shapes.column(c) * normal(&mut noise);
        }
        for rigid in &self.rigid {
            motion -= rigid * rigid.dot(&motion);
        }
        motion *= (2.0 * KBT * level * self.slow() as f64).sqrt() / motion.norm();
        let vector =
            |v: &DVector<f64>, b: usize| Vector3::new(v[3 * b], v[3 * b + 1], v[3 * b + 2]);
        let velocities = motion.component_mul(&self.weights);
        let momenta = motion.component_div(&self.weights);
        let points = state.points.len();
        for i in 0..points {
            state.points.velocity.set(i, vector(&velocities, i));
        }
        for i in 0..state.frames.len() {
            let l = vector(&momenta, points + i);
            state.frames.angular_momentum.set(i, l);
        }
    }
}

fn weights(state: &State) -> DVector<f64> {
    let points = state.points.inverse_mass().iter().flat_map(|m| [*m; 3]);
    let frames = (0..state.frames.len()).flat_map(|i| {
        let mobility = f64::from(u8::from(state.frames.is_free(i)));
        let inverse: [f64; 3] = (mobility * state.frames.inverse_moments(i)).into();
        inverse
    });
    DVector::from_vec(points.chain(frames).map(f64::sqrt).collect())
}

/// Derivative of all loads by coordinate `c`: eight-point differences of 1e-3 nm or rad, with a
/// relative error of 1e-12.
fn slope(system: &System, c: usize) -> DVector<f64> {
    const STEP: f64 = 1e-3;
    let weights = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
    let mut slope = DVector::zeros(degrees_of_freedom(system.state()));
    for (weight, k) in weights.into_iter().zip(1..) {
        let step = f64::from(k) * STEP;
        slope += (loads_at(system, c, step) - loads_at(system, c, -step)) * (weight / STEP);
    }
    slope
}

fn loads_at(system: &System, c: usize, step: f64) -> DVector<f64> {
    let mut state = system.state().clone();
    let mut vector = Vector3::zeros();
    vector[c % 3] = step;
    let (body, points) = (c / 3, state.points.len());
    if body < points {
        state.points.position.add(body, vector);
    } else {
        let q = state.frames.orientation.get(body - points) * rotation::exp(vector);
        state.frames.orientation.set(body - points, q);
    }
    let mut loads = Loads::zeros(&state);
    for interaction in system.interactions() {
        interaction.add_loads(&state, &mut loads);
    }
    let both = loads.force.iter().chain(loads.torque.iter());
    DVector::from_vec(both.flat_map(|v| [v.x, v.y, v.z]).collect())
}

fn rigid_motions(state: &State, weights: &DVector<f64>) -> Vec<DVector<f64>> {
    let mut all: Vec<DVector<f64>> = Vec::new();
    for k in 0..6 {
        let mut e = Vector3::zeros();
        e[k % 3] = 1.0;
        let of_point = |x: Vector3| if k < 3 { e } else { e.cross(&x) };
        let turn = if k < 3 { Vector3::zeros() } else { e };
        let points = state.points.position.iter().map(of_point);
        let frames =
            (0..state.frames.len()).map(|i| state.frames.orientation.get(i).inverse() * turn);
        let flat = points.chain(frames).flat_map(|v| [v.x, v.y, v.z]).collect();
        let mut motion = DVector::from_vec(flat).component_div(weights);
        for earlier in &all {
            motion -= earlier * earlier.dot(&motion);
        }
        all.push(motion.normalize());
    }
    all
}

//! Assertions for tests of interactions: gradient, stiffness, balance, invariance (feature
//! `testing`).

mod random_stress;
mod second_order;

pub use random_stress::assert_fluctuates;
pub use second_order::{assert_are_second_derivatives, assert_is_stiffness, stiffness_matrix};

use crate::wide::Arch;
use crate::{Frame, Inertia, Interaction, Loads, Point, State, UnitQuaternion, Vector3, rotation};
use std::fmt::{self, Debug, Formatter};
use std::ops::{Add, Mul, Sub};

/// Processor architectures supported by this machine, starting with the scalar one, for tests of
/// vector code.
pub fn architectures() -> Vec<Arch> {
    let mut all = vec![Arch::Scalar];
    #[cfg(target_arch = "x86_64")]
    all.extend(pulp::x86::V3::try_new().map(Arch::V3));
    all.push(Arch::new());
    all
}

/// Asserts that `run` returns identical bits on each supported architecture with more than one
/// lane.
///
/// # Panics
/// If the results differ.
pub fn assert_same_with_any_lanes(run: impl Fn(Arch) -> Vec<f64>) {
    let bits = |arch| run(arch).into_iter().map(f64::to_bits).collect::<Vec<_>>();
    let all = architectures();
    for pair in all[1..].windows(2) {
        assert!(
            bits(pair[0]) == bits(pair[1]),
            "{:?} and {:?}",
            pair[0],
            pair[1]
        );
    }
}

/// Adds a point to a state and returns its index.
pub fn push_point(state: &mut State, position: Vector3, mass: f64) -> usize {
    state.points.push(Point { position, mass })
}

/// Adds a frame with the given moments of inertia to a state and returns its index.
///
/// # Panics
/// If the moments do not belong to a symmetric top.
pub fn push_frame(state: &mut State, orientation: UnitQuaternion, moments: [f64; 3]) -> usize {
    let inertia = Inertia::from_moments(moments).expect("use the moments of a symmetric top");
    state.frames.push(Frame {
        orientation,
        inertia,
    })
}

/// Moves the whole state rigidly: rotation about the origin by `turn` (rad), then translation by
/// `shift`.
pub fn move_rigidly(state: &mut State, turn: Vector3, shift: Vector3) {
    let turn = rotation::exp(turn);
    for i in 0..state.points.len() {
        let x = turn * state.points.position.get(i) + shift;
        state.points.position.set(i, x);
        let v = turn * state.points.velocity.get(i);
        state.points.velocity.set(i, v);
    }
    for i in 0..state.frames.len() {
        let q = turn * state.frames.orientation.get(i);
        state.frames.orientation.set(i, q);
    }
}

/// Total force and total torque about the origin (lab frame).
pub fn resultant(state: &State, loads: &Loads) -> (Vector3, Vector3) {
    let force: Vector3 = loads.force.iter().sum();
    let moments: Vector3 = (0..state.points.len())
        .map(|i| state.points.position.get(i).cross(&loads.force.get(i)))
        .sum();
    let couples: Vector3 = (0..state.frames.len())
        .map(|i| state.frames.orientation.get(i) * loads.torque.get(i))
        .sum();
    (force, moments + couples)
}

/// Loads of one interaction.
pub fn loads_of(interaction: &dyn Interaction, state: &State) -> Loads {
    let mut loads = Loads::zeros(state);
    interaction.add_loads(state, &mut loads);
    loads
}

/// Interaction without energy and elements, whose loads are added by a closure.
pub struct Loading<F> {
    /// Name of the term.
    pub term: &'static str,
    /// Function that adds the loads.
    pub add: F,
}

impl<F> Debug for Loading<F> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Loading").field(&self.term).finish()
    }
}

impl<F: Fn(&State, &mut Loads) + Send + Sync> Interaction for Loading<F> {
    fn term(&self) -> &'static str {
        self.term
    }

    fn add_loads(&self, state: &State, loads: &mut Loads) {
        (self.add)(state, loads);
    }

    fn elements(&self) -> usize {
        0
    }

    fn write_energies(&self, _: &State, _: &mut [f64]) {}
}

/// Asserts that the loads are minus the gradient of the energy.
///
/// Derivatives are eight-point central differences with a truncation error of order `h^8` and a
/// round-off error of about `1e-16 E / h`.
///
/// # Panics
/// If a load differs by more than `relative` times the largest load of its kind.
pub fn assert_is_gradient(interaction: &dyn Interaction, state: &State, h: f64, relative: f64) {
    let loads = loads_of(interaction, state);
    let unit = |k: usize| Vector3::from_fn(|i, _| f64::from(u8::from(i == k)));
    let slope = |displace: &dyn Fn(&mut State, f64)| {
        derivative(h, |step| {
            let mut moved = state.clone();
            displace(&mut moved, step);
            interaction.energy(&moved)
        })
    };
    for i in 0..state.points.len() {
        let gradient = Vector3::from_fn(|k, _| {
            slope(&|state, step| state.points.position.add(i, unit(k) * step))
        });
        assert_close("force on point", i, loads.force.get(i), -gradient, {
            relative * largest(&loads.force)
        });
    }
    for i in 0..state.frames.len() {
        let gradient = Vector3::from_fn(|k, _| {
            slope(&|state, step| {
                let q = state.frames.orientation.get(i) * rotation::exp(unit(k) * step);
                state.frames.orientation.set(i, q);
            })
        });
        assert_close("torque on frame", i, loads.torque.get(i), -gradient, {
            relative * largest(&loads.torque)
        });
    }
}

fn largest(vectors: &crate::Vectors) -> f64 {
    vectors.iter().map(|v| v.norm()).fold(0.0, f64::max)
}

fn assert_close(what: &str, i: usize, load: Vector3, from_energy: Vector3, tolerance: f64) {
    let error = (load - from_energy).amax();
    assert!(
        error <= tolerance,
        "{what} {i}: load {load} differs from {from_energy}, the gradient of the energy"
    );
}

/// Eight-point central difference of `f` at zero (Fornberg 1988, table 1), with an error of order
/// `h^8`.
///
/// `f` may return a number, a vector or a matrix.
pub fn derivative<T>(h: f64, f: impl Fn(f64) -> T) -> T
where
    T: Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T>,
{
    let term = |k: f64, weight: f64| (f(k * h) - f(-k * h)) * (weight / h);
    term(1.0, 4.0 / 5.0) + term(2.0, -1.0 / 5.0) + term(3.0, 4.0 / 105.0) + term(4.0, -1.0 / 280.0)
}

/// Asserts that internal loads have no resultant force or torque.
///
/// # Panics
/// If a resultant exceeds `relative` times the sum of the norms of its terms.
pub fn assert_is_balanced(interaction: &dyn Interaction, state: &State, relative: f64) {
    let loads = loads_of(interaction, state);
    let (force, torque) = resultant(state, &loads);
    let forces: f64 = loads.force.iter().map(|f| f.norm()).sum();
    let torques: f64 = loads.torque.iter().map(|t| t.norm()).sum();
    let moments: f64 = (0..state.points.len())
        .map(|i| state.points.position.get(i).norm() * loads.force.get(i).norm())
        .sum();
    assert!(force.norm() <= relative * forces, "resultant force {force}");
    assert!(
        torque.norm() <= relative * (torques + moments),
        "resultant torque {torque}"
    );
}

/// Asserts that the energy is invariant under a rigid motion of the state.
///
/// # Panics
/// If it changes by more than `relative`.
pub fn assert_is_invariant(interaction: &dyn Interaction, state: &State, relative: f64) {
    let mut moved = state.clone();
    move_rigidly(
        &mut moved,
        Vector3::new(0.7, -1.9, 0.4),
        Vector3::new(3.0, -5.0, 2.0),
    );
    let (before, after) = (interaction.energy(state), interaction.energy(&moved));
    assert!(
        (after - before).abs() <= relative * before.abs(),
        "energy {before} changed to {after} in a rigid motion"
    );
}

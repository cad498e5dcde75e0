//! Points: positions with a mass.

use crate::inertia::is_inertia;
use crate::vectors::{self, damp_where, sum_in_lanes};
use crate::{Shared, Vector3, Vectors};
use std::collections::BTreeMap;

/// One point, as it enters a [`Points`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Position in the lab frame.
    pub position: Vector3,
    /// Mass.
    pub mass: f64,
}

impl Point {
    /// Whether the position is finite, and the mass and its inverse are positive and finite.
    pub fn is_valid(&self) -> bool {
        let is_placed = self.position.iter().all(|x| x.is_finite());
        is_placed && is_inertia(self.mass) && is_inertia(1.0 / self.mass)
    }
}

/// All points of a state.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Points {
    /// Positions in the lab frame.
    pub position: Vectors,
    /// Velocities in the lab frame.
    pub velocity: Vectors,
    masses: Shared<Masses>,
}

/// What does not move.
#[derive(Clone, Debug, Default, PartialEq)]
struct Masses {
    /// Inverse masses; zero for held points.
    inverse: Vec<f64>,
    /// What the inverse mass of each held point is when it is free.
    held: BTreeMap<usize, f64>,
}

impl Points {
    /// Number of points.
    pub fn len(&self) -> usize {
        self.masses.inverse.len()
    }

    /// Whether there is no point at all.
    pub fn is_empty(&self) -> bool {
        self.masses.inverse.is_empty()
    }

    /// The same bodies without places and motion.
    pub(crate) fn bodies(&self) -> Self {
        Self {
            masses: self.masses.clone(),
            ..Self::default()
        }
    }

    /// Whether `other` shares the masses and what is held.
    pub(crate) fn shares_bodies_with(&self, other: &Self) -> bool {
        self.masses.is_same(&other.masses)
    }

    /// Appends a point at rest and returns its index.
    ///
    /// # Panics
    /// If the point is not [valid](Point::is_valid).
    pub fn push(&mut self, point: Point) -> usize {
        assert!(
            point.is_valid(),
            "a position must be finite, a mass and its inverse positive and finite, got {point:?}"
        );
        self.position.push(point.position);
        self.velocity.push(Vector3::zeros());
        self.masses.inverse.push(1.0 / point.mass);
        self.len() - 1
    }

    /// Takes point `i` out of the reach of forces: its inverse mass becomes zero, and it keeps
    /// whatever velocity it is given from outside (zero unless driven). Its mass is remembered.
    ///
    /// # Panics
    /// If there is no point `i`.
    pub fn hold(&mut self, i: usize) {
        let Masses { inverse, held } = &mut *self.masses;
        if inverse[i] > 0.0 {
            held.insert(i, inverse[i]);
        }
        inverse[i] = 0.0;
        self.velocity.set(i, Vector3::zeros());
    }

    /// Undoes [`hold`](Self::hold): forces move point `i` again, from rest. One that is free stays
    /// as it is.
    ///
    /// ```
    /// use actin_mechanics::{Point, State, Vector3};
    /// let mut state = State::default();
    /// let i = state.points.push(Point { position: Vector3::zeros(), mass: 4.0 });
    /// state.points.hold(i);
    /// assert_eq!((state.points.is_free(i), state.points.mass(i)), (false, 4.0));
    /// state.points.release(i);
    /// assert_eq!((state.points.is_free(i), state.points.mass(i)), (true, 4.0));
    /// ```
    pub fn release(&mut self, i: usize) {
        let Masses { inverse, held } = &mut *self.masses;
        if let Some(free) = held.remove(&i) {
            inverse[i] = free;
            self.velocity.set(i, Vector3::zeros());
        }
    }

    /// Mass of point `i`, to rounding; that of a held point is what it has when it is free.
    ///
    /// # Panics
    /// If there is no point `i`.
    pub fn mass(&self, i: usize) -> f64 {
        let free = self.masses.inverse[i];
        let inverse = if free > 0.0 {
            free
        } else {
            self.masses.held[&i]
        };
        1.0 / inverse
    }

    /// Whether forces move point `i`.
    pub fn is_free(&self, i: usize) -> bool {
        self.masses.inverse[i] > 0.0
    }

    /// Momentum of free point `i`.
    pub fn momentum(&self, i: usize) -> Vector3 {
        self.velocity.get(i) / self.masses.inverse[i]
    }

    /// Inverse masses; zero for held points.
    pub fn inverse_mass(&self) -> &[f64] {
        &self.masses.inverse
    }

    /// Asserts that there are as many positions and velocities as points.
    pub(crate) fn assert_shape(&self) {
        let count = self.len();
        for (what, vectors) in [
            ("positions", &self.position),
            ("velocities", &self.velocity),
        ] {
            vectors.assert_len(what, count);
        }
    }

    /// Moves every point along its velocity for a time `h`.
    pub fn drift(&mut self, h: f64) {
        vectors::add_product(&mut self.position, &self.velocity, h);
    }

    /// Applies the forces `force` for a time `h`.
    pub fn kick(&mut self, force: &Vectors, h: f64) {
        vectors::add_scaled(&mut self.velocity, force, &self.masses.inverse, h);
    }

    /// Adds to each velocity `deviates / sqrt(mass)`; nothing to those of held points.
    pub(crate) fn add_thermal_impulses(&mut self, deviates: &Vectors) {
        let v = &mut self.velocity;
        for (v, d) in [
            (&mut v.x, &deviates.x),
            (&mut v.y, &deviates.y),
            (&mut v.z, &deviates.z),
        ] {
            for ((v, d), m) in v.iter_mut().zip(d).zip(&self.masses.inverse) {
                *v += m.sqrt() * d;
            }
        }
    }

    /// Multiplies the velocities of the free points.
    pub(crate) fn damp(&mut self, factor: f64) {
        damp_where(&mut self.velocity, &self.masses.inverse, factor);
    }

    /// Kinetic energy of the free points.
    pub fn kinetic_energy(&self) -> f64 {
        let (v, inverse) = (&self.velocity, &self.masses.inverse);
        0.5 * sum_in_lanes([inverse, &v.x, &v.y, &v.z], |[inverse, x, y, z]| {
            let squared = x * x + y * y + z * z;
            if inverse > 0.0 {
                squared / inverse
            } else {
                0.0
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A negative mass would count as held, and one that is no number as anything.
    #[test]
    fn masses_without_a_meaning_are_refused() {
        for mass in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-310] {
            let position = Vector3::zeros();
            let push = || Points::default().push(Point { position, mass });
            assert!(std::panic::catch_unwind(push).is_err(), "{mass}");
        }
    }
}

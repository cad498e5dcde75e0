//! Points: positions with a mass.

use crate::inertia::is_inertia;
use crate::sums::{add_product, add_scaled};
use crate::vectors::{damp_where, sum_in_lanes};
use crate::{Shared, Vector3, Vectors};
use std::collections::BTreeMap;

/// Input of [`Points::push`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Position in the lab frame.
    pub position: Vector3,
    /// Mass.
    pub mass: f64,
}

impl Point {
    /// Returns `true` if the position is finite, and the mass and its inverse are positive and
    /// finite.
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

#[derive(Clone, Debug, Default, PartialEq)]
struct Masses {
    /// Inverse masses, zero for held points.
    inverse: Vec<f64>,
    /// Inverse masses of held points for their release.
    held: BTreeMap<usize, f64>,
}

impl Points {
    /// Number of points.
    pub fn len(&self) -> usize {
        self.masses.inverse.len()
    }

    /// Returns `true` if there are no points.
    pub fn is_empty(&self) -> bool {
        self.masses.inverse.is_empty()
    }

    pub(crate) fn bodies(&self) -> Self {
        Self {
            masses: self.masses.clone(),
            ..Self::default()
        }
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

    /// Holds point `i`: its inverse mass becomes zero, and forces do not change its velocity, which
    /// is set to zero. The mass is stored for [`release`](Self::release).
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

    /// Frees point `i` again, at rest. Does nothing if it is already free.
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

    /// Mass of point `i`, also if it is held (exact to rounding).
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

    /// Returns `true` if point `i` is free.
    pub fn is_free(&self, i: usize) -> bool {
        self.masses.inverse[i] > 0.0
    }

    /// Momentum of the free point `i`.
    pub(crate) fn momentum(&self, i: usize) -> Vector3 {
        self.velocity.get(i) / self.masses.inverse[i]
    }

    /// Inverse masses, zero for held points.
    pub fn inverse_mass(&self) -> &[f64] {
        &self.masses.inverse
    }

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
        add_product(&mut self.position, &self.velocity, h);
    }

    /// Applies the forces `force` for a time `h`.
    pub fn kick(&mut self, force: &Vectors, h: f64) {
        add_scaled(&mut self.velocity, force, &self.masses.inverse, h);
    }

    /// Adds `deviates / sqrt(mass)` to the velocity of each free point.
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

    pub(crate) fn damp(&mut self, factor: f64) {
        damp_where(&mut self.velocity, &self.masses.inverse, factor);
    }

    /// Kinetic energy of free points.
    pub(crate) fn kinetic_energy(&self) -> f64 {
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

    #[test]
    fn invalid_masses_are_refused() {
        for mass in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-310] {
            let position = Vector3::zeros();
            let push = || Points::default().push(Point { position, mass });
            assert!(std::panic::catch_unwind(push).is_err(), "{mass}");
        }
    }
}

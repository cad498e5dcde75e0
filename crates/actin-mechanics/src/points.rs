//! Points: positions with a mass.

use crate::{Vector3, Vectors, vectors};

/// One point, as it enters a [`Points`].
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// Position in the lab frame.
    pub position: Vector3,
    /// Mass.
    pub mass: f64,
}

/// All points of a state.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Points {
    /// Positions in the lab frame.
    pub position: Vectors,
    /// Velocities in the lab frame.
    pub velocity: Vectors,
    inverse_mass: Vec<f64>,
}

impl Points {
    /// Number of points.
    pub fn len(&self) -> usize {
        self.inverse_mass.len()
    }

    /// Whether there is no point at all.
    pub fn is_empty(&self) -> bool {
        self.inverse_mass.is_empty()
    }

    /// Appends a point at rest and returns its index.
    pub fn push(&mut self, point: Point) -> usize {
        self.position.push(point.position);
        self.velocity.push(Vector3::zeros());
        self.inverse_mass.push(1.0 / point.mass);
        self.len() - 1
    }

    /// Takes point `i` out of the reach of forces: its inverse mass becomes zero, and it keeps
    /// whatever velocity it is given from outside (zero unless driven).
    pub fn hold(&mut self, i: usize) {
        self.inverse_mass[i] = 0.0;
        self.velocity.set(i, Vector3::zeros());
    }

    /// Whether forces move point `i`.
    pub fn is_free(&self, i: usize) -> bool {
        self.inverse_mass[i] > 0.0
    }

    /// Inverse masses; zero for held points.
    pub fn inverse_mass(&self) -> &[f64] {
        &self.inverse_mass
    }

    /// Moves every point along its velocity for a time `h`.
    pub fn drift(&mut self, h: f64) {
        vectors::add_product(&mut self.position, &self.velocity, h);
    }

    /// Applies the forces `force` for a time `h`.
    pub fn kick(&mut self, force: &Vectors, h: f64) {
        vectors::add_scaled(&mut self.velocity, force, &self.inverse_mass, h);
    }

    /// Adds to each velocity `deviates / sqrt(mass)`; nothing to those of held points.
    pub(crate) fn agitate(&mut self, deviates: &Vectors) {
        let v = &mut self.velocity;
        for (v, d) in [
            (&mut v.x, &deviates.x),
            (&mut v.y, &deviates.y),
            (&mut v.z, &deviates.z),
        ] {
            for ((v, d), m) in v.iter_mut().zip(d).zip(&self.inverse_mass) {
                *v += m.sqrt() * d;
            }
        }
    }

    /// Kinetic energy of the free points.
    pub fn kinetic_energy(&self) -> f64 {
        let moving = |i: &usize| self.is_free(*i);
        (0..self.len())
            .filter(moving)
            .map(|i| 0.5 * self.velocity.get(i).norm_squared() / self.inverse_mass[i])
            .sum()
    }
}

//! Held points that slide together as one rigid body.

use crate::inertia::is_inertia;
use crate::{Points, Vector3, Vectors};

/// Points with constant relative positions that move together along `directions`.
///
/// The points are held; the common displacement along each direction is a degree of freedom. Frames
/// of the body do not rotate and are not listed. [`System`](crate::System) panics if a slider is
/// invalid.
#[derive(Clone, Debug, PartialEq)]
pub struct Slider {
    /// Indices of the points.
    pub points: Vec<usize>,
    /// Orthonormal directions (lab frame), at most three.
    pub directions: Vec<Vector3>,
    /// Mass of the whole body.
    pub mass: f64,
}

impl Slider {
    pub(crate) fn assert_sound(&self, count: usize) {
        let Self {
            points,
            directions,
            mass,
        } = self;
        assert!(!points.is_empty(), "a slider must have at least one point");
        for &i in points {
            assert!(
                i < count,
                "a slider contains point {i}, but there are only {count} points"
            );
        }
        assert!(
            is_inertia(*mass) && is_inertia(1.0 / mass),
            "the mass of a slider must be positive and finite, got {mass}"
        );
        for (k, d) in directions.iter().enumerate() {
            for (l, other) in directions[..=k].iter().enumerate() {
                let expected = if k == l { 1.0 } else { 0.0 };
                assert!(
                    (d.dot(other) - expected).abs() < 1e-9,
                    "directions of a slider must be orthonormal, got {directions:?}"
                );
            }
        }
    }

    /// Total force along each direction.
    pub(crate) fn forces<'a>(&'a self, force: &'a Vectors) -> impl Iterator<Item = f64> + 'a {
        self.directions
            .iter()
            .map(|d| self.points.iter().map(|&i| force.get(i).dot(d)).sum())
    }

    pub(crate) fn kick(&self, velocity: &mut Vectors, force: &Vectors, h: f64) {
        let gain: Vector3 = self
            .directions
            .iter()
            .zip(self.forces(force))
            .map(|(d, f)| d * (h * f / self.mass))
            .sum();
        for &i in &self.points {
            velocity.add(i, gain);
        }
    }

    /// Velocity along the free directions, lab frame.
    pub fn sliding_velocity(&self, velocity: &Vectors) -> Vector3 {
        let v = velocity.get(self.points[0]);
        self.directions.iter().map(|d| d * d.dot(&v)).sum()
    }

    pub(crate) fn damp(&self, velocity: &mut Vectors, factor: f64) {
        let loss = self.sliding_velocity(velocity) * (factor - 1.0);
        for &i in &self.points {
            velocity.add(i, loss);
        }
    }

    /// Adds `deviates / sqrt(mass)` to the velocity along each direction.
    ///
    /// Component `k` of the deviates of the first point is used for the `k`-th direction.
    pub(crate) fn add_thermal_impulses(&self, velocity: &mut Vectors, deviates: &Vectors) {
        let deviate = deviates.get(self.points[0]);
        let along = self.directions.iter().zip(deviate.iter());
        let gain: Vector3 = along.map(|(d, xi)| d * (xi / self.mass.sqrt())).sum();
        for &i in &self.points {
            velocity.add(i, gain);
        }
    }

    pub(crate) fn kinetic_energy(&self, points: &Points) -> f64 {
        let v = self.sliding_velocity(&points.velocity);
        0.5 * self.mass * v.norm_squared()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::State;
    use crate::testing::push_point;
    use crate::{PointLoad, Split, System};

    #[test]
    fn a_pair_slides_as_one_body() {
        let mut state = State::default();
        for x in [0.0, 1.0] {
            push_point(&mut state, Vector3::new(x, 0.0, 0.0), 0.5);
        }
        (0..2).for_each(|i| state.points.hold(i));
        state.sliders.push(Slider {
            points: vec![0, 1],
            directions: vec![Vector3::z()],
            mass: 1.0,
        });
        let control = state.add_control(1.0);
        let force = Vector3::new(3.0, 4.0, 2.0);
        let load = PointLoad::new(&state, vec![(1, 1.0)], force, control).unwrap();
        let mut system = System::new(state, vec![Box::new(load)]);
        assert!((system.residual().force - 2.0).abs() < 1e-15);
        system.kick(0.5, 0.5);
        system.drift(2.0);
        for i in 0..2 {
            let x = system.state().points.position.get(i);
            assert_eq!((x.y, x.z), (0.0, 2.0));
        }
        assert!((system.state().kinetic_energy() - 0.5).abs() < 1e-15);
        system.damp(0.5, 1.0);
        assert!((system.state().points.velocity.get(0).z - 0.5).abs() < 1e-15);
    }
}

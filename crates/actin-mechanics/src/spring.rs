//! Hooke's law, and springs between points.

use crate::{Coordinates, Interaction, Loads, Matrix3, SecondOrder, State, Stiffness, Vector3};
use thiserror::Error;

/// Length below which a spring has no direction, because the squares of the components underflow.
const SHUT: f64 = 1e-150;

/// Hooke's law for a vector `d`: `E = k (|d| - L)^2 / 2`.
///
/// For `L > 0` the energy has a conical maximum at `d = 0`. The force there is zero, the mean over
/// all directions, and the second derivative is `-k` in every direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hooke {
    /// Stiffness `k` (force per length).
    pub stiffness: f64,
    /// Rest length `L`.
    pub rest_length: f64,
}

impl Hooke {
    /// Energy for the vector `d`.
    #[inline]
    pub fn energy(&self, d: Vector3) -> f64 {
        0.5 * self.stiffness * (d.norm() - self.rest_length).powi(2)
    }

    /// Force `dE/dd = k (|d| - L) d / |d|` on the end at the origin of `d`.
    ///
    /// ```
    /// use actin_mechanics::{Hooke, Vector3};
    /// let spring = Hooke { stiffness: 2.0, rest_length: 1.0 };
    /// assert_eq!(spring.force(Vector3::x() * 3.0), Vector3::x() * 4.0);
    /// ```
    #[inline]
    pub fn force(&self, d: Vector3) -> Vector3 {
        if self.rest_length == 0.0 {
            return d * self.stiffness;
        }
        match d.try_normalize(SHUT) {
            Some(n) => (d - n * self.rest_length) * self.stiffness,
            None => Vector3::zeros(),
        }
    }

    /// Second derivative `d^2 E / dd^2 = k [ n n^T + (1 - L / |d|) (1 - n n^T) ]`, with `n = d /
    /// |d|`.
    pub fn tangent(&self, d: Vector3) -> Matrix3 {
        let whole = Matrix3::from_diagonal_element(self.stiffness);
        if self.rest_length == 0.0 {
            return whole;
        }
        match d.try_normalize(SHUT) {
            Some(n) => {
                let across = Matrix3::identity() - n * n.transpose();
                whole - across * (self.stiffness * self.rest_length / d.norm())
            }
            None => -whole,
        }
    }

    /// Eigenvalue `k (1 - L / |d|)` of the [`tangent`](Self::tangent) for directions across `d`;
    /// negative infinity at `d = 0` with a rest length.
    fn stiffness_across(&self, d: Vector3) -> f64 {
        if self.rest_length == 0.0 {
            self.stiffness
        } else {
            self.stiffness * (1.0 - self.rest_length / d.norm())
        }
    }

    /// Positive part of the [`tangent`](Self::tangent).
    ///
    /// ```
    /// use actin_mechanics::{Hooke, Vector3};
    /// let spring = Hooke { stiffness: 2.0, rest_length: 4.0 };
    /// let compressed = spring.convex_tangent(Vector3::x() * 3.0);
    /// assert_eq!(compressed.diagonal(), Vector3::new(2.0, 0.0, 0.0));
    /// ```
    pub fn convex_tangent(&self, d: Vector3) -> Matrix3 {
        if self.stiffness_across(d) >= 0.0 {
            return self.tangent(d);
        }
        match d.try_normalize(SHUT) {
            Some(n) => n * n.transpose() * self.stiffness,
            None => Matrix3::zeros(),
        }
    }
}

/// A spring between two points. For a fixed anchor, use a [held](crate::Points::hold) point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spring {
    /// Indices of the two points.
    pub points: [usize; 2],
    /// Stiffness (force per length).
    pub stiffness: f64,
    /// Rest length.
    pub rest_length: f64,
}

/// Invalid spring.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SpringError {
    /// A parameter is out of range.
    #[error("spring {spring}: {key} = {value}: must be {rule}")]
    Parameter {
        /// Index of the spring.
        spring: usize,
        /// `stiffness` or `rest_length`.
        key: &'static str,
        /// Rejected value.
        value: f64,
        /// Rule that the value violates.
        rule: &'static str,
    },
    /// A point does not exist, or both points are equal.
    #[error("spring {spring} joins points {points:?}: must be two different ones of {count}")]
    Points {
        /// Index of the spring.
        spring: usize,
        /// Indices of the points.
        points: [usize; 2],
        /// Number of points of the state.
        count: usize,
    },
}

/// Springs between points: term `springs`, one element per spring.
///
/// Forces follow [`Hooke`] along the line between the points.
#[derive(Clone, Debug, PartialEq)]
pub struct Springs(Vec<Spring>);

impl Springs {
    /// Creates springs between points of `state`.
    ///
    /// ```
    /// use actin_mechanics::{Interaction, Point, Spring, Springs, State, Vector3};
    /// let mut state = State::default();
    /// let points = [0.0, 3.0].map(|x| {
    ///     state.points.push(Point { position: Vector3::x() * x, mass: 1.0 })
    /// });
    /// let spring = Spring { points, stiffness: 2.0, rest_length: 1.0 };
    /// // k (3 - 1)^2 / 2
    /// assert_eq!(Springs::new(&state, vec![spring])?.energy(&state), 4.0);
    /// # Ok::<(), actin_mechanics::SpringError>(())
    /// ```
    ///
    /// # Errors
    /// If a stiffness is not positive and finite, if a rest length is negative or not finite, if a
    /// point does not exist, or if a spring joins a point to itself.
    pub fn new(state: &State, springs: Vec<Spring>) -> Result<Self, SpringError> {
        let count = state.points.len();
        for (spring, each) in springs.iter().enumerate() {
            let parameter = |key, value, rule| SpringError::Parameter {
                spring,
                key,
                value,
                rule,
            };
            let (k, rest) = (each.stiffness, each.rest_length);
            if !(k.is_finite() && k > 0.0) {
                return Err(parameter("stiffness", k, "positive and finite"));
            }
            if !(rest.is_finite() && rest >= 0.0) {
                return Err(parameter("rest_length", rest, "finite and not negative"));
            }
            let points = each.points;
            if points[0] == points[1] || points.iter().any(|i| *i >= count) {
                return Err(SpringError::Points {
                    spring,
                    points,
                    count,
                });
            }
        }
        Ok(Self(springs))
    }

    fn stretched<'a>(
        &'a self,
        state: &'a State,
    ) -> impl Iterator<Item = ([usize; 2], Hooke, Vector3)> + 'a {
        let x = &state.points.position;
        self.0.iter().map(|spring| {
            let [a, b] = spring.points;
            let (stiffness, rest_length) = (spring.stiffness, spring.rest_length);
            let law = Hooke {
                stiffness,
                rest_length,
            };
            (spring.points, law, x.get(b) - x.get(a))
        })
    }
}

impl Interaction for Springs {
    fn term(&self) -> &'static str {
        "springs"
    }

    fn add_loads(&self, state: &State, loads: &mut Loads) {
        for ([a, b], law, d) in self.stretched(state) {
            let force = law.force(d);
            loads.force.add(a, force);
            loads.force.add(b, -force);
        }
    }

    fn elements(&self) -> usize {
        self.0.len()
    }

    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        assert_eq!(energies.len(), self.elements(), "one energy per spring");
        for (energy, (_, law, d)) in energies.iter_mut().zip(self.stretched(state)) {
            *energy = law.energy(d);
        }
    }

    fn second_order(&self) -> Option<&dyn SecondOrder> {
        Some(self)
    }
}

impl SecondOrder for Springs {
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        for (points, law, d) in self.stretched(state) {
            let [a, b] = points.map(Coordinates::Point);
            let tangent = law.tangent(d);
            stiffness.push(a, a, tangent);
            stiffness.push(b, b, tangent);
            stiffness.push(a, b, -tangent);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::testing::push_point;
    use crate::testing::{assert_is_balanced, assert_is_gradient, assert_is_stiffness};
    use crate::{Xorshift, perturb};

    fn triangle() -> State {
        let mut state = State::default();
        for position in [Vector3::zeros(), Vector3::x(), Vector3::y() * 2.0] {
            push_point(&mut state, position, 1.0);
        }
        state
    }

    fn spring(points: [usize; 2], stiffness: f64, rest_length: f64) -> Spring {
        Spring {
            points,
            stiffness,
            rest_length,
        }
    }

    #[test]
    fn springs_are_the_gradient_of_their_energy() {
        let mut state = triangle();
        perturb(&mut state, &mut Xorshift::new(1), 0.1, 0.0);
        let all = vec![
            spring([0, 1], 3.0, 0.5),
            spring([1, 2], 5.0, 4.0),
            spring([2, 0], 7.0, 0.0),
        ];
        let springs = Springs::new(&state, all).unwrap();
        assert_is_gradient(&springs, &state, 1e-2, 1e-9);
        assert_is_stiffness(&springs, &state, 1e-2, 1e-8);
        assert_is_balanced(&springs, &state, 1e-14);
    }

    #[test]
    fn a_spring_of_zero_length_has_no_force() {
        let law = Hooke {
            stiffness: 2.0,
            rest_length: 1.0,
        };
        assert_eq!(law.force(Vector3::zeros()), Vector3::zeros());
        assert_eq!(law.tangent(Vector3::zeros()), Matrix3::identity() * -2.0);
        assert!((law.energy(Vector3::zeros()) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn invalid_springs_are_refused() {
        let state = triangle();
        let key = |spring| match Springs::new(&state, vec![spring]) {
            Err(SpringError::Parameter { key, .. }) => key,
            Err(SpringError::Points { .. }) => "points",
            Ok(_) => "none",
        };
        assert_eq!(key(spring([0, 1], 1.0, 0.0)), "none");
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(key(spring([0, 1], bad, 0.0)), "stiffness");
        }
        for bad in [-1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(key(spring([0, 1], 1.0, bad)), "rest_length");
        }
        assert_eq!(key(spring([0, 3], 1.0, 0.0)), "points");
        assert_eq!(key(spring([1, 1], 1.0, 0.0)), "points");
    }
}

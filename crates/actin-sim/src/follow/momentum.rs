//! Momentum of a motion, and rigid motions that restore it.

use actin_mechanics::{Matrix3, State, Vector3};

/// Momentum (ag nm/ns) and angular momentum about the origin (ag nm^2/ns) of all free bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Momentum {
    pub(super) linear: Vector3,
    pub(super) angular: Vector3,
}

impl Momentum {
    pub(super) fn new(state: &State) -> Self {
        Self {
            linear: state.momentum(),
            angular: state.angular_momentum(),
        }
    }
}

#[derive(Clone, Debug, Default)]
pub(super) struct Bodies {
    pub(super) points: Vec<usize>,
    pub(super) frames: Vec<usize>,
}

impl Bodies {
    /// Mass (ag) and centre of mass (nm).
    fn centre(&self, state: &State) -> (f64, Vector3) {
        let masses = self.points.iter().map(|&i| state.points.mass(i));
        let mass: f64 = masses.clone().sum();
        let places = self.points.iter().map(|&i| state.points.position.get(i));
        let sum: Vector3 = places.zip(masses).map(|(x, m)| x * m).sum();
        (mass, sum / mass)
    }

    /// Moment of inertia about a point (ag nm^2, lab frame).
    fn inertia(&self, state: &State, about: Vector3) -> Matrix3 {
        let orbital = self.points.iter().map(|&i| {
            let arm = state.points.position.get(i) - about;
            let square = Matrix3::identity() * arm.norm_squared() - arm * arm.transpose();
            square * state.points.mass(i)
        });
        let spin = self.frames.iter().map(|&i| {
            let axes = state.frames.orientation.get(i).to_rotation_matrix();
            let moments = state.frames.inverse_moments(i).map(|inverse| 1.0 / inverse);
            axes * Matrix3::from_diagonal(&moments) * axes.transpose()
        });
        orbital.chain(spin).sum()
    }

    /// Adds a rigid motion to these bodies, so that the whole state has the momentum `wanted`.
    ///
    /// # Panics
    /// If the moment of inertia is singular, for example without bodies.
    pub(super) fn give(&self, state: &mut State, wanted: Momentum) {
        // The second pass corrects the round-off of the first.
        for _ in 0..2 {
            let now = Momentum::new(state);
            let (mass, centre) = self.centre(state);
            let linear = wanted.linear - now.linear;
            let angular = wanted.angular - now.angular - centre.cross(&linear);
            let turn = self
                .inertia(state, centre)
                .cholesky()
                .expect("bodies have a moment of inertia")
                .solve(&angular);
            self.add(state, centre, linear / mass, turn);
        }
    }

    fn add(&self, state: &mut State, centre: Vector3, velocity: Vector3, turn: Vector3) {
        for &i in &self.points {
            let arm = state.points.position.get(i) - centre;
            state.points.velocity.add(i, velocity + turn.cross(&arm));
        }
        for &i in &self.frames {
            let own = state.frames.orientation.get(i).inverse() * turn;
            let moments = state.frames.inverse_moments(i);
            let spin = own.component_div(&moments);
            state.frames.angular_momentum.add(i, spin);
        }
    }
}

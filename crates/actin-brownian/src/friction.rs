use crate::Flow;
use actin_mechanics::{
    Coordinates, Loads, Matrix3, SecondOrder, State, Stiffness, Vector3, Vectors,
};

/// Friction at a place that moves with one or two points and a frame.
///
/// ```text
/// u = w_1 v_1 + w_2 v_2 + omega x arm,   F_c = -zeta_c u_c
/// ```
///
/// `v` are the velocities of the points (nm/ns) with weights `w`, and `omega` is the angular
/// velocity of the frame (rad/ns). `F` is the force at the place (pN), in axes `c` of the frame.
/// Loads follow from the virtual work, so that the friction matrix is symmetric.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dashpot {
    /// Points and their weights; points of zero weight are ignored.
    pub points: [(usize, f64); 2],
    /// Index of the frame.
    pub frame: usize,
    /// Vector from the points to the place (nm, body frame).
    pub arm: Vector3,
    /// Friction along each axis of the frame (pN ns/nm), at least 0.
    pub friction: Vector3,
}

/// Rotational friction of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurnDashpot {
    /// Index of the frame.
    pub frame: usize,
    /// Friction about each axis of the frame (pN nm ns), at least 0.
    pub friction: Vector3,
    /// `true` for a sphere, which turns with the vorticity of a flow. Other bodies turn as slender bodies along the third
    /// axis of the frame.
    pub is_sphere: bool,
}

impl Dashpot {
    /// Friction `friction` (pN ns/nm, axes of `frame`) at a place fixed in a body.
    pub fn of_body(point: usize, frame: usize, arm: Vector3, friction: Vector3) -> Self {
        Self {
            points: [(point, 1.0), (point, 0.0)],
            frame,
            arm,
            friction,
        }
    }

    /// Friction spread uniformly between two points, in axes of `frame`. It consists of the total
    /// `friction` (pN ns/nm) at the middle, and a twelfth of it on the velocity difference. Exact
    /// for velocities that are linear along the line.
    pub fn of_line([first, second]: [usize; 2], frame: usize, friction: Vector3) -> [Self; 2] {
        let with = |points, friction| Self {
            points,
            frame,
            arm: Vector3::zeros(),
            friction,
        };
        [
            with([(first, 0.5), (second, 0.5)], friction),
            with([(first, -1.0), (second, 1.0)], friction / 12.0),
        ]
    }

    pub(crate) fn points(&self) -> impl Iterator<Item = (usize, f64)> {
        self.points.into_iter().filter(|(_, weight)| *weight != 0.0)
    }

    /// Adds the loads of a force at the place (axes of the frame).
    fn add_force(&self, state: &State, force: Vector3, loads: &mut Loads) {
        let in_lab = state.frames.orientation.get(self.frame) * force;
        for (i, weight) in self.points() {
            loads.force.add(i, in_lab * weight);
        }
        loads.torque.add(self.frame, self.arm.cross(&force));
    }

    fn has_arm(&self) -> bool {
        self.arm != Vector3::zeros()
    }
}

/// All friction of a system.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Friction {
    /// Friction of translations.
    pub dashpots: Vec<Dashpot>,
    /// Friction of rotations.
    pub turns: Vec<TurnDashpot>,
}

/// Velocities of points (lab frame) and angular velocities of frames (body frame).
#[derive(Clone, Debug, Default)]
pub(crate) struct Velocities {
    pub(crate) points: Vectors,
    pub(crate) frames: Vectors,
}

impl Velocities {
    pub(crate) fn zeros(state: &State) -> Self {
        Self {
            points: Vectors::zeros(state.points.len()),
            frames: Vectors::zeros(state.frames.len()),
        }
    }
}

impl Friction {
    /// Adds the loads of the dashpots at selected frames, for velocities relative to the fluid at the points and to slender
    /// bodies in it.
    pub(crate) fn add_loads(
        &self,
        (state, velocities, flow): (&State, &Velocities, &Flow),
        has_frame: impl Fn(usize) -> bool,
        loads: &mut Loads,
    ) {
        let dashpots = self.dashpots.iter();
        for dashpot in dashpots.filter(|dashpot| has_frame(dashpot.frame)) {
            let q = state.frames.orientation.get(dashpot.frame);
            let of_points = |(i, weight)| velocities.points.get(i) * weight;
            let v: Vector3 = dashpot.points().map(of_points).sum();
            let omega = velocities.frames.get(dashpot.frame);
            let mut u = q.inverse_transform_vector(&v);
            if dashpot.has_arm() {
                u += omega.cross(&dashpot.arm) - flow.along_arm(q, &dashpot.arm);
            }
            dashpot.add_force(state, -dashpot.friction.component_mul(&u), loads);
        }
        for turn in self.turns.iter().filter(|turn| has_frame(turn.frame)) {
            let mut omega = velocities.frames.get(turn.frame);
            if turn.is_sphere {
                omega -= flow.turning_of_sphere(state.frames.orientation.get(turn.frame));
            }
            let torque = -turn.friction.component_mul(&omega);
            loads.torque.add(turn.frame, torque);
        }
    }

    pub(crate) fn add_noise(
        &self,
        state: &State,
        strength: f64,
        (places, turns): (&Vectors, &Vectors),
        loads: &mut Loads,
    ) {
        let random = |friction: Vector3, deviates: Vector3| {
            friction.map(f64::sqrt).component_mul(&deviates) * strength
        };
        for (k, dashpot) in self.dashpots.iter().enumerate() {
            let force = random(dashpot.friction, places.get(k));
            dashpot.add_force(state, force, loads);
        }
        for (k, turn) in self.turns.iter().enumerate() {
            let torque = random(turn.friction, turns.get(k));
            loads.torque.add(turn.frame, torque);
        }
    }

    /// Friction times `factor` as a matrix, in axes of the state of evaluation.
    pub(crate) fn times(&self, factor: f64) -> ScaledFriction<'_> {
        ScaledFriction {
            friction: self,
            factor,
            axes: None,
        }
    }
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct ScaledFriction<'a> {
    friction: &'a Friction,
    factor: f64,
    axes: Option<&'a State>,
}

impl<'a> ScaledFriction<'a> {
    pub(crate) fn scaled(self, factor: f64) -> Self {
        Self {
            factor: self.factor * factor,
            ..self
        }
    }

    pub(crate) fn in_axes_of(self, state: &'a State) -> Self {
        Self {
            axes: Some(state),
            ..self
        }
    }
}

impl ScaledFriction<'_> {
    pub(crate) fn add_dashpot(&self, k: usize, state: &State, stiffness: &mut Stiffness) {
        use Coordinates::{Frame, Point};
        let dashpot = &self.friction.dashpots[k];
        let own = Matrix3::from_diagonal(&(dashpot.friction * self.factor));
        let axes = self.axes.unwrap_or(state);
        let q = axes.frames.orientation.get(dashpot.frame);
        let q = q.to_rotation_matrix().into_inner();
        let in_lab = q * own * q.transpose();
        let frame = Frame(dashpot.frame);
        // omega x arm = A omega.
        let a = -dashpot.arm.cross_matrix();
        for (k, (i, weight)) in dashpot.points().enumerate() {
            for (j, other) in dashpot.points().skip(k) {
                stiffness.push(Point(i), Point(j), in_lab * (weight * other));
            }
            if dashpot.has_arm() {
                stiffness.push(Point(i), frame, q * own * a * weight);
            }
        }
        if dashpot.has_arm() {
            stiffness.push(frame, frame, a.transpose() * own * a);
        }
    }

    pub(crate) fn add_turn(&self, k: usize, stiffness: &mut Stiffness) {
        let turn = &self.friction.turns[k];
        let frame = Coordinates::Frame(turn.frame);
        let own = Matrix3::from_diagonal(&(turn.friction * self.factor));
        stiffness.push(frame, frame, own);
    }
}

impl SecondOrder for ScaledFriction<'_> {
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        for k in 0..self.friction.dashpots.len() {
            self.add_dashpot(k, state, stiffness);
        }
        for k in 0..self.friction.turns.len() {
            self.add_turn(k, stiffness);
        }
    }
}

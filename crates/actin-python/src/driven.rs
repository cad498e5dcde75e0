//! Motion of fixed bodies prescribed from Python, piecewise linear in time.

use actin_mechanics::{Drive, Matrix3, State, UnitQuaternion, Vector3, rotation};
use actin_sim::Assembly;
use std::sync::Arc;

/// Prescribed motion of a rigid group of bodies.
#[derive(Clone, Debug)]
pub(crate) struct Motion {
    /// Start time.
    pub(crate) begin: f64,
    /// Points and their positions at the start.
    pub(crate) points: Vec<(usize, Vector3)>,
    /// Frames and their orientations at the start.
    pub(crate) frames: Vec<(usize, UnitQuaternion)>,
    /// Centre of rotation at the start.
    pub(crate) about: Vector3,
    /// Times since the start, ascending from 0.
    pub(crate) times: Vec<f64>,
    /// Displacements at these times.
    pub(crate) displacements: Vec<Vector3>,
    /// Rotation vectors at these times (rad, lab frame).
    pub(crate) rotations: Vec<Vector3>,
    /// Unit vectors of free sliding.
    pub(crate) free: Vec<Vector3>,
}

/// Prescribed motion of bodies and controls.
#[derive(Clone, Debug, Default)]
pub(crate) struct Motions {
    /// Load factors over time and path of a scene.
    pub(crate) of_scene: Option<Arc<dyn Drive>>,
    pub(crate) own: Vec<Motion>,
}

impl Motions {
    pub(crate) fn is_empty(&self) -> bool {
        self.of_scene.is_none() && self.own.is_empty()
    }

    /// Ends the prescribed motion of points and frames.
    pub(crate) fn take(&mut self, points: &[usize], frames: &[usize]) {
        for motion in &mut self.own {
            motion.points.retain(|(i, _)| !points.contains(i));
            motion.frames.retain(|(i, _)| !frames.contains(i));
        }
    }
}

/// Returns the cross product matrix of a vector.
fn cross(v: Vector3) -> Matrix3 {
    Matrix3::new(0.0, -v.z, v.y, v.z, 0.0, -v.x, -v.y, v.x, 0.0)
}

/// Returns the angular velocity (lab frame) of a rotation vector that changes at a rate.
fn angular_velocity(rotation: Vector3, rate: Vector3) -> Vector3 {
    let (angle, k) = (rotation.norm(), cross(rotation));
    // For smaller angles, the next term of the series is below round-off.
    if angle < 1e-5 {
        return rate + k * rate * 0.5;
    }
    let (sin, cos) = angle.sin_cos();
    rate + k * rate * ((1.0 - cos) / (angle * angle))
        + k * (k * rate) * ((angle - sin) / angle.powi(3))
}

impl Motion {
    /// Returns the index of the time interval, the position in it (0 to 1), and its length; `None` after the last
    /// time.
    fn interval(&self, time: f64) -> (usize, f64, Option<f64>) {
        let last = self.times.len() - 1;
        if time >= self.times[last] {
            return (last - 1, 1.0, None);
        }
        let i = self.times.partition_point(|t| *t <= time).max(1) - 1;
        let length = self.times[i + 1] - self.times[i];
        (i, (time - self.times[i]) / length, Some(length))
    }

    /// Combines the prescribed components with the free components of the actual vector.
    fn held(&self, prescribed: Vector3, actual: Vector3) -> Vector3 {
        let free: Vector3 = self
            .free
            .iter()
            .map(|d| d * d.dot(&(actual - prescribed)))
            .sum();
        prescribed + free
    }

    fn place(&self, state: &mut State, time: f64) {
        let (i, share, length) = self.interval(time - self.begin);
        let between = |all: &[Vector3]| all[i] + (all[i + 1] - all[i]) * share;
        let rate =
            |all: &[Vector3]| length.map_or_else(Vector3::zeros, |l| (all[i + 1] - all[i]) / l);
        let (displacement, rotation) = (between(&self.displacements), between(&self.rotations));
        let turn = rotation::exp(rotation);
        let velocity = rate(&self.displacements);
        let omega = angular_velocity(rotation, rate(&self.rotations));
        for &(i, start) in &self.points {
            let arm = turn * (start - self.about);
            let target = self.about + displacement + arm;
            let place = self.held(target, state.points.position.get(i));
            state.points.position.set(i, place);
            let moving = self.held(velocity + omega.cross(&arm), state.points.velocity.get(i));
            state.points.velocity.set(i, moving);
        }
        for &(i, start) in &self.frames {
            let q = turn * start;
            state.frames.orientation.set(i, q);
            let body = q.inverse_transform_vector(&omega);
            let momentum = body.component_div(&state.frames.inverse_moments(i));
            state.frames.angular_momentum.set(i, momentum);
        }
    }
}

impl Drive for Motions {
    fn place(&self, state: &mut State, time: f64) {
        if let Some(drive) = &self.of_scene {
            drive.place(state, time);
        }
        self.own.iter().for_each(|motion| motion.place(state, time));
    }
}

/// Sets clamps and loads to position `u` on the path of a scene.
pub(crate) fn along_path(assembly: &Arc<Assembly>, state: &mut State, u: f64) {
    assembly.drive.place(state, u);
}

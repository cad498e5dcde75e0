//! What a scene moves from outside: held ends, load factors and anchors, along its path.

use super::Clamped;
use crate::scene::{Scene, Setting, Slides, path};
use actin_mechanics::{State, UnitQuaternion, Vector3, rotation};

/// A control, by the index of its load, clamp or linker, and its values at the ends of the stages,
/// the first of them before the path.
#[derive(Clone, Debug, PartialEq)]
struct Track {
    what: usize,
    values: Vec<Vector3>,
}

impl Track {
    fn new(what: usize, values: Vec<Vector3>) -> Self {
        Self { what, values }
    }

    /// Value at path parameter `u`, linear within a stage, and its slope there.
    fn at(&self, u: f64) -> (Vector3, Vector3) {
        let last = self.values.len() - 1;
        let u = u.clamp(0.0, last as f64);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped to the number of stages"
        )]
        let stage = (u.floor() as usize).min(last.saturating_sub(1));
        let slope = self.values[(stage + 1).min(last)] - self.values[stage];
        (self.values[stage] + slope * (u - stage as f64), slope)
    }
}

/// Everything that the path of a scene moves.
///
/// The path parameter counts stages: `u = 1.5` is halfway through the second.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drive {
    stages: usize,
    loads: Vec<Track>,
    shifts: Vec<Track>,
    turns: Vec<Track>,
    anchors: Vec<Track>,
    /// Index of the first control of the first anchor: those of loads stand before it.
    first_anchor: usize,
    ends: Vec<HeldEnd>,
}

/// A clamped end with its bodies as built.
#[derive(Clone, Debug, PartialEq)]
struct HeldEnd {
    points: Vec<(usize, Vector3)>,
    frames: Vec<(usize, UnitQuaternion)>,
    about: Vector3,
    slides: Slides,
    axis: Vector3,
}

impl Drive {
    /// The drive of a scene whose clamps hold these bodies of `rest`.
    pub(super) fn new(scene: &Scene, clamps: &[Clamped], rest: &State) -> Self {
        let load = |index| {
            let factors = path::load_factors(&scene.path, index)?.into_iter();
            Some(factors.map(Vector3::from_element).collect())
        };
        let is_at = |clamp: usize, filament, end| {
            (clamps[clamp].filament, clamps[clamp].end) == (filament, end)
        };
        let shift = |clamp: usize, setting: &Setting| match *setting {
            Setting::Shift {
                filament,
                end,
                shift_nm,
            } if is_at(clamp, filament, end) => Some(shift_nm.into()),
            _ => None,
        };
        let turn = |clamp: usize, setting: &Setting| match *setting {
            Setting::Turn {
                filament,
                end,
                turn_deg,
            } if is_at(clamp, filament, end) => Some(turn_deg.map(f64::to_radians).into()),
            _ => None,
        };
        let anchor = |index: usize, setting: &Setting| match *setting {
            Setting::Anchor { linker, shift_nm } if linker == index => Some(shift_nm.into()),
            _ => None,
        };
        Self {
            stages: scene.path.len(),
            loads: tracks(scene.loads.len(), load),
            shifts: tracks(clamps.len(), |i| path::values(&scene.path, |s| shift(i, s))),
            turns: tracks(clamps.len(), |i| path::values(&scene.path, |s| turn(i, s))),
            anchors: tracks(scene.linkers.len(), |i| {
                path::values(&scene.path, |s| anchor(i, s))
            }),
            first_anchor: scene.loads.len(),
            ends: clamps.iter().map(|c| HeldEnd::new(c, rest)).collect(),
        }
    }

    /// Number of stages.
    pub fn stages(&self) -> usize {
        self.stages
    }

    /// Whether the path moves nothing.
    pub fn is_still(&self) -> bool {
        self.stages == 0
    }

    /// Turn of a clamp's end (rad, rotation vector in the lab frame) at path parameter `u`.
    pub(crate) fn turn(&self, clamp: usize, u: f64) -> Vector3 {
        let track = self.turns.iter().find(|track| track.what == clamp);
        track.map_or_else(Vector3::zeros, |track| track.at(u).0)
    }

    /// Puts controls and held bodies where they belong at path parameter `u`. Of an end that
    /// slides, the component along which it slides stays as it is in `state`.
    pub fn place(&self, state: &mut State, u: f64) {
        self.place_moving(state, u, 0.0);
    }

    /// The same while the path parameter grows at `rate` (1/ns): held points and frames get the
    /// velocities that go with it.
    pub(super) fn place_moving(&self, state: &mut State, u: f64, rate: f64) {
        for track in &self.loads {
            state.controls[track.what] = track.at(u).0.x;
        }
        for track in &self.anchors {
            let first = self.first_anchor + 3 * track.what;
            let displacement = track.at(u).0;
            state.controls[first..first + 3].copy_from_slice(displacement.as_slice());
        }
        let motion = |tracks: &[Track], clamp| {
            let track = tracks.iter().find(|track| track.what == clamp);
            let (value, slope) = track.map_or_else(Default::default, |track| track.at(u));
            (value, slope * rate)
        };
        for (clamp, end) in self.ends.iter().enumerate() {
            let shift = motion(&self.shifts, clamp);
            let turn = motion(&self.turns, clamp);
            end.place(state, shift, turn);
        }
    }
}

/// The tracks of those of `count` controls that some stage sets, whose `values` there are.
fn tracks(count: usize, values: impl Fn(usize) -> Option<Vec<Vector3>>) -> Vec<Track> {
    let track = |what| Some(Track::new(what, values(what)?));
    (0..count).filter_map(track).collect()
}

impl HeldEnd {
    fn new(clamp: &Clamped, rest: &State) -> Self {
        let point = |&i: &usize| (i, rest.points.position.get(i));
        let frame = |&i: &usize| (i, rest.frames.orientation.get(i));
        Self {
            points: clamp.points.iter().map(point).collect(),
            frames: clamp.frames.iter().map(frame).collect(),
            about: clamp.about_nm,
            slides: clamp.slides,
            axis: clamp.axis,
        }
    }

    /// Places the bodies at a shift and a turn, each given with its rate.
    fn place(
        &self,
        state: &mut State,
        (shift, velocity): (Vector3, Vector3),
        (theta, rate): (Vector3, Vector3),
    ) {
        let turn = rotation::exp(theta);
        let omega = angular_velocity(theta, rate);
        let arm = |rest: Vector3| turn * (rest - self.about);
        let (reference, rest) = self.points[0];
        let present = state.points.position.get(reference) - self.about - arm(rest);
        let sliding = state.points.velocity.get(reference) - omega.cross(&arm(rest));
        let shift = self.unless_sliding(shift, present);
        let velocity = self.unless_sliding(velocity, sliding);
        for &(i, rest) in &self.points {
            let arm = arm(rest);
            state.points.position.set(i, self.about + arm + shift);
            state.points.velocity.set(i, velocity + omega.cross(&arm));
        }
        for &(i, rest) in &self.frames {
            let q = turn * rest;
            let body = q.inverse_transform_vector(&omega);
            let momentum = body.component_div(&state.frames.inverse_moments(i));
            state.frames.orientation.set(i, q);
            state.frames.angular_momentum.set(i, momentum);
        }
    }

    /// `prescribed`, but for the components along which the end slides, which are `present`.
    fn unless_sliding(&self, prescribed: Vector3, present: Vector3) -> Vector3 {
        match self.slides {
            Slides::Nowhere => prescribed,
            Slides::AlongAxis => {
                let axis = self.axis;
                // In this order components across an axis of the lab stay as they are to the bit.
                prescribed - axis * axis.dot(&prescribed) + axis * axis.dot(&present)
            }
            Slides::Freely => present,
        }
    }
}

/// Angular velocity (lab frame) of `exp(theta)` when `theta` changes at `rate`: `J_l(theta) rate`.
fn angular_velocity(theta: Vector3, rate: Vector3) -> Vector3 {
    if rate == Vector3::zeros() {
        return rate;
    }
    // Beyond a full turn J_l^-1 has poles; J_l itself is written out.
    let angle = theta.norm();
    if angle < 1e-8 {
        return rate + 0.5 * theta.cross(&rate);
    }
    let (sin, cos) = angle.sin_cos();
    let axis = theta / angle;
    rate * (sin / angle)
        + axis * (axis.dot(&rate) * (1.0 - sin / angle))
        + axis.cross(&rate) * ((1.0 - cos) / angle)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The angular velocity moves the rotation as its definition says, small angles and several
    /// turns alike.
    #[test]
    fn angular_velocity_is_that_of_the_rotation() {
        let rate = Vector3::new(0.3, -0.2, 0.5);
        let axis = Vector3::new(1.0, 2.0, -0.5).normalize();
        for angle in [0.0, 1e-6, 0.7, 3.0, 12.0] {
            let theta = axis * angle;
            let h = 1e-5;
            let (after, before) = (
                rotation::exp(theta + rate * h),
                rotation::exp(theta - rate * h),
            );
            let slope = rotation::log(after * before.inverse()) / (2.0 * h);
            assert!(
                (slope - angular_velocity(theta, rate)).norm() < 1e-9,
                "{angle}"
            );
        }
    }
}

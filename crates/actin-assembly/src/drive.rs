//! Prescribed motion of held ends, load factors and anchors along the path of a scene.

use super::Clamped;
use crate::scene::path::{self, Values};
use crate::scene::{ClampedEnds, FreeTranslation, Scene, Setting, Stage, left_jacobian_product};
use crate::whole::to_count;
use actin_coupling::Linker;
use actin_mechanics::{ControlId, State, UnitQuaternion, Vector3, rotation};
use std::ops::{Add, Mul, Sub};

/// Quantities that the path of a scene prescribes.
///
/// The path parameter counts stages: `u = 1.5` is the middle of the second stage.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drive {
    stages: usize,
    /// Factors of loads and of the strain of the periodic box.
    loads: Vec<(ControlId, Values<f64>)>,
    /// Displacements of anchors, by component.
    anchors: Vec<([ControlId; 3], Values<Vector3>)>,
    /// Ends of all clamps, in order.
    ends: Vec<HeldEnd>,
}

/// Clamped end with its bodies as built and its prescribed motion.
#[derive(Clone, Debug, PartialEq)]
struct HeldEnd {
    points: Vec<(usize, Vector3)>,
    frames: Vec<(usize, UnitQuaternion)>,
    about: Vector3,
    slides: FreeTranslation,
    axis: Vector3,
    /// Displacements (nm).
    shift: Option<Values<Vector3>>,
    /// Rotation vectors (rad).
    turn: Option<Values<Vector3>>,
}

impl Drive {
    pub(super) fn new(
        scene: &Scene,
        (held, clamps): (&ClampedEnds, &[Clamped]),
        (loads, strain, linkers): (&[ControlId], Option<ControlId>, &[Linker]),
        rest: &State,
    ) -> Self {
        let path = &scene.path;
        let shift = |setting: &Setting| match *setting {
            Setting::Shift {
                filament,
                end,
                shift_nm,
            } => Some((held.clamp_at(filament, end)?, shift_nm.into())),
            _ => None,
        };
        let turn = |setting: &Setting| match *setting {
            Setting::Turn {
                filament,
                end,
                turn_deg,
            } => Some((
                held.clamp_at(filament, end)?,
                turn_deg.map(f64::to_radians).into(),
            )),
            _ => None,
        };
        let anchor = |setting: &Setting| match *setting {
            Setting::Anchor { linker, shift_nm } => Some((linker, shift_nm.into())),
            _ => None,
        };
        let shifts = path::values(path, clamps.len(), shift);
        let turns = path::values(path, clamps.len(), turn);
        let moved = clamps.iter().zip(shifts.into_iter().zip(turns));
        Self {
            stages: path.len(),
            loads: factors(path, loads, strain),
            anchors: those_set(
                linkers.iter().map(Linker::anchor_controls),
                path::values(path, linkers.len(), anchor),
            ),
            ends: moved.map(|(c, by)| HeldEnd::new(c, by, rest)).collect(),
        }
    }

    /// Returns the number of stages.
    pub fn stages(&self) -> usize {
        self.stages
    }

    /// Returns `true` if the path has no stages.
    pub fn is_still(&self) -> bool {
        self.stages == 0
    }

    pub(super) fn moves(&self, anchor: [ControlId; 3]) -> bool {
        self.anchors.iter().any(|(controls, _)| *controls == anchor)
    }

    pub(super) fn sets(&self, load: ControlId) -> bool {
        self.loads.iter().any(|(control, _)| *control == load)
    }

    pub(crate) fn turn(&self, clamp: usize, u: f64) -> Vector3 {
        self.motion(self.ends[clamp].turn.as_ref(), (u, 0.0)).0
    }

    /// Stages, counted from 1, at whose ends a clamp's end is turned.
    pub(super) fn turned_after(&self, clamp: usize) -> impl Iterator<Item = usize> + '_ {
        self.ends[clamp].turn.iter().flat_map(Values::ends)
    }

    /// Makes the places of held bodies in `state` the origins of shifts and turns.
    pub(crate) fn rebase(&mut self, clamps: &[Clamped], state: &State) {
        for (end, clamp) in self.ends.iter_mut().zip(clamps) {
            end.about = clamp.point_nm(state);
            for (i, rest) in &mut end.points {
                *rest = state.points.position.get(*i);
            }
            for (i, rest) in &mut end.frames {
                *rest = state.frames.orientation.get(*i);
            }
        }
    }

    /// Sets controls and held bodies to their values at path parameter `u`. A sliding end keeps its
    /// displacement along the sliding direction from `state`.
    pub fn place(&self, state: &mut State, u: f64) {
        self.place_moving(state, u, 0.0);
    }

    /// Sets controls, held bodies and their velocities while `u` grows at `rate` (1/ns).
    pub(super) fn place_moving(&self, state: &mut State, u: f64, rate: f64) {
        self.set_controls(state, u);
        for end in &self.ends {
            let [shift, turn] =
                [&end.shift, &end.turn].map(|values| self.motion(values.as_ref(), (u, rate)));
            end.place(state, shift, turn);
        }
    }

    pub(super) fn set_controls(&self, state: &mut State, u: f64) {
        for (load, factor) in &self.loads {
            state.controls[*load] = self.at(factor, u).0;
        }
        for (components, displacement) in &self.anchors {
            let displacement = self.at(displacement, u).0;
            for (control, value) in components.iter().zip(displacement.as_slice()) {
                state.controls[*control] = *value;
            }
        }
    }

    /// Value at path parameter `u` and its rate of change for a growth of `rate` (1/ns); zero if no
    /// stage sets it.
    fn motion(
        &self,
        values: Option<&Values<Vector3>>,
        (u, rate): (f64, f64),
    ) -> (Vector3, Vector3) {
        let (value, slope) = values.map_or_else(Default::default, |values| self.at(values, u));
        (value, slope * rate)
    }

    fn at<T>(&self, values: &Values<T>, u: f64) -> (T, T)
    where
        T: Copy + Default + Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T>,
    {
        let last = self.stages;
        let u = u.clamp(0.0, last as f64);
        let stage = to_count(u).min(last.saturating_sub(1));
        let before = values.after(stage);
        let slope = values.after((stage + 1).min(last)) - before;
        (before + slope * (u - stage as f64), slope)
    }
}

/// Factors of loads and of the strain of a periodic box that the path sets.
fn factors(
    path: &[Stage],
    loads: &[ControlId],
    strain: Option<ControlId>,
) -> Vec<(ControlId, Values<f64>)> {
    let of_loads = path::load_factors(path, loads.len()).into_iter();
    let controls = loads.iter().copied().map(Some).chain([strain]);
    those_set(controls, of_loads.chain([path::strain_factor(path)]))
}

fn those_set<C, T>(
    controls: impl Iterator<Item = Option<C>>,
    values: impl IntoIterator<Item = Option<Values<T>>>,
) -> Vec<(C, Values<T>)> {
    let all = controls.zip(values);
    all.filter_map(|(control, values)| control.zip(values))
        .collect()
}

type PrescribedMotion = (Option<Values<Vector3>>, Option<Values<Vector3>>);

impl HeldEnd {
    fn new(clamp: &Clamped, (shift, turn): PrescribedMotion, rest: &State) -> Self {
        let point = |&i: &usize| (i, rest.points.position.get(i));
        let frame = |&i: &usize| (i, rest.frames.orientation.get(i));
        Self {
            points: clamp.points.iter().map(point).collect(),
            frames: clamp.frames.iter().map(frame).collect(),
            about: clamp.about_nm,
            slides: clamp.slides,
            axis: clamp.axis,
            shift,
            turn,
        }
    }

    /// Sets the bodies from a displacement and a rotation vector, each with its rate.
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

    /// Replaces the sliding components of `prescribed` by those of `present`.
    fn unless_sliding(&self, prescribed: Vector3, present: Vector3) -> Vector3 {
        match self.slides {
            FreeTranslation::Nowhere => prescribed,
            FreeTranslation::AlongAxis => {
                let axis = self.axis;
                // This order leaves components across a lab axis exactly unchanged.
                prescribed - axis * axis.dot(&prescribed) + axis * axis.dot(&present)
            }
            FreeTranslation::Freely => present,
        }
    }
}

/// Angular velocity (lab frame) of `exp(theta)`: `J_l(theta) rate`.
fn angular_velocity(theta: Vector3, rate: Vector3) -> Vector3 {
    if rate == Vector3::zeros() {
        return rate;
    }
    // `J_l^-1` has poles beyond a full turn, so `J_l` is evaluated directly.
    left_jacobian_product(theta, rate)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angular_velocity_agrees_with_the_rotation() {
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

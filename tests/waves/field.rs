//! Small motions of a straight filament as functions of arc length.

pub(crate) use crate::common::build;
use actin_mechanics::{State, Vector3, rotation};
use actin_sim::Assembly;
use std::f64::consts::PI;

#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion {
    /// Displacement of the axis (nm).
    pub(crate) shift: Vector3,
    /// Rotation vector about the axis point (rad).
    pub(crate) turn: Vector3,
    /// Velocity of the axis (nm/ns).
    pub(crate) velocity: Vector3,
    /// Angular velocity (rad/ns).
    pub(crate) spin: Vector3,
}

/// Moves every free body of a straight filament with the cross-section at its arc length.
pub(crate) fn set(assembly: &mut Assembly, motion: &dyn Fn(f64) -> Motion) {
    let (points, frames) = (assembly.points.clone(), assembly.frames.clone());
    let state = assembly.system.state_mut();
    for (i, point) in points.iter().enumerate() {
        if state.points.is_free(i) {
            let m = motion(point.s_nm);
            let axis = Vector3::z() * point.s_nm;
            let arm = rotation::exp(m.turn) * (state.points.position.get(i) - axis);
            state.points.position.set(i, axis + m.shift + arm);
            state
                .points
                .velocity
                .set(i, m.velocity + m.spin.cross(&arm));
        }
    }
    for (i, frame) in frames.iter().enumerate() {
        if state.frames.is_free(i) {
            let m = motion(frame.s_nm);
            let orientation = rotation::exp(m.turn) * state.frames.orientation.get(i);
            state.frames.orientation.set(i, orientation);
            set_spin(state, i, m.spin);
        }
    }
}

pub(crate) fn set_spin(state: &mut State, i: usize, spin: Vector3) {
    let body = state.frames.orientation.get(i).inverse() * spin;
    let momentum = body.component_div(&state.frames.inverse_moments(i));
    state.frames.angular_momentum.set(i, momentum);
}

/// Frequency (rad/ns) of times (ns) and amplitudes, from interpolated zeros.
pub(crate) fn frequency_of(series: &[(f64, f64)]) -> f64 {
    let zeros: Vec<f64> = series
        .windows(2)
        .filter(|pair| pair[0].1 * pair[1].1 < 0.0)
        .map(|pair| {
            let [(t0, a0), (t1, a1)] = [pair[0], pair[1]];
            t0 + (t1 - t0) * a0 / (a0 - a1)
        })
        .collect();
    (zeros.len() - 1) as f64 * PI / (zeros[zeros.len() - 1] - zeros[0])
}

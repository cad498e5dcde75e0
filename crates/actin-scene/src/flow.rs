//! Flow of the fluid in `Brownian`.

use super::SceneProblem;
use super::place::unit_vector;
use super::rules::show;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

const PER_S: f64 = 1e-9;

/// Largest rotation (rad) of the fluid in one step.
const LARGEST_TURN: f64 = 0.1;

/// Largest cosine of the angle between directions that count as perpendicular.
const PERPENDICULAR: f64 = 1e-6;

/// Flow of the fluid (lab frame).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum Flow {
    /// Fluid at rest.
    #[default]
    AtRest,
    /// Uniform flow.
    Stream {
        /// Velocity; finite.
        velocity_um_per_s: [f64; 3],
    },
    /// Simple shear flow with zero velocity at the origin.
    Shear {
        /// Shear rate; finite.
        rate_per_s: f64,
        /// Direction of the velocity; any length except zero.
        along: [f64; 3],
        /// Direction of the velocity gradient, perpendicular to `along`; any length except zero.
        across: [f64; 3],
    },
}

impl Flow {
    pub(super) fn check(&self) -> Result<(), SceneProblem> {
        match *self {
            Self::AtRest | Self::Stream { .. } => Ok(()),
            Self::Shear { along, across, .. } => {
                let [u, v] = [along, across].map(unit_vector);
                if u.dot(&v).abs() <= PERPENDICULAR {
                    return Ok(());
                }
                let rule = "must be perpendicular to task.flow.along";
                Err(SceneProblem::new("task.flow.across", show(across), rule))
            }
        }
    }

    /// Returns the longest step (ns): the fluid rotates by at most 0.1 rad in it.
    pub fn longest_step(&self) -> f64 {
        match *self {
            Self::Shear { rate_per_s, .. } => LARGEST_TURN / (rate_per_s.abs() * PER_S),
            Self::AtRest | Self::Stream { .. } => f64::INFINITY,
        }
    }

    /// Checks the rotation of the fluid in a step (ns).
    ///
    /// # Errors
    /// If the fluid rotates by more than 0.1 rad in one step.
    pub fn check_step(&self, step_ns: f64) -> Result<(), SceneProblem> {
        let Self::Shear { rate_per_s, .. } = *self else {
            return Ok(());
        };
        if rate_per_s.abs() * PER_S * step_ns <= LARGEST_TURN {
            return Ok(());
        }
        let rule = format!(
            "must be at most {:e}: the fluid may turn by {LARGEST_TURN} rad in a step of {step_ns:e} ns",
            LARGEST_TURN / step_ns / PER_S
        );
        let key = "task.flow.rate_per_s";
        Err(SceneProblem::new(key, show(rate_per_s), rule))
    }
}

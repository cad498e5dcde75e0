//! Thermal noise and its validation.

use super::{Dynamics, Scene, SceneProblem, Task};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Boltzmann constant (pN nm/K), exact in the SI.
///
/// # Source
/// Bureau International des Poids et Mesures, The International System of Units, 9th edition (2019).
pub const BOLTZMANN_PN_NM_PER_K: f64 = 0.013_806_49;

/// Thermal noise, in balance with drag at a temperature. It depends only on the seed, the number of the step
/// and the index of the body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Thermal {
    /// Temperature; positive.
    pub temperature_k: f64,
    /// Seed of the noise.
    pub seed: u64,
}

impl Thermal {
    /// Returns the thermal energy `kT` (pN nm).
    ///
    /// ```
    /// let thermal = actin_scene::Thermal { temperature_k: 300.0, seed: 1 };
    /// assert!((thermal.energy_pn_nm() - 4.142).abs() < 1e-3);
    /// ```
    pub fn energy_pn_nm(&self) -> f64 {
        BOLTZMANN_PN_NM_PER_K * self.temperature_k
    }
}

impl Scene {
    /// Returns the thermal noise of the task, or `None`.
    pub fn thermal(&self) -> Option<Thermal> {
        match &self.task {
            Task::Dynamics(dynamics) => dynamics.thermal,
            Task::Brownian(brownian) => brownian.thermal(),
            Task::Equilibrium(_) => None,
        }
    }

    /// Thermal energy of the task (pN nm); zero without a heat bath.
    pub fn thermal_energy_pn_nm(&self) -> f64 {
        let thermal = self.task.motion().and_then(|motion| motion.thermal);
        thermal.map_or(0.0, |thermal| thermal.energy_pn_nm())
    }
}

pub(super) fn check(dynamics: &Dynamics) -> Result<(), SceneProblem> {
    if dynamics.thermal.is_none() {
        return Ok(());
    }
    let drag = dynamics.drag.rates();
    let rates = [
        ("translational_per_ns", drag.translational_per_ns),
        ("rotational_per_ns", drag.rotational_per_ns),
    ];
    for (name, rate) in rates {
        if rate == 0.0 && dynamics.drag.fluid().is_none() {
            let rule = "must be greater than 0, because thermal noise requires drag";
            let key = format!("task.drag.{name}");
            return Err(SceneProblem::new(key, format!("{rate:?}"), rule));
        }
    }
    Ok(())
}

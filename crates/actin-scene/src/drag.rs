//! Drag of motion with inertia: numerical damping or a fluid.

use super::brownian::{Fluid, Water};
use super::rules::show;
use super::{Dynamics, Integrator, SceneProblem};
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize};

/// Numerical damping, proportional to mass: velocities decay as `exp(-rate t)`. Physical drag follows from the
/// viscosity of `Water`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename = "Drag")]
pub struct DragRates {
    /// Damping rate of velocities; at least 0.
    pub translational_per_ns: f64,
    /// Damping rate of angular momenta; at least 0.
    pub rotational_per_ns: f64,
}

/// Drag of motion with inertia.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum DragModel {
    /// Numerical damping.
    Rates(DragRates),
    /// Drag of a fluid, as in `Brownian`.
    Fluid(Fluid),
}

impl Default for DragModel {
    fn default() -> Self {
        Self::Rates(DragRates::default())
    }
}

impl From<DragRates> for [f64; 2] {
    fn from(rates: DragRates) -> Self {
        [rates.translational_per_ns, rates.rotational_per_ns]
    }
}

impl From<DragRates> for DragModel {
    fn from(rates: DragRates) -> Self {
        Self::Rates(rates)
    }
}

impl DragModel {
    /// Returns the rates of numerical damping, which are zero in a fluid.
    pub fn rates(&self) -> DragRates {
        match self {
            Self::Rates(rates) => *rates,
            Self::Fluid(_) => DragRates::default(),
        }
    }

    /// Returns the fluid, if any.
    pub fn fluid(&self) -> Option<&Fluid> {
        match self {
            Self::Rates(_) => None,
            Self::Fluid(fluid) => Some(fluid),
        }
    }
}

pub(super) fn check(dynamics: &Dynamics) -> Result<(), SceneProblem> {
    let usual = [Integrator::PositionVerlet, Integrator::Pefrl];
    if dynamics.drag.fluid().is_none() || usual.contains(&dynamics.integrator) {
        return Ok(());
    }
    let rule = "is not used with Water, which has its own integrator (Gronbech-Jensen and Farago): omit this key";
    let integrator = show(dynamics.integrator);
    Err(SceneProblem::new("task.integrator", integrator, rule))
}

/// Reads keys without a name as `Drag`.
impl<'de> Deserialize<'de> for DragModel {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        enum Drag {
            Drag(DragRates),
            Water(Water),
        }
        Ok(match Drag::deserialize(deserializer)? {
            Drag::Drag(rates) => Self::Rates(rates),
            Drag::Water(water) => Self::Fluid(Fluid::Water(water)),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Scene, Task};

    fn read(drag: &str) -> Result<DragModel, String> {
        let text = format!(
            "Scene(
                filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 60.0)]),
                task: Dynamics(
                    duration_ns: 1.0,
                    drag: {drag},
                ),
            )"
        );
        let scene = Scene::from_ron(&text).map_err(|error| error.to_string())?;
        assert_eq!(Scene::from_ron(&scene.to_ron()).unwrap(), scene);
        match scene.task {
            Task::Dynamics(dynamics) => Ok(dynamics.drag),
            _ => unreachable!("the text above is a motion"),
        }
    }

    #[test]
    fn damping_and_fluids_are_read() {
        let rates = DragRates {
            translational_per_ns: 2.0,
            rotational_per_ns: 1.5,
        };
        for name in ["", "Drag"] {
            let text = format!("{name}(translational_per_ns: 2, rotational_per_ns: 1.5)");
            assert_eq!(read(&text), Ok(DragModel::Rates(rates)));
        }
        let water = Fluid::default();
        assert_eq!(read("Water()"), Ok(DragModel::Fluid(water)));
        let thick = read("Water(viscosity_mpa_s: 2)").unwrap();
        assert_eq!(read("Water(viscosity_mpa_s: 2.0)"), Ok(thick));
        assert_ne!(thick, DragModel::Fluid(water));
    }
}

//! Drag of motion with inertia: numerical damping or a fluid.

use super::brownian::Fluid;
use super::rules::non_negative;
use super::value::SceneValue;
use super::{Dynamics, Integrator, SceneProblem};
use serde::de::{Error as _, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use std::fmt;

/// Numerical damping, proportional to mass: velocities decay as `exp(-rate t)`. Physical drag follows from the
/// viscosity of `Water`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
#[serde(rename = "Drag")]
pub struct DragRates {
    /// Damping rate of velocities; at least 0.
    pub translational_per_ns: f64,
    /// Damping rate of angular momenta; at least 0.
    pub rotational_per_ns: f64,
}

/// Drag of motion with inertia.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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

/// Checks the drag and the integrator of a motion.
pub(super) fn check(dynamics: &Dynamics) -> Result<(), SceneProblem> {
    let Some(fluid) = dynamics.drag.fluid() else {
        let rates = dynamics.drag.rates();
        non_negative("task.drag.translational_per_ns", rates.translational_per_ns)?;
        return non_negative("task.drag.rotational_per_ns", rates.rotational_per_ns);
    };
    fluid.check()?;
    if matches!(
        dynamics.integrator,
        Integrator::PositionVerlet | Integrator::Pefrl
    ) {
        return Ok(());
    }
    let rule = "is not used with Water, which has its own integrator (Gronbech-Jensen and Farago): leave it out";
    Err(SceneProblem::new(
        "task.integrator",
        format!("{:?}", dynamics.integrator),
        rule,
    ))
}

impl<'de> Deserialize<'de> for DragModel {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let read = match SceneValue::from(Tree::deserialize(deserializer)?) {
            SceneValue::Keys(one) if one.len() == 1 && one[0].0 == "Drag" => {
                DragRates::deserialize(&one[0].1).map(Self::Rates)
            }
            SceneValue::Keys(one) if one.len() == 1 && one[0].0.starts_with(char::is_uppercase) => {
                Fluid::deserialize(&SceneValue::Keys(one)).map(Self::Fluid)
            }
            SceneValue::Keys(keys) => {
                DragRates::deserialize(&SceneValue::Keys(keys)).map(Self::Rates)
            }
            _ => {
                return Err(D::Error::custom(
                    "drag is (translational_per_ns: .., rotational_per_ns: ..), or Water(viscosity_mpa_s: ..)",
                ));
            }
        };
        read.map_err(|refusal| D::Error::custom(refusal.rule()))
    }
}

/// Any value of a scene. Its name or keys determine the type of drag.
#[derive(Deserialize)]
#[serde(untagged)]
enum Tree {
    Bool(bool),
    Whole(i64),
    Number(f64),
    Text(String),
    Nothing(()),
    Keys(Keys),
    List(Vec<Tree>),
}

/// Keys in order, including duplicates.
struct Keys(Vec<(String, Tree)>);

impl<'de> Deserialize<'de> for Keys {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(KeysVisitor)
    }
}

struct KeysVisitor;

impl<'de> Visitor<'de> for KeysVisitor {
    type Value = Keys;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("keys")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Keys, A::Error> {
        let mut keys = Vec::new();
        while let Some(entry) = map.next_entry()? {
            keys.push(entry);
        }
        Ok(Keys(keys))
    }
}

impl From<Tree> for SceneValue {
    fn from(tree: Tree) -> Self {
        match tree {
            Tree::Bool(value) => Self::Bool(value),
            Tree::Whole(value) => Self::Whole(value.into()),
            Tree::Number(value) => Self::Number(value),
            Tree::Text(value) => Self::Text(value),
            // Variant without keys.
            Tree::Nothing(()) => Self::Keys(Vec::new()),
            Tree::List(values) if values.is_empty() => Self::Keys(Vec::new()),
            Tree::List(values) => Self::List(values.into_iter().map(Self::from).collect()),
            Tree::Keys(Keys(keys)) => {
                let keys = keys.into_iter().map(|(key, tree)| (key, tree.into()));
                Self::Keys(keys.collect())
            }
        }
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

    #[test]
    fn mistakes_are_told() {
        for (drag, told) in [
            ("Oil(viscosity_mpa_s: 1.0)", "unknown Fluid Oil"),
            ("Water(viscosity: 1.0)", "write viscosity_mpa_s"),
            ("Water(viscosity_mpa_s: -1.0)", "task.drag.viscosity_mpa_s"),
            ("Water(radius_nm: 20.0)", "task.drag.radius_nm"),
            ("Water(translational_per_ns: 1.0)", "translational_per_ns"),
            (
                "(translational_per_ns: 1.0)",
                "missing key rotational_per_ns",
            ),
            (
                "(viscosity_mpa_s: 1.0)",
                "unknown key viscosity_mpa_s in Drag",
            ),
            (
                "(translational_per_ns: 1.0, translational_per_ns: 1.0, rotational_per_ns: 1.0)",
                "duplicate",
            ),
            ("()", "missing key translational_per_ns"),
            ("5.0", "Water(viscosity_mpa_s: ..)"),
        ] {
            let error = read(drag).unwrap_err();
            println!("{drag}: {error}");
            assert!(error.contains(told), "{drag}: {error}");
            assert!(
                error.starts_with("5:") || error.starts_with("6:"),
                "{drag}: {error}"
            );
        }
    }
}

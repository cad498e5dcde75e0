//! What is known of the trade of accuracy for speed: settings, the scenes they were measured on,
//! the table of what came out, and the one change that would save a scene most.
//!
//! The measurements are those of `cargo xtask tradeoff`; nothing here runs a scene.

mod change;
mod like;
pub mod scenes;
mod setting;
pub mod table;

pub use change::{Change, Expected};
pub use setting::Setting;
pub use table::Measured;

use crate::scene::{Problem, Scene};
use std::fmt;

/// Largest expected error of the displacement that a change may bring.
pub const AT_MOST: f64 = 0.02;

/// What is known of a scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Advice {
    /// This change saves most.
    Change(Box<Change>),
    /// The scene is like a measured one, on which no change saved anything at so small an error.
    Nothing {
        /// The measured scene.
        like: &'static str,
    },
    /// Nothing like it was measured.
    Unknown,
}

impl Advice {
    /// The single change that would save `scene` most time at an expected error of the displacement
    /// of [`AT_MOST`].
    ///
    /// # Errors
    /// A scene that cannot be built, or whose time step is refused.
    pub fn of(scene: &Scene) -> Result<Self, Problem> {
        let known = scenes::all();
        let like = known.iter().find(|(_, m)| like::is_like(scene, m));
        let Some((name, measured)) = like else {
            return Ok(Self::Unknown);
        };
        let best = change::best(scene, name, like::length(measured))?;
        Ok(best.map_or(Self::Nothing { like: name }, |change| {
            Self::Change(Box::new(change))
        }))
    }
}

impl fmt::Display for Advice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Change(change) => write!(f, "{change}"),
            Self::Nothing { like } => write!(
                f,
                "no single change is known to save time at an error of {:.0} % or less (measured \
                 on {like})",
                100.0 * AT_MOST
            ),
            Self::Unknown => f.write_str(
                "nothing like this scene was measured: what cheaper resolutions would cost in \
                 accuracy is not known",
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cost::Cost;
    use crate::{Assembly, RodLaw, Task};

    fn cantilever() -> Scene {
        scenes::all().remove(0).1
    }

    /// The advice for the cantilever of Figure 4, every monomer resolved. By the rates, 7616 bonds take
    /// 0.389 ms of a Newton step, 1856 bonds and 14 elements 0.159 ms.
    #[test]
    fn the_advice_for_the_cantilever() {
        let advice = Advice::of(&cantilever()).unwrap().to_string();
        assert_eq!(
            advice,
            "replace the monomers of 40..160 nm by a rod with law Fitted: 2.4 times cheaper, expected \
             errors: tip 1.4 %, energy 1.3 %, torque 0.4 %, curvature at the wall 0.7 % (samplings of \
             the bonds scatter by 3.8 %; measured on cantilever-160)"
        );
    }

    /// What is advised is accepted by every rule, can be built, is cheaper, and has what the scene had:
    /// its loads, linkers, path and length.
    #[test]
    fn advice_is_never_refused() {
        for (name, scene) in scenes::all() {
            let Advice::Change(change) = Advice::of(&scene).unwrap() else {
                continue;
            };
            change.scene.validate().unwrap();
            let cost = |scene| Cost::estimated(&Assembly::build(scene).unwrap()).unwrap();
            assert!(cost(&change.scene).seconds < cost(&scene).seconds, "{name}");
            assert_eq!(change.scene.loads, scene.loads);
            assert_eq!(change.scene.linkers, scene.linkers);
            assert_eq!(change.scene.path, scene.path);
            let length = |scene: &Scene| scene.filament.sections.last().unwrap().span_nm().1;
            assert!(
                (length(&change.scene) - length(&scene)).abs() < 1e-9,
                "{name}"
            );
            let expected = change.expected.and_then(|e| e.row.displacement);
            assert!(expected.is_some_and(|error| error <= AT_MOST), "{name}");
        }
    }

    /// A damped motion that stops at rest is an equilibrium in disguise, and a finer resolution is never
    /// advised: a pure rod has nothing to replace.
    #[test]
    fn advice_only_saves() {
        let mut scene = Setting::of(vec![], RodLaw::Constant).apply(&cantilever());
        assert_eq!(
            Advice::of(&scene).unwrap(),
            Advice::Nothing {
                like: "cantilever-160"
            }
        );
        let text = scene.to_ron();
        assert!(matches!(scene.task, Task::Equilibrium(_)), "{text}");
        scene.filament.monomers.rise_nm = 2.76;
        assert_eq!(Advice::of(&scene).unwrap(), Advice::Unknown);
    }
}
